"""One take of a clip: both hands moving as the script says, posed and rendered frame by frame with exact truth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from egotouch_sdk.joints import FINGERS, Finger, HandJoint
from egotouch_sdk.synthetic.backdrop import calm_texture
from egotouch_sdk.synthetic.contact import Tissue
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.host_truth import host_point
from egotouch_sdk.synthetic.lights import Lights, draw_lights
from egotouch_sdk.synthetic.linalg import Array, reject_from, unit
from egotouch_sdk.synthetic.plan import ScenePlan
from egotouch_sdk.synthetic.render import Backdrop, Camera, Layers, render_layers
from egotouch_sdk.synthetic.script import FPS, Moment, Shot, moment
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.stage import Aim, Stage, Touch

WIDTH_PX, HEIGHT_PX = 640, 480
#: Horizontal field of view; head-mounted cameras of the paper's kind have 60 to 80 degrees.
_FOV_RAD = float(np.radians(62))
_SAMPLES = 12
_LONG = tuple(f for f in FINGERS if f is not Finger.THUMB)


def _rounded(points: Array) -> list[list[float]]:
    return [[round(float(v), 2) for v in point[:2]] for point in points]


@dataclass(frozen=True, slots=True)
class TakeFrame:
    """One rendered frame before the camera model, with its truth (JSON-ready)."""

    layers: Layers
    truth: dict[str, Any]


class _Sway:
    """Smooth, aperiodic hand-held motion: a few slow sines per channel, deterministic by seed."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng([seed, 77])
        self._hz, self._phase = rng.uniform(0.15, 0.9, (40, 3)), rng.uniform(0, 2 * np.pi, (40, 3))
        self._size = rng.uniform(0.5, 1.0, (40, 3)) / [1.6, 2.1, 3.2]

    def __call__(self, channel: int, time_s: float) -> float:
        return float((self._size[channel] * np.sin(2 * np.pi * self._hz[channel] * time_s + self._phase[channel])).sum())


