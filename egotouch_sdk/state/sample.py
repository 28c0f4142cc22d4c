"""What the state machine is told about one fingertip in one frame."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import Fingertip, HostPoint, TouchEstimate


@dataclass(frozen=True, slots=True)
class FingertipSample:
    """A fingertip near the host limb.

    `touch_probability` 0..1 and `force_n` are filtered, `force_sigma_n` is the force's standard error where the model tells it.
    `tip_px` and `px_per_mm` place it in the image, `image_xy` is the same place in 0..1 from the top left, `point` its place on
    the host limb.
    """

    hand_id: int
    handedness: Handedness
    finger: Finger
    touch_probability: float
    force_n: float
    tip_px: tuple[float, float]
    px_per_mm: float
    image_xy: tuple[float, float]
    point: HostPoint
    force_sigma_n: float | None = None

    @classmethod
    def join(cls, size_px: tuple[int, int], tip: Fingertip, estimate: TouchEstimate, point: HostPoint) -> FingertipSample:
        """Bring together what the stages found out about one fingertip in an image of `size_px` (width, height)."""
        x_px, y_px = tip.tip_px
        return cls(
            hand_id=tip.hand_id,
            handedness=tip.handedness,
            finger=tip.finger,
            touch_probability=estimate.touch_probability,
            force_n=estimate.force_n,
            force_sigma_n=estimate.force_sigma_n,
            tip_px=tip.tip_px,
            px_per_mm=tip.px_per_mm,
            image_xy=((x_px + 0.5) / size_px[0], (y_px + 0.5) / size_px[1]),
            point=point,
        )
