"""A finger that moves over skin in one light, and what a camera that looks at its tip is shown: study rounds and training films."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import HandJoint
from egotouch_sdk.patches import PATCH_PX_PER_MM, polar
from egotouch_sdk.synthetic.camera import LightLayers
from egotouch_sdk.synthetic.finger_motion import FingerMotion, FingerPath
from egotouch_sdk.synthetic.lights import Lights
from egotouch_sdk.synthetic.linalg import Array, reject_from, unit
from egotouch_sdk.synthetic.render import Backdrop, Camera, render_layers
from egotouch_sdk.synthetic.shards import light_layers
from egotouch_sdk.synthetic.stage import Stage, Touch

#: Side of what is rendered, in pixels at 2.5 per mm: the 100 px patch and 16 px around it for a tracker's errors.
FRAME_PX = 132
#: Colour of a nail and of pressed skin follows force with a time constant in this range, seconds (0.2 to 1 s in reference measurements).
BLANCH_S = (0.2, 0.6)
_BLANCH_STEP_S = 1 / 300
#: A frame that differs from the last rendered one by less than this is shown by the same picture: sideways (0.4 patch pixels), in
#: height, in tilt, and in force relative to it and absolutely (our choice; the camera's own jitter and noise are drawn per frame).
_STILL_MM, _STILL_HEIGHT_MM, _STILL_TILT_RAD, _STILL_FORCE, _STILL_N = 0.15, 0.05, 0.005, 0.06, 0.02
#: Change of the lagging force that a nail's colour shows before it is rendered anew.
_STILL_COLOUR_N = 0.12


@dataclass(frozen=True, slots=True)
class MovingScene:
    """Everything that stays the same while the finger moves; `blanch_s` is the time constant of the skin's colour."""

    stage: Stage
    lights: Lights
    backdrop: Backdrop
    motion: FingerMotion
    blanch_s: float


@dataclass(frozen=True, slots=True, eq=False)
class Footage:
    """Frames (T) of a scene before the camera: `layers` of the pictures that differ and the one that each frame shows.

    `cameras` (T) look exactly at the tip, `path` (T) is the truth, `velocity_px` (T, 2) the tip's in the picture, px per second at
    2.5 px/mm, right and down.
    """

    path: FingerPath
    layers: list[LightLayers]
    shown: list[int]
    cameras: list[Camera]
    velocity_px: Array


def film(scene: MovingScene, times_s: Array, samples: int, seed: int) -> Footage:
    """Render the scene at times (T,) in seconds, rising; `samples` light paths per pixel."""
    stage, path = scene.stage, scene.motion.at(times_s)
    colour_n = _lagging_force(scene.motion, times_s, scene.blanch_s)
    layers: list[LightLayers] = []
    shown: list[int] = []
    cameras: list[Camera] = []
    last = -1
    for k in range(len(times_s)):
        touch = _posed(stage, path, k, float(colour_n[k]))
        cameras.append(_camera(stage, touch))
        if last < 0 or not _looks_same(path, colour_n, last, k):
            rendered = render_layers(
                touch.host, touch.touching, scene.lights, stage.contact, scene.backdrop, [cameras[-1]], samples, seed % 10**6 * 1000 + k
            )
            layers.append(light_layers(rendered[0]))
            last = k
        shown.append(len(layers) - 1)
    return Footage(path, layers, shown, cameras, _velocity_px(scene, times_s, cameras))


def _looks_same(path: FingerPath, colour_n: Array, before: int, now: int) -> bool:
    force_n = path.force_n[[before, now]]
    return bool(
        path.touch[before] == path.touch[now]
        and np.hypot(*(path.at_mm[now] - path.at_mm[before])) <= _STILL_MM
        and abs(path.hover_mm[now] - path.hover_mm[before]) <= _STILL_HEIGHT_MM
        and abs(path.tilt_rad[now] - path.tilt_rad[before]) <= _STILL_TILT_RAD
        and abs(force_n[1] - force_n[0]) <= _STILL_FORCE * force_n[0] + _STILL_N
        and abs(colour_n[now] - colour_n[before]) <= _STILL_COLOUR_N
    )


def _posed(stage: Stage, path: FingerPath, k: int, colour_n: float) -> Touch:
    along, across = path.at_mm[k] * 1e-3
    return stage.moved(float(path.force_n[k]), float(path.hover_mm[k]), (float(along), float(across)), float(path.tilt_rad[k]), colour_n)


def _lagging_force(motion: FingerMotion, times_s: Array, constant_s: float) -> Array:
    """Force behind a first-order low-pass at `times_s` (T,)."""
    fine_s = np.arange(0.0, float(times_s[-1]) + _BLANCH_STEP_S, _BLANCH_STEP_S)
    force = motion.at(fine_s).force_n
    lagging, value = np.empty(len(fine_s)), 0.0
    for k, now in enumerate(force):
        value += (now - value) * _BLANCH_STEP_S / constant_s
        lagging[k] = value
    return np.asarray(np.interp(times_s, fine_s, lagging))


def _camera(stage: Stage, touch: Touch) -> Camera:
    """A camera with the tip in its centre and the finger up."""
    finger = stage.plan.finger
    tip, dip = touch.landmarks_m[finger.tip], touch.landmarks_m[finger.dip]
    origin = stage.contact + stage.aim.view * stage.plan.distance_m
    up = reject_from(tip - dip, unit(tip - origin))
    width_m = FRAME_PX / PATCH_PX_PER_MM / 1000
    return Camera(origin, tip, up, float(2 * np.arctan(width_m / 2 / np.linalg.norm(tip - origin))), FRAME_PX, FRAME_PX)


def tip_travel_px(scene: MovingScene, camera: Camera, from_s: float, to_s: float) -> Array:
    """How far (2,) the tip moves in the picture between two times, in px at 2.5 px/mm, right and down."""
    stage = scene.stage
    ends = scene.motion.at([from_s, to_s])
    frame = np.stack([stage.heading, np.cross(stage.normal, stage.heading), stage.normal], 1)
    height_mm = ends.hover_mm - 1e3 * np.array([stage.plan.tissue.sink_m(float(f)) if f > 0 else 0.0 for f in ends.force_n])
    points = stage.contact + np.column_stack([ends.at_mm, height_mm]) @ frame.T * 1e-3
    seen = camera.project(points)[:, :2]
    return np.asarray(seen[1] - seen[0])


def _velocity_px(scene: MovingScene, times_s: Array, cameras: Sequence[Camera], step_s: float = 1 / 240) -> Array:
    half_s = step_s / 2
    return np.stack([tip_travel_px(scene, camera, t - half_s, t + half_s) / step_s for camera, t in zip(cameras, times_s, strict=True)])


def seen_polar(stage: Stage, camera: Camera, error_mm: npt.NDArray[np.floating] | None = None) -> tuple[float, float]:
    """(R, theta) of the fingertip from the camera's place; a tracker sees it `error_mm` (right, up) beside the tip."""
    right_mm, up_mm = (0.0, 0.0) if error_mm is None else error_mm
    right = np.cross(unit(camera.target - camera.origin), camera.up)
    tip = camera.target + (right_mm * right + up_mm * camera.up) * 1e-3
    wide = Camera(camera.origin, camera.target, camera.up, 1.0, 1000, 1000)
    host = stage.host_landmarks_m[[HandJoint.WRIST, HandJoint.MIDDLE_FINGER_MCP]]
    wrist, mcp, at = wide.project(np.vstack([host, tip]))[:, :2]
    return polar(wrist, mcp, at, mirror=False)
