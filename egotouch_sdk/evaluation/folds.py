"""Which model scores whom: in a leave-participants-out study, one that never saw them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from egotouch_sdk.errors import SourceError

_FORM = '{"folds": [{"participants": [0, 1], "model": "fold-0/touch.onnx"}, ...]}'


@dataclass(frozen=True, slots=True)
class Folds:
    """The model file of every participant; `shared` is that of all others, and None in it the shipped one.

    Without `by_participant` one model scores all: it must then have been trained on other people than the study's.
    """

    by_participant: Mapping[int, Path]
    shared: Path | None = None

    @property
    def are_held_out(self) -> bool:
        """True when each participant has a model by name."""
        return bool(self.by_participant)

    def model_of(self, participant: int) -> Path | None:
        """The model file for one participant; None is the shipped model."""
        return self.by_participant.get(participant, self.shared)

    def check(self, participants: Iterable[int]) -> None:
        """Raise `SourceError` naming a participant without a fold."""
        missing = sorted(set(participants) - set(self.by_participant))
        if self.are_held_out and missing:
            raise SourceError(f"participants {', '.join(map(str, missing))} are in no fold", hint=f"Add them: {_FORM}")


def read_folds(path: Path) -> Folds:
    """Read a folds file; model files are relative to it. Raises `SourceError` naming what is wrong."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        entries = [(int(number), path.parent / str(fold["model"])) for fold in content["folds"] for number in fold["participants"]]
    except OSError as problem:
        raise SourceError(f"cannot read {path} ({problem.strerror})", hint="Check the path of --folds") from problem
    except (ValueError, KeyError, TypeError) as problem:
        raise SourceError(f"{path} is not a folds file ({type(problem).__name__}: {problem})", hint=f"Its form is {_FORM}") from problem
    by_participant = dict(entries)
    if not entries or len(by_participant) < len(entries):
        what = "holds no participants" if not entries else "has a participant in two folds"
        raise SourceError(f"{path} {what}", hint=f"Its form is {_FORM}")
    if gone := sorted({str(model) for model in by_participant.values() if not model.is_file()}):
        raise SourceError(f"{path} names {gone[0]}, which is not there", hint="Train that fold first, or correct the path")
    return Folds(by_participant)
