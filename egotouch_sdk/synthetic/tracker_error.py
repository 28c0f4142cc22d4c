"""How a hand tracker misplaces a fingertip over time: a part that stays for a while and a part that flickers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

#: Standard deviations of tip error per image axis (mm), of direction (rad) and of log scale: (lasting, flickering). Together the tip
#: misses by 1.9 mm in the median and 3.9 mm at p90, as MediaPipe Hands 0.10.21 did on rendered frames.
_TIP_MM = (1.35, 0.85)
_TURN_RAD = (0.06, 0.03)
_LOG_SCALE = (0.07, 0.03)
#: Correlation times of both parts in seconds (our choice: a pose's bias, and noise from frame to frame).
_LASTING_S, _FLICKER_S = 1.5, 0.05
#: Bounds, those of the training camera: 4.8 mm, 12 degrees, scale 0.75 to 1.3.
_MAX_MM, _MAX_TURN_RAD, _SCALE = 4.8, 0.21, (0.75, 1.3)


@dataclass(frozen=True, slots=True, eq=False)
class TrackerError:
    """Per frame: `tip_mm` (T, 2) in the image (right, up), `turn_rad` (T,), `scale` (T,) of the patch, 1 = exact."""

    tip_mm: npt.NDArray[np.float64]
    turn_rad: npt.NDArray[np.float64]
    scale: npt.NDArray[np.float64]


def draw_tracker_error(rng: np.random.Generator, frames: int, fps: float) -> TrackerError:
    """Errors of `frames` frames at `fps`; never depends on what the finger does."""

    def channel(sigmas: tuple[float, float]) -> npt.NDArray[np.float64]:
        return _process(rng, frames, fps, sigmas[0], _LASTING_S) + _process(rng, frames, fps, sigmas[1], _FLICKER_S)

    tip_mm = np.stack([channel(_TIP_MM), channel(_TIP_MM)], 1)
    return TrackerError(
        np.clip(tip_mm, -_MAX_MM, _MAX_MM),
        np.clip(channel(_TURN_RAD), -_MAX_TURN_RAD, _MAX_TURN_RAD),
        np.clip(np.exp(channel(_LOG_SCALE)), *_SCALE),
    )


def _process(rng: np.random.Generator, frames: int, fps: float, sigma: float, correlation_s: float) -> npt.NDArray[np.float64]:
    """First-order autoregressive noise of standard deviation `sigma` from the first frame on."""
    keep = float(np.exp(-1.0 / (fps * correlation_s)))
    fresh = rng.normal(0.0, sigma, frames)
    values = np.empty(frames)
    values[0] = fresh[0]
    for k in range(1, frames):
        values[k] = keep * values[k - 1] + np.sqrt(1 - keep**2) * fresh[k]
    return values
