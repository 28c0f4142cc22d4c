"""Data flows one way: who may import whom, and what an import may load."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "egotouch_sdk"

#: A module imports only from lower ranks or from its own sub-package.
RANKS: tuple[frozenset[str], ...] = (
    frozenset({"errors", "joints", "surface", "clock"}),
    frozenset({"jobs"}),
    frozenset({"frame", "observation", "touch_event", "config_layers", "config_presets", "config_section"}),
    frozenset({"config_sections"}),
    frozenset({"frame_observation", "config", "hand_geometry", "model_input", "model_store", "inference", "events", "study_data"}),
    frozenset({"frame_result", "capture_time"}),
    frozenset({"wire", "listeners"}),
    frozenset({"hands", "gate", "patches", "touch", "filters", "host_frame", "state", "gestures", "skin"}),
    frozenset({"recording", "simulator"}),
    frozenset({"sources", "engine"}),
    frozenset({"capture", "pipeline", "replay"}),
    frozenset({"ego_touch", "server"}),
    frozenset({"view", "benchmark", "synthetic", "evaluation"}),
    frozenset({"training", "cli"}),
    frozenset({"__main__"}),
)
RANK_OF = {module: rank for rank, modules in enumerate(RANKS) for module in modules}
#: The public names are imported on first use and belong to no rank.
FACADE = "__init__"
#: Offline sub-packages: nobody needs them to find touches.
OFFLINE = frozenset({"training", "synthetic", "evaluation", "jobs"})
#: The only importers of an offline sub-package besides itself.
MAY_USE_OFFLINE = {"training": OFFLINE, "cli": OFFLINE, "synthetic": {"jobs"}, "evaluation": {"jobs"}}
SOLE_IMPORTER = {"onnxruntime": "inference.py", "time": "clock.py", "ray": "jobs/ray_cluster.py"}


def imports(path: Path) -> Iterator[str]:
    """Dotted names of everything a module imports, inside functions too."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module is not None:
            yield node.module
            if node.module == "egotouch_sdk":
                yield from (f"egotouch_sdk.{alias.name}" for alias in node.names)


def module_of(path: Path) -> str:
    """The ranked module a file belongs to; a `cli.py` inside a sub-package is part of the command line."""
    return "cli" if path.name == "cli.py" else path.relative_to(PACKAGE).parts[0].removesuffix(".py")


FILES = [path for path in sorted(PACKAGE.rglob("*.py")) if module_of(path) != FACADE]
EDGES = sorted(
    {
        (module_of(path), name.split(".")[1])
        for path in FILES
        for name in imports(path)
        if name.startswith("egotouch_sdk.") and not name.endswith("__version__")
    }
)


def test_every_module_has_a_rank() -> None:
    assert {module_of(path) for path in FILES} <= set(RANK_OF)


def test_imports_go_down() -> None:
    wrong = [f"{a} imports {b}" for a, b in EDGES if a != b and RANK_OF[a] <= RANK_OF.get(b, 99) and b not in MAY_USE_OFFLINE.get(a, ())]
    assert wrong == []


def test_offline_parts_are_imported_by_nobody_else() -> None:
    wrong = [f"{a} imports {b}" for a, b in EDGES if b in OFFLINE and a != b and b not in MAY_USE_OFFLINE.get(a, ())]
    assert wrong == []


@pytest.mark.parametrize("library", SOLE_IMPORTER)
def test_a_library_has_one_door(library: str) -> None:
    importers = {str(path.relative_to(PACKAGE)) for path in FILES if any(name.split(".")[0] == library for name in imports(path))}
    assert importers == {SOLE_IMPORTER[library]}


@pytest.mark.parametrize("library", ["torch", "lightning", "sklearn"])
def test_only_training_uses_the_training_libraries(library: str) -> None:
    users = {module_of(path) for path in FILES if any(name.split(".")[0] == library for name in imports(path))}
    assert users <= {"training"}


def loaded_by(statement: str) -> set[str]:
    """Top-level packages in memory after a statement, in a fresh interpreter."""
    script = f"{statement}\nimport sys\nprint('\\n'.join(sys.modules))"
    output = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=PACKAGE.parent).stdout
    return {line.split(".")[0] for line in output.splitlines()}


def test_importing_the_package_loads_no_heavy_library() -> None:
    assert loaded_by("import egotouch_sdk").isdisjoint({"torch", "cv2", "onnxruntime", "websockets", "pydantic", "numpy", "mitsuba"})


def test_a_whole_pipeline_needs_no_optional_library() -> None:
    loaded = loaded_by("import egotouch_sdk; egotouch_sdk.TouchPipeline()")
    assert "onnxruntime" in loaded
    assert loaded.isdisjoint({"torch", "lightning", "sklearn", "scipy", "mitsuba", "onnx", "tflite", "trimesh", "pygltflib"})


def test_every_public_name_can_be_imported() -> None:
    loaded_by("import egotouch_sdk\nfor name in egotouch_sdk.__all__: getattr(egotouch_sdk, name)")
