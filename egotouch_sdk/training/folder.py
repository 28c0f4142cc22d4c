"""Reads a folder of rendered shards, patches or films."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.synthetic.film_shards import PATTERN as FILMS
from egotouch_sdk.training.films import RenderedFilm, read_films
from egotouch_sdk.training.shards import RenderedPatch, read_shard

Rendered = RenderedPatch | RenderedFilm


def read_folder(folder: Path) -> list[Rendered]:
    """All patches, or all films, of all shards in a folder, in name order; raises `SourceError` when there are none, or both."""
    films, shards = sorted(folder.glob(FILMS)), sorted(folder.glob("*.npz"))
    if films and len(films) < len(shards):
        raise SourceError(f"{folder} holds films and patches", hint="Train on one of them: keep them in folders of their own")
    with ThreadPoolExecutor() as readers:
        read: list[Rendered] = []
        for shard in readers.map(read_films, films) if films else readers.map(read_shard, shards):
            read += shard
    if not read:
        raise SourceError(f"no rendered patches in {folder}", hint="Render some first: egotouch synth patches --help, or synth films")
    return read
