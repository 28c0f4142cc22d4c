"""Joints, fingers and sides: MediaPipe's 21 names and order inside, WebXR names at the edge."""

from __future__ import annotations

from enum import IntEnum, StrEnum


class HandJoint(IntEnum):
    """The 21 hand landmarks in MediaPipe's order (google-ai-edge/mediapipe, `HandLandmark`)."""

    WRIST = 0
    THUMB_CMC = 1
    THUMB_MCP = 2
    THUMB_IP = 3
    THUMB_TIP = 4
    INDEX_FINGER_MCP = 5
    INDEX_FINGER_PIP = 6
    INDEX_FINGER_DIP = 7
    INDEX_FINGER_TIP = 8
    MIDDLE_FINGER_MCP = 9
    MIDDLE_FINGER_PIP = 10
    MIDDLE_FINGER_DIP = 11
    MIDDLE_FINGER_TIP = 12
    RING_FINGER_MCP = 13
    RING_FINGER_PIP = 14
    RING_FINGER_DIP = 15
    RING_FINGER_TIP = 16
    PINKY_MCP = 17
    PINKY_PIP = 18
    PINKY_DIP = 19
    PINKY_TIP = 20


NUM_JOINTS = 21


class Finger(StrEnum):
    """A finger of the touching hand."""

    THUMB = "thumb"
    INDEX = "index"
    MIDDLE = "middle"
    RING = "ring"
    PINKY = "pinky"

    @property
    def chain(self) -> tuple[HandJoint, HandJoint, HandJoint, HandJoint]:
        """The finger's four joints from base to tip (thumb: CMC, MCP, IP, TIP)."""
        first = 1 + 4 * FINGERS.index(self)
        return HandJoint(first), HandJoint(first + 1), HandJoint(first + 2), HandJoint(first + 3)

    @property
    def dip(self) -> HandJoint:
        """The last joint before the tip (the thumb's IP)."""
        return self.chain[2]

    @property
    def tip(self) -> HandJoint:
        """The fingertip landmark, about 4 mm short of the finger's end."""
        return self.chain[3]


FINGERS: tuple[Finger, ...] = tuple(Finger)


class Handedness(StrEnum):
    """The wearer's own left or right hand, whatever the image's mirroring."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def other(self) -> Handedness:
        """The opposite side."""
        return Handedness.LEFT if self is Handedness.RIGHT else Handedness.RIGHT


#: WebXR joint name for each of the 21 (WebXR Hand Input names a joint after the bone beyond it).
#: WebXR's four finger metacarpals have no MediaPipe twin and are absent.
WEBXR_NAMES: tuple[str, ...] = (
    "wrist",
    "thumb-metacarpal",
    "thumb-phalanx-proximal",
    "thumb-phalanx-distal",
    "thumb-tip",
    *(
        f"{finger}-finger-{part}"
        for finger in ("index", "middle", "ring", "pinky")
        for part in ("phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")
    ),
)

#: Index into WebXR's 25 joints (spec order) for each of MediaPipe's 21.
WEBXR_INDEX: tuple[int, ...] = (0, 1, 2, 3, 4, *(5 + 5 * f + k for f in range(4) for k in (1, 2, 3, 4)))
