"""Makes the Python classes of the schema: `python proto/generate.py`, or `--check` to see whether the committed ones are up to date.

The compiler is the one of `grpcio-tools` as pinned in the extra `dev`. Its output names the oldest protobuf runtime that can load
it, which is the lower bound in pyproject.toml.
"""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

PROTO = Path(__file__).parent
SCHEMA = PROTO / "egotouch" / "v1" / "egotouch.proto"
GENERATED = PROTO.parent / "egotouch_sdk" / "wire" / "gen"
#: Newer ones make classes that need a newer protobuf runtime.
COMPILER = "1.76.0"


def compiled() -> dict[str, str]:
    """File name and text of every generated module."""
    from grpc_tools import protoc

    if version("grpcio-tools") != COMPILER:
        raise SystemExit(f"grpcio-tools is {version('grpcio-tools')}, need {COMPILER}: pip install --no-deps grpcio-tools=={COMPILER}")
    with TemporaryDirectory() as folder:
        code = protoc.main(["protoc", f"-I{PROTO}", f"--python_out={folder}", f"--pyi_out={folder}", str(SCHEMA)])
        if code:
            raise SystemExit(code)
        return {path.name: path.read_text(encoding="utf-8") for path in Path(folder).rglob("*_pb2.py*")}


def stale(files: dict[str, str]) -> list[str]:
    """Names of the generated files that differ from the committed ones."""
    return [name for name, text in files.items() if not _is_same(GENERATED / name, text)]


def _is_same(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text


def main(arguments: list[str]) -> int:
    """Write the generated files, or only compare them."""
    files = compiled()
    if "--check" in arguments:
        for name in stale(files):
            sys.stderr.write(f"{GENERATED.name}/{name} is not what {SCHEMA.name} generates; run: make proto\n")
        return 1 if stale(files) else 0
    for name, text in files.items():
        (GENERATED / name).write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
