"""A headset's own hands, from messages and into the pipeline."""

from __future__ import annotations

from math import hypot

from egotouch_sdk.errors import FrameError, ProtocolError
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.hands.pushed import NUM_WEBXR_JOINTS, hand_from_joints
from egotouch_sdk.joints import NUM_JOINTS
from egotouch_sdk.observation import HandObservation
from egotouch_sdk.wire import enums
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

Hands = tuple[HandObservation, ...]
#: Joints by how many numbers `world_mm` has.
_JOINTS_BY_SIZE = {3 * count: count for count in (NUM_JOINTS, NUM_WEBXR_JOINTS)}
_MM_PER_M = 1000.0
#: Sizes between which a hand lies, far beyond any real one: half the diagonal of its bounding box (our choice).
_WORLD_MM = (10.0, 500.0)
_IMAGE_PX = (1.0, 8192.0)
#: Farther from the image's corner no joint is.
_FARTHEST_PX = 16384.0


def hands_from_message(message: pb.ClientHands) -> Hands:
    """The hands in a message; raises `ProtocolError` for values that are missing, unknown, not finite or of another number."""
    hands = tuple(_hand(hand) for hand in message.hands)
    if len({hand.handedness for hand in hands}) < len(hands):
        raise ProtocolError("two pushed hands are of the same side", hint="Push at most one left and one right hand of the wearer")
    return hands


def _hand(message: pb.Hand) -> HandObservation:
    count = _JOINTS_BY_SIZE.get(len(message.world_mm), 0)
    columns = len(message.landmarks_px) // count if count else 0
    if columns not in (2, 3) or len(message.landmarks_px) != columns * count:
        raise ProtocolError(
            f"a hand has {len(message.landmarks_px)} numbers in landmarks_px and {len(message.world_mm)} in world_mm",
            hint="Give (x, y) or (x, y, z) and (x, y, z) of MediaPipe's 21 joints or WebXR's 25",
        )
    pixels = [list(message.landmarks_px[i : i + columns]) for i in range(0, columns * count, columns)]
    metres = [[value / _MM_PER_M for value in message.world_mm[i : i + 3]] for i in range(0, 3 * count, 3)]
    _refuse_absurd(pixels, "landmarks_px", _IMAGE_PX)
    _refuse_absurd([[_MM_PER_M * value for value in joint] for joint in metres], "world_mm", _WORLD_MM)
    try:
        return hand_from_joints(enums.HANDEDNESS.member(message.handedness), pixels, metres, score=message.score or 1.0)
    except FrameError as error:
        raise ProtocolError(error.message, hint=error.hint) from error


def _refuse_absurd(points: list[list[float]], name: str, sizes: tuple[float, float]) -> None:
    """Whatever passes can be computed with; comparisons with NaN are false and refuse it too."""
    size = hypot(*(max(axis) - min(axis) for axis in zip(*points, strict=True))) / 2
    if not (sizes[0] <= size <= sizes[1] and all(abs(value) <= _FARTHEST_PX for point in points for value in point)):
        raise ProtocolError(f"{name} is no hand: {size:.3g} in size or too far away", hint="Give pixels and millimetres")


class HeadsetHands:
    """A `HandSource`: the hands that came with a frame, else those that `tracker` finds in it."""

    def __init__(self, tracker: HandSource) -> None:
        self.own: Hands | None = None
        self._tracker = tracker

    def track(self, frame: Frame) -> Hands:
        """The hands in this frame."""
        return self._tracker.track(frame) if self.own is None else self.own

    def reset(self) -> None:
        """Forget everything seen so far."""
        self.own = None
        self._tracker.reset()
