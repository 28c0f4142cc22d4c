"""Find shipped model files and refuse altered ones."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ModelError

MODELS_DIR = Path(__file__).parent / "models"
HANDS_DIR = MODELS_DIR / "hands"

_REINSTALL = "Install the package again ('pip install --force-reinstall egotouch-sdk', or 'pip install -e .' in a checkout)"


def read_manifest(path: Path) -> dict[str, Any]:
    """A JSON manifest as a dictionary; raises `ModelError` when it is missing or not a JSON object."""
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise ModelError(f"the model manifest {path} is missing", hint=_REINSTALL) from error
    except (OSError, ValueError) as error:
        raise ModelError(f"the model manifest {path} is not readable JSON ({error})", hint=_REINSTALL) from error
    if not isinstance(manifest, dict):
        raise ModelError(f"the model manifest {path} is not a JSON object", hint=_REINSTALL)
    return manifest


def checked_file(path: Path, expected_sha256: str) -> Path:
    """`path` itself when its content has the expected SHA-256; raises `ModelError` otherwise."""
    try:
        found = hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise ModelError(f"the model file {path} cannot be read ({error.strerror})", hint=_REINSTALL) from error
    if found != expected_sha256:
        raise ModelError(f"the model file {path} has sha256 {found}, its manifest says {expected_sha256}", hint=_REINSTALL)
    return path


def hand_model(name: str, folder: Path = HANDS_DIR) -> Path:
    """Checked path of a hand network: "palm_detection_full" or "hand_landmark_full" (or "_lite" where the build made them).

    Raises `ModelError` when the build did not make it or the file was altered since.
    """
    manifest = read_manifest(folder / "manifest.json")
    try:
        entry = manifest["models"][name]
        file, digest = str(entry["file"]), str(entry["sha256"])
    except (KeyError, TypeError) as error:
        models = manifest.get("models")
        known = ", ".join(sorted(models)) if isinstance(models, dict) else "none"
        raise ModelError(f"no hand network called {name!r} was built into this package (there is: {known})", hint=_REINSTALL) from error
    return checked_file(folder / file, digest)
