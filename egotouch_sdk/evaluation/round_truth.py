"""What truly happened in a round of a study, or in a recording of a data set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.evaluation.confusion import Bools
from egotouch_sdk.joints import Finger
from egotouch_sdk.study_data import Hair, RoundMeta, StudyRound, TouchType
from egotouch_sdk.surface import Surface


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """What truly happened in the T frames of a round, or of a recording of a data set.

    `participant` and `name` tell whose and which it is, `conditions` its value of each condition ("skin tone": "III");
    `is_hover` and `is_drag` say that the participant was asked to hover or to drag. `force_n` and `hover_mm` (T,) are nan where
    nobody measured. `gate` (T,) is True where the touch model had a patch to look at.
    """

    participant: str
    name: str
    conditions: Mapping[str, str]
    is_hover: bool
    is_drag: bool
    fps: float
    timestamp_ns: npt.NDArray[np.int64]
    touch: Bools
    force_n: npt.NDArray[np.floating]
    hover_mm: npt.NDArray[np.floating]
    gate: Bools

    @classmethod
    def of(cls, study_round: StudyRound) -> Truth:
        """The truth of a round of a study."""
        meta = study_round.meta
        return cls(
            participant=f"p{meta.participant:02d}",
            name=f"r{meta.round:03d}",
            conditions=_conditions(meta),
            is_hover=meta.touch_type is TouchType.HOVER,
            is_drag=meta.touch_type is TouchType.DRAG,
            fps=meta.fps,
            timestamp_ns=study_round.timestamp_ns,
            touch=study_round.touch,
            force_n=study_round.force_n,
            hover_mm=study_round.hover_mm,
            gate=study_round.gate,
        )


#: Values of conditions in the order in which they are told; all others follow by name.
ORDER = ("I", "II", "III", "IV", "V", "VI", *Hair, *Surface, *TouchType, *Finger)


def _conditions(meta: RoundMeta) -> dict[str, str]:
    return {
        "skin tone": ("I", "II", "III", "IV", "V", "VI")[meta.fitzpatrick - 1],
        "hair": meta.hair.value,
        "place": meta.place.value,
        "touch type": meta.touch_type.value,
        "light": meta.light,
        "setting": "outdoors" if meta.outdoors else "indoors",
        "motion": "walking" if meta.walking else "still",
        "finger": meta.finger.value,
        "touching hand": meta.touching_hand.value,
    }
