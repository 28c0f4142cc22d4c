"""Fetching the hand meshes: local folder, checksum, missing npm."""

from __future__ import annotations

from pathlib import Path

import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.synthetic import assets


def test_local_folder_is_used_and_checked(mesh_dir: Path, tmp_path: Path) -> None:
    for side in ("left", "right"):
        (tmp_path / f"{side}.glb").write_bytes((mesh_dir / f"{side}.glb").read_bytes())
    assert assets.hand_mesh_path("right", tmp_path) == tmp_path / "right.glb"
    (tmp_path / "left.glb").write_bytes((mesh_dir / "right.glb").read_bytes())
    with pytest.raises(SourceError, match="is not the one of"):
        assets.hand_mesh_path("left", tmp_path)


def test_missing_local_file_names_the_variable(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=assets.MESH_DIR_VARIABLE):
        assets.hand_mesh_path("left", tmp_path)


def test_missing_npm_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(assets.MESH_DIR_VARIABLE, raising=False)
    monkeypatch.setenv("EGOTOUCH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SourceError, match=r"Install Node\.js"):
        assets.hand_mesh_path("left")


@pytest.mark.skipif(not Path("/bin/sh").exists(), reason="writes a shell script")
def test_failing_npm_gives_its_own_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    npm = tmp_path / "npm"
    npm.write_text("#!/bin/sh\necho 'npm error code ENOTFOUND' >&2\nexit 1\n")
    npm.chmod(0o755)
    monkeypatch.delenv(assets.MESH_DIR_VARIABLE, raising=False)
    monkeypatch.setenv("EGOTOUCH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SourceError, match="ENOTFOUND"):
        assets.hand_mesh_path("left")
