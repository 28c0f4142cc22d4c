"""The two hand meshes that synthetic data starts from, fetched once and checked.

They are `generic-hand/{left,right}.glb` of the WebXR Input Profiles project (npm package
`@webxr-input-profiles/assets`, MIT licence, github.com/immersive-web/webxr-input-profiles). The package is 94 MB and the
meshes 0.2 MB, so they are not shipped here: the user's own `npm pack` fetches the pinned version into the cache folder.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.joints import Handedness

PACKAGE = "@webxr-input-profiles/assets"
VERSION = "1.0.20"
FOLDER = "package/dist/profiles/generic-hand"
#: SHA-256 of the two files in version 1.0.20.
SHA256 = {
    Handedness.LEFT: "bc67783144944ea1cda54d9247885825ea5fb9d4651469fe7d00be517a5c2b87",
    Handedness.RIGHT: "291790c14f7f88a7f9bd35330c47392ed8e8d395ae6728f4bb7089f1bc1f2b96",
}
#: Set to a folder that holds `left.glb` and `right.glb` to use those instead of fetching.
MESH_DIR_VARIABLE = "EGOTOUCH_HAND_MESH_DIR"
_FETCH_TIMEOUT_S = 600


def cache_dir() -> Path:
    """Folder for fetched and computed files: `$EGOTOUCH_CACHE`, else `~/.cache/egotouch`; made when missing."""
    folder = Path(os.environ.get("EGOTOUCH_CACHE") or Path.home() / ".cache" / "egotouch")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def hand_mesh_path(side: Handedness | str, folder: Path | None = None) -> Path:
    """Path of one hand's GLB file, fetched on first use and checked against its SHA-256.

    `folder` (or `$EGOTOUCH_HAND_MESH_DIR`) names a local folder with `left.glb` and `right.glb` to use instead.
    Raises `SourceError` when npm is missing or fails, or when a file is not the pinned one.
    """
    side = Handedness(side)
    local = folder or (Path(os.environ[MESH_DIR_VARIABLE]) if os.environ.get(MESH_DIR_VARIABLE) else None)
    if local is None:
        local = cache_dir() / f"generic-hand-{VERSION}"
        if not (local / f"{side}.glb").is_file():
            _fetch(local)
    path = local / f"{side}.glb"
    _check(path, side)
    return path


def _check(path: Path, side: Handedness) -> None:
    if not path.is_file():
        hint = f"Put {side}.glb of {PACKAGE} {VERSION} there or unset {MESH_DIR_VARIABLE}"
        raise SourceError(f"hand mesh {path} does not exist", hint=hint)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    if digest != SHA256[side]:
        message = f"hand mesh {path} is not the one of {PACKAGE} {VERSION} (SHA-256 {digest[:12]}...)"
        raise SourceError(message, hint="Delete it to fetch it again")


def _fetch(target: Path) -> None:
    npm = shutil.which("npm")
    by_hand = f"Run `npm pack {PACKAGE}@{VERSION}` elsewhere, unpack {FOLDER} and set {MESH_DIR_VARIABLE} to that folder"
    if npm is None:
        hint = f"Install Node.js 20 or later. Or: {by_hand}"
        raise SourceError("the hand meshes are fetched with npm, which is not installed", hint=hint)
    with tempfile.TemporaryDirectory(dir=cache_dir()) as scratch:
        command = [npm, "pack", f"{PACKAGE}@{VERSION}", "--pack-destination", scratch, "--silent"]
        try:
            subprocess.run(command, check=True, capture_output=True, text=True, timeout=_FETCH_TIMEOUT_S)
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
            reason = str(error.stderr or error).strip().splitlines()[-1]
            raise SourceError(f"npm could not fetch {PACKAGE} {VERSION}: {reason}", hint=f"Check the network. Or: {by_hand}") from error
        with tarfile.open(next(Path(scratch).glob("*.tgz"))) as archive:
            for side in Handedness:
                member = archive.extractfile(f"{FOLDER}/{side}.glb")
                if member is None:
                    raise SourceError(f"{PACKAGE} {VERSION} holds no {side}.glb", hint=by_hand)
                (Path(scratch) / f"{side}.glb").write_bytes(member.read())
        target.mkdir(parents=True, exist_ok=True)
        for side in Handedness:
            (Path(scratch) / f"{side}.glb").replace(target / f"{side}.glb")
