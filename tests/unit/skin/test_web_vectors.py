"""What the web client's skin views are held to is what this package's do now."""

from __future__ import annotations

from pathlib import Path
from runpy import run_path

FOLDER = Path(__file__).parents[3] / "clients" / "web" / "test" / "skin"


def test_vectors_are_those_of_this_package() -> None:
    made = run_path(str(FOLDER / "make_vectors.py"))["text"]()

    assert made == (FOLDER / "vectors.json").read_text(encoding="utf-8"), "run: python clients/web/test/skin/make_vectors.py"
