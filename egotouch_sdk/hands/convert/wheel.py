"""Fetch the one pinned mediapipe wheel and take checked files out of it."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from egotouch_sdk.errors import ModelError

#: The release whose networks we use; the same wheel serves every platform, for only its data files are read.
MEDIAPIPE_VERSION = "0.10.21"
WHEEL_NAME = f"mediapipe-{MEDIAPIPE_VERSION}-cp311-cp311-manylinux_2_28_x86_64.whl"
#: As published on the Python package index.
WHEEL_SHA256 = "05dc4a9e593655a79558d05d6227d31018c2537a4bd3362b51e230cf22aecfe3"
#: Set this to a local copy of the wheel to build without a network.
WHEEL_VARIABLE = "EGOTOUCH_MEDIAPIPE_WHEEL"

_PIP_ARGUMENTS = (
    *("--no-deps", "--only-binary=:all:", "--disable-pip-version-check", "--no-input", "--progress-bar=off"),
    *("--platform=manylinux_2_28_x86_64", "--python-version=3.11", "--implementation=cp", "--abi=cp311"),
)


def sha256(data: bytes) -> str:
    """Hexadecimal SHA-256 of some bytes."""
    return hashlib.sha256(data).hexdigest()


@contextmanager
def open_wheel(environment: Mapping[str, str] | None = None) -> Iterator[Path]:
    """Path of the mediapipe wheel: the file that `EGOTOUCH_MEDIAPIPE_WHEEL` names, else a download that is removed afterwards.

    Raises `ModelError` when the file is missing, the download fails or the download is not the published wheel.
    """
    local = (os.environ if environment is None else environment).get(WHEEL_VARIABLE, "")
    if local:
        if not Path(local).is_file():
            raise ModelError(f"{WHEEL_VARIABLE} names {local}, which is not a file", hint=f"Point it at {WHEEL_NAME} or unset it")
        yield Path(local)
        return
    with tempfile.TemporaryDirectory(prefix="egotouch-") as folder:
        yield _download(Path(folder))


def _download(folder: Path) -> Path:
    command = [sys.executable, "-m", "pip", "download", f"mediapipe=={MEDIAPIPE_VERSION}", *_PIP_ARGUMENTS, f"--dest={folder}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    wheel = folder / WHEEL_NAME
    if done.returncode != 0 or not wheel.is_file():
        raise ModelError(
            f"the hand networks could not be downloaded: no {WHEEL_NAME} from the configured package index ({_reason(done)})",
            hint=f"Check the network and 'pip config list', then install again; or set {WHEEL_VARIABLE} to a local copy of that wheel",
        )
    found = sha256(wheel.read_bytes())
    if found != WHEEL_SHA256:
        raise ModelError(
            f"the package index served a {WHEEL_NAME} with sha256 {found}, but the published one has {WHEEL_SHA256}",
            hint=f"Run 'pip cache remove mediapipe' or use another index; or set {WHEEL_VARIABLE} to a local copy of that wheel",
        )
    return wheel


def _reason(done: subprocess.CompletedProcess[str]) -> str:
    lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
    errors = [line for line in lines if line.startswith("ERROR")]
    return f"pip said: {(errors or lines or ['nothing'])[-1]}"


def read_member(wheel: Path, member: str, expected_sha256: str) -> bytes:
    """Bytes of one file inside the wheel; raises `ModelError` when it is absent or not the expected one."""
    hint = f"Set {WHEEL_VARIABLE} to an unaltered mediapipe {MEDIAPIPE_VERSION} wheel, or unset it to download one"
    try:
        with zipfile.ZipFile(wheel) as archive:
            data = archive.read(member)
    except (KeyError, zipfile.BadZipFile, OSError) as error:
        raise ModelError(f"{wheel} holds no readable {member} ({error})", hint=hint) from error
    if sha256(data) != expected_sha256:
        raise ModelError(f"{member} in {wheel} has sha256 {sha256(data)}, need {expected_sha256}", hint=hint)
    return data
