"""Shared by the tests of synthetic hands: the two hand meshes, and a cache folder of the test's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from egotouch_sdk.errors import SourceError


@pytest.fixture(scope="session")
def mesh_dir() -> Path:
    """Folder with both hand meshes; fetched when needed, the test is skipped where that is impossible."""
    pytest.importorskip("pygltflib", reason="needs the extra [synthetic]")
    assets = pytest.importorskip("egotouch_sdk.synthetic.assets", reason="needs the extra [synthetic]")
    try:
        return assets.hand_mesh_path("left").parent
    except SourceError as error:
        pytest.skip(f"the hand meshes cannot be fetched: {error}")


@pytest.fixture
def own_cache(tmp_path: Path, mesh_dir: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache folder for one test, with the meshes still at hand."""
    monkeypatch.setenv("EGOTOUCH_CACHE", str(tmp_path))
    monkeypatch.setenv("EGOTOUCH_HAND_MESH_DIR", str(mesh_dir))
    return tmp_path
