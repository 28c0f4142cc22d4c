"""Renders the study round by round, on processes of this machine or on a cluster; stop and start it as you like."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.jobs import Batch, BatchResult, Runner, Task, run_jobs
from egotouch_sdk.observation import PATCH_MM, PATCH_PX
from egotouch_sdk.study_data import RECIPE_FILE, StudyRecipe, round_name, write_recipe, write_round
from egotouch_sdk.synthetic.participants import PARTICIPANTS
from egotouch_sdk.synthetic.stage import ImpossibleSceneError
from egotouch_sdk.synthetic.study_plan import FPS, RoundPlan, plan_study
from egotouch_sdk.synthetic.study_round import SAMPLES, render_round


@dataclass(frozen=True, slots=True)
class StudyJob:
    """What a study is made of; the same job gives the same rounds whatever renders them, and in which order.

    `participants` 1..15, `rounds` 1..36 of each, `seconds` per round, `samples` light paths per pixel. Raises `ConfigError`.
    """

    seed: int
    participants: int
    rounds: int
    seconds: float
    samples: int = SAMPLES

    def __post_init__(self) -> None:
        self.plans()

    def plans(self) -> list[RoundPlan]:
        """All rounds in the order to render them."""
        try:
            return plan_study(self.seed, self.participants, self.rounds, self.seconds)
        except ValueError as wrong:
            raise ConfigError(f"there is no such study: {wrong}", hint="See egotouch synth study --help") from wrong

    @property
    def recipe(self) -> StudyRecipe:
        """What `study.json` says about it."""
        people = PARTICIPANTS[: self.participants]
        return StudyRecipe(
            seed=self.seed,
            fps=FPS,
            participants=self.participants,
            rounds=self.rounds,
            seconds_per_round=self.seconds,
            sizes={"patch_px": [PATCH_PX, PATCH_PX], "patch_mm": PATCH_MM},
            details={
                "command": "egotouch synth study",
                "samples": self.samples,
                "fitzpatrick": [person.fitzpatrick for person in people],
                "hair": [str(person.hair) for person in people],
            },
        )


def run_study(job: StudyJob, out: Path, runner: Runner, report: Callable[[str], None]) -> BatchResult:
    """Render every missing round of `job` into `out`; the result's `counted` is the number of new frames.

    `report` gets one line per finished round. Raises `ConfigError` when `out` holds another study.
    """
    _claim(job, out)
    tasks = tuple(Task(round_name(plan.participant, plan.number), make_round, (plan, job.samples)) for plan in job.plans())
    return run_jobs(Batch(f"study-{job.seed}", out, tasks, "rounds", "frames"), runner, report)


def make_round(path: Path, plan: RoundPlan, samples: int) -> int:
    """Render one round, write it to `path` and return its number of frames; raises `SourceError` when no scene is possible."""
    try:
        rendered = render_round(plan, samples)
    except ImpossibleSceneError as problem:
        raise SourceError(f"participant {plan.participant}, round {plan.number}: {problem}", hint="Use another --seed") from problem
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=f"{path.stem}.") as folder:
        write_round(Path(folder), rendered).replace(path)
    return plan.frames


def _claim(job: StudyJob, out: Path) -> None:
    path = out / RECIPE_FILE
    if not path.exists():
        write_recipe(out, job.recipe)
        return
    there = path.read_text(encoding="utf-8")
    if json.loads(there) != json.loads(json.dumps(asdict(job.recipe))):
        raise ConfigError(f"{out} holds another study: {' '.join(there.split())}", hint="Use another folder or the same numbers")
