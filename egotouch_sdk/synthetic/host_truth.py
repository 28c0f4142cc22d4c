"""What is true about the host frame of a posed scene, and views of it that show both hands."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2
from typing import Any

import numpy as np

from egotouch_sdk.joints import Finger, HandJoint
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.surface import Surface
from egotouch_sdk.synthetic.linalg import Array, reject_from, unit
from egotouch_sdk.synthetic.render import Camera
from egotouch_sdk.synthetic.stage import Stage, Touch

WIDTH_PX, HEIGHT_PX = 640, 480
#: Horizontal fields of view: head-mounted cameras of the paper's kind have 60 to 80 degrees.
_FOV_DEG = (58.0, 80.0)
_MARGIN_PX = 12
_CAMERA_DRAWS = 20


@dataclass(frozen=True, slots=True)
class HostTruth:
    """One view of a scene: landmarks (21, 3) of both hands in mm in the camera's axes (x right, y down, z away), and the answer.

    The host is a left hand, the touching one a right hand. `focal_px` belongs to a 640 x 480 px picture.
    """

    participant: int
    finger: Finger
    host_mm: Array
    touching_mm: Array
    focal_px: float
    force_n: float
    hover_mm: float
    point: HostPoint

    @property
    def palm_mm(self) -> float:
        """The wearer's length wrist to middle MCP."""
        return float(np.linalg.norm(self.host_mm[HandJoint.MIDDLE_FINGER_MCP] - self.host_mm[HandJoint.WRIST]))

    def landmarks_px(self, landmarks_mm: Array) -> Array:
        """Landmarks (21, 3) as MediaPipe gives them: pixels, and z at the wrist's scale relative to the wrist."""
        z = landmarks_mm[:, 2:]
        xy = landmarks_mm[:, :2] / z * self.focal_px + ((WIDTH_PX - 1) / 2, (HEIGHT_PX - 1) / 2)
        return np.hstack([xy, (z - z[0]) / z[0] * self.focal_px])

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields."""
        point = self.point
        return {
            "participant": self.participant,
            "finger": str(self.finger),
            "host_mm": self.host_mm.round(2).tolist(),
            "touching_mm": self.touching_mm.round(2).tolist(),
            "focal_px": round(self.focal_px, 2),
            "force_n": round(self.force_n, 3),
            "hover_mm": round(self.hover_mm, 2),
            "point": [str(point.surface), *(round(v, 4) for v in (point.x_mm, point.y_mm, point.pitch_rad, point.yaw_rad))],
        }

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> HostTruth:
        """The inverse of `to_dict`."""
        surface, *numbers = values["point"]
        return cls(
            values["participant"],
            Finger(values["finger"]),
            np.array(values["host_mm"]),
            np.array(values["touching_mm"]),
            values["focal_px"],
            values["force_n"],
            values["hover_mm"],
            HostPoint(Surface(surface), *numbers),
        )


def host_point(stage: Stage, touch: Touch) -> HostPoint:
    """The exact answer: the contact point (while hovering, the skin below the fingertip) and the finger DIP to TIP against its skin."""
    host, finger = stage.host_landmarks_m, stage.plan.finger
    wrist = host[HandJoint.WRIST]
    along = unit(host[HandJoint.MIDDLE_FINGER_MCP] - wrist)
    thumbwards = reject_from(host[HandJoint.INDEX_FINGER_MCP] - host[HandJoint.PINKY_MCP], along)
    at_mm = (stage.contact - wrist) * 1e3
    axis = unit(touch.landmarks_m[finger.tip] - touch.landmarks_m[finger.dip])
    level = reject_from(along, stage.normal)
    across = np.cross(level, stage.normal)
    across = across * np.sign(across @ thumbwards)
    pitch = float(np.arcsin(np.clip(-axis @ stage.normal, 0, 1)))
    return HostPoint(
        Surface(stage.plan.place), float(at_mm @ thumbwards), float(at_mm @ along), pitch, atan2(float(axis @ across), float(axis @ level))
    )


def draw_camera(rng: np.random.Generator, stage: Stage, touch: Touch) -> Camera | None:
    """A camera in which the host hand, the wrist and the index finger of the touching hand are all in view; None when none is found."""
    middle = np.vstack([stage.host_landmarks_m, stage.contact[None]])
    points = np.vstack([middle, touch.landmarks_m])
    for _ in range(_CAMERA_DRAWS):
        distance = rng.uniform(0.26, 0.52)
        origin = stage.contact + stage.aim.view * distance
        target = (points.max(0) + points.min(0)) / 2 + rng.normal(0, 0.015, 3)
        camera = Camera(origin, target, stage.aim.up, float(np.radians(rng.uniform(*_FOV_DEG))), WIDTH_PX, HEIGHT_PX)
        at = camera.project(points)[:, :2]
        if (at > _MARGIN_PX).all() and (at < (WIDTH_PX - _MARGIN_PX, HEIGHT_PX - _MARGIN_PX)).all():
            return camera
    return None


def view_of(stage: Stage, touch: Touch, camera: Camera, participant: int) -> HostTruth:
    """The scene in the camera's axes with its answer."""
    forward = unit(camera.target - camera.origin)
    right = unit(np.cross(forward, camera.up))
    axes = np.stack([right, np.cross(forward, right), forward], 1)
    host, touching = ((points - camera.origin) @ axes * 1e3 for points in (stage.host_landmarks_m, touch.landmarks_m))
    focal_px = float(camera.width_px / 2 / np.tan(camera.fov_rad / 2))
    return HostTruth(participant, stage.plan.finger, host, touching, focal_px, touch.force_n, touch.hover_mm, host_point(stage, touch))