class Take:
    """A shot ready to render any of its frames, in any order."""

    def __init__(self, shot: Shot, identity: SkinIdentity) -> None:
        self._shot, self._identity = shot, identity
        self._host, self._touching = HandRig("left"), HandRig("right")
        self._sway = _Sway(shot.seed)
        palmar = shot.place in ("palm", "inner_forearm")
        facing = (self._host.normals @ self._host.bind[0, :3, :3])[:, 1]
        self._sites = np.flatnonzero(facing < -0.6 if palmar else facing > 0.6)
        self._tree = cKDTree(self._host.wrist_coords[self._sites][:, [0, 2]])
        centre = np.mean([a.at_mm for a in shot.acts], axis=0)
        still = self._stage(Moment((float(centre[0]), float(centre[1])), 20.0, 0.0, 0), 0.0, None)
        self._aim = self._tilted(still)
        self._centre = still.contact + self._aim.right * shot.centre_m[0] + self._aim.up * shot.centre_m[1]
        rng = np.random.default_rng([shot.seed, 1])
        self._lights: Lights = draw_lights(rng, still.normal, self._aim.up, self._aim.view)
        tilt = unit(0.35 * self._aim.up + 0.8 * self._aim.view)
        self._backdrop = Backdrop(still.contact - self._aim.view * 0.28, tilt, self._aim.up, calm_texture(rng, shot.backdrop_srgb))

    def _tilted(self, still: Stage) -> Aim:
        right_deg, up_deg = self._shot.tilt_deg
        aim = still.aim
        view = unit(aim.normal + np.tan(np.radians(right_deg)) * aim.right + np.tan(np.radians(up_deg)) * aim.up)
        right = reject_from(aim.right, view)
        return Aim(view, right, np.cross(view, right), aim.normal)

    def _pose_host(self, time_s: float) -> dict[str, tuple[float, float, float]]:
        pose: dict[str, tuple[float, float, float]] = {"forearm": (4.0, 3.0, 0.0), "thumb-phalanx-proximal": (4.0, 0.0, 0.0)}
        for i, finger in enumerate(_LONG):
            bend, spread = 2.0 * self._sway(10 + i, time_s), 0.8 * self._sway(14 + i, time_s)
            pose[f"{finger}-finger-phalanx-proximal"] = (-3.0 + i + bend, -(1.5 - i) * 4 + spread, 0.0)
            pose[f"{finger}-finger-phalanx-intermediate"] = (6.0 + bend, 0.0, 0.0)
            pose[f"{finger}-finger-phalanx-distal"] = (5.0, 0.0, 0.0)
        return pose

    def _pose_touching(self, now: Moment, time_s: float) -> dict[str, tuple[float, float, float]]:
        pose: dict[str, tuple[float, float, float]] = {"forearm": (6.0, 6.0, 0.0)}
        for i, tucked in enumerate(_LONG):
            pose[f"{tucked}-finger-phalanx-proximal"] = (56.0 + 3 * i, (1.5 - i) * 2, 0.0)
            pose[f"{tucked}-finger-phalanx-intermediate"] = (86.0 + 3 * i, 0.0, 0.0)
            pose[f"{tucked}-finger-phalanx-distal"] = (42.0, 0.0, 0.0)
        pose["thumb-phalanx-proximal"], pose["thumb-phalanx-distal"] = (22.0, 0.0, 0.0), (30.0, 0.0, 0.0)
        lift, press = min(now.hover_mm / 25, 1.2), min(now.force_n, 3.0)
        finger = self._shot.finger
        pose[f"{finger}-finger-phalanx-proximal"] = (36.0 - 13 * lift + 1.5 * press, 0.6 * self._sway(20, time_s), 0.0)
        pose[f"{finger}-finger-phalanx-intermediate"] = (24.0 - 4 * lift + 2 * press, 0.0, 0.0)
        pose[f"{finger}-finger-phalanx-distal"] = (6.0 - 7 * min(1.0, press / 2), 0.0, 0.0)
        return pose

    def _stage(self, now: Moment, time_s: float, aim: Aim | None) -> Stage:
        shot = self._shot
        _, nearest = self._tree.query(np.array(now.at_mm) * 1e-3)
        plan = ScenePlan(
            place=shot.place,
            finger=shot.finger,
            host_pose=self._pose_host(time_s),
            touching_pose=self._pose_touching(now, time_s),
            site=int(self._sites[nearest]),
            arm_azimuth_rad=float(np.radians(shot.arm_azimuth_deg)),
            view_tilt_rad=0.0,
            view_azimuth_rad=0.0,
            distance_m=shot.distance_m,
            heading_rad=float(np.radians(shot.heading_deg + 1.2 * self._sway(21, time_s))),
            pitch_rad=float(np.radians(shot.pitch_deg + 1.2 * self._sway(22, time_s))),
            roll_rad=float(np.radians(shot.roll_deg)),
            tissue=Tissue(shot.stiffness_mm, shot.skin_share, 0.0022, 0.5),
        )
        return Stage(plan, self._host, self._touching, self._identity, detail=True, aim=aim or self._level_aim(plan))

    def _level_aim(self, plan: ScenePlan) -> Aim:
        """Aim straight down on the contact: from the host's own pose, before any tilt."""
        g = self._host.pose(plan.host_pose)
        dorsal = unit(g[0, :3, 1] if plan.place in ("palm", "back_of_hand") else g[25, :3, 1])
        normal = -dorsal if plan.place in ("palm", "inner_forearm") else dorsal
        along = reject_from(-g[0, :3, 2], normal)
        azimuth = plan.arm_azimuth_rad
        right = np.cos(azimuth) * along - np.sin(azimuth) * np.cross(normal, along)
        return Aim(normal, right, np.cross(normal, right), normal)

    def _camera(self, time_s: float) -> Camera:
        sway = self._sway
        move = 0.004 * (sway(0, time_s) * self._aim.right + sway(1, time_s) * self._aim.up + sway(2, time_s) * self._aim.view)
        turn = 0.004 * (sway(3, time_s) * self._aim.right + sway(4, time_s) * self._aim.up)
        origin = self._centre + self._aim.view * self._shot.distance_m + move
        return Camera(
            origin, self._centre + turn, unit(self._aim.up + 0.012 * sway(5, time_s) * self._aim.right), _FOV_RAD, WIDTH_PX, HEIGHT_PX
        )

    def truth(self, frame: int) -> dict[str, Any]:
        """What is true about frame 0 .. `frames` - 1, without rendering it (JSON-ready)."""
        return self._truth(*self._posed(frame))

    def render(self, frame: int) -> TakeFrame:
        """Render frame 0 .. `frames` - 1."""
        touch, stage, camera, now = self._posed(frame)
        layers = render_layers(
            touch.host,
            touch.touching,
            self._lights,
            self._centre,
            self._backdrop,
            [camera],
            _SAMPLES,
            1000 * self._shot.seed + frame,
            px_per_mm=1.3,
        )[0]
        return TakeFrame(layers, self._truth(touch, stage, camera, now))

    def _posed(self, frame: int) -> tuple[Touch, Stage, Camera, Moment]:
        time_s = frame / FPS
        now = moment(self._shot, time_s)
        stage = self._stage(now, time_s, self._aim)
        return stage.at(force_n=now.force_n, hover_mm=now.hover_mm), stage, self._camera(time_s), now

    def _truth(self, touch: Touch, stage: Stage, camera: Camera, now: Moment) -> dict[str, Any]:
        tip = touch.landmarks_m[self._shot.finger.tip]
        at = camera.project(np.vstack([tip, stage.host_landmarks_m, touch.landmarks_m]))
        focal_px = WIDTH_PX / 2 / np.tan(_FOV_RAD / 2)
        act = self._shot.acts[now.act]
        point, host_mm = host_point(stage, touch), stage.host_landmarks_m * 1e3
        return {
            "touching": now.force_n > 0,
            "force_n": round(now.force_n, 4),
            "hover_mm": round(now.hover_mm, 3),
            "surface": self._shot.place,
            "finger": str(self._shot.finger),
            "hand": "right",
            "act": now.act,
            "kind": act.kind,
            "tip_px": _rounded(at[:1])[0],
            "px_per_mm": round(float(focal_px / at[0, 2] / 1e3), 4),
            "pitch_rad": round(self._pitch(touch, stage), 4),
            "yaw_rad": round(point.yaw_rad, 4),
            "at_mm": [round(point.x_mm, 2), round(point.y_mm, 2)],
            "palm_mm": round(float(np.linalg.norm(host_mm[HandJoint.MIDDLE_FINGER_MCP] - host_mm[HandJoint.WRIST])), 2),
            "landmarks_px": {"left": _rounded(at[1:22]), "right": _rounded(at[22:])},
        }

    def _pitch(self, touch: Touch, stage: Stage) -> float:
        finger = self._shot.finger
        axis: Array = unit(touch.landmarks_m[finger.tip] - touch.landmarks_m[finger.dip])
        return float(np.arcsin(np.clip(-axis @ stage.normal, -1, 1)))
