"""What a touch model says about real pictures: as the frames of a film, or each picture alone. The host is unknown."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

from egotouch_sdk.config import TouchModelConfig
from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.real_patches import LABELS_FILE, RealPatch
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch, TouchEstimate
from egotouch_sdk.touch import TouchModel, TouchStream

#: Patches per call of the model.
BATCH = 64
#: Frames per second of a film whose pictures are numbered one by one (the thumb study's camera).
FILM_FPS = 30.0


def estimate_stills(patches: Sequence[RealPatch], model: TouchModel) -> list[TouchEstimate]:
    """The model's answers to pictures judged alone."""
    shown = [_fingertip(patch) for patch in patches]
    return [estimate for start in range(0, len(shown), BATCH) for estimate in model.estimate(shown[start : start + BATCH])]


def estimate_film(patches: Sequence[RealPatch], model: TouchModel) -> list[TouchEstimate]:
    """The model's answers, in the order given, to pictures that are the numbered frames of one film per recording, at 30 per second.

    The finger is remembered as long as the default settings say. Raises `SourceError` for a picture without a number of its own.
    """
    times_ns = [round(number * 1e9 / FILM_FPS) for number in _frame_numbers(patches)]
    memory_ms = TouchModelConfig().memory_ms
    streams: defaultdict[str, TouchStream] = defaultdict(lambda: TouchStream(model, memory_ms))
    told: dict[int, TouchEstimate] = {}
    for place in sorted(range(len(patches)), key=times_ns.__getitem__):
        (told[place],) = streams[patches[place].recording].estimate([_fingertip(patches[place])], times_ns[place])
    return [told[place] for place in range(len(patches))]


def _frame_numbers(patches: Sequence[RealPatch]) -> list[int]:
    hint = f"Number the frames of each film in {LABELS_FILE}, or judge every picture alone with --stills"
    for (recording, frame), count in Counter((patch.recording, patch.frame) for patch in patches).items():
        if frame is None:
            raise SourceError(f"a picture of recording {recording} has no whole frame number", hint=hint)
        if count > 1:
            raise SourceError(f"recording {recording} has frame {frame} {count} times", hint=hint)
    return [patch.frame for patch in patches if patch.frame is not None]


def _fingertip(patch: RealPatch) -> FingertipPatch:
    return FingertipPatch(
        hand_id=0, handedness=Handedness.RIGHT, finger=Finger.THUMB, tip_px=(0.0, 0.0), px_per_mm=1.0, image=patch.image
    )
