"""What the state machine is told about one fingertip in one frame."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.frame import Frame
from egotouch_sdk.hand_geometry import host_frame_xy
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch, HandObservation, TouchEstimate


@dataclass(frozen=True, slots=True)
class FingertipSample:
    """A fingertip near the host limb.

    `touch_probability` 0..1 and `force_n` are filtered. `tip_px` and `px_per_mm` place it in the image, `image_xy` is the same
    place in 0..1 from the top left. `host_palms` is the tip in the host's frame in palm lengths (see `TouchEvent`), None when
    the host has no usable axis.
    """

    hand_id: int
    handedness: Handedness
    finger: Finger
    touch_probability: float
    force_n: float
    tip_px: tuple[float, float]
    px_per_mm: float
    image_xy: tuple[float, float]
    host_palms: tuple[float, float] | None

    @classmethod
    def join(cls, frame: Frame, host: HandObservation, patch: FingertipPatch, estimate: TouchEstimate) -> FingertipSample:
        """Bring together what the stages found out about one fingertip."""
        x_px, y_px = patch.tip_px
        return cls(
            hand_id=patch.hand_id,
            handedness=patch.handedness,
            finger=patch.finger,
            touch_probability=estimate.touch_probability,
            force_n=estimate.force_n,
            tip_px=patch.tip_px,
            px_per_mm=patch.px_per_mm,
            image_xy=((x_px + 0.5) / frame.width_px, (y_px + 0.5) / frame.height_px),
            host_palms=host_frame_xy(host, patch.tip_px),
        )
