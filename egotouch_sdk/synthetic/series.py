"""A series: one pose under one light at several depths, each seen by a few cameras, as labelled patch layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from egotouch_sdk.joints import HandJoint
from egotouch_sdk.patches import polar
from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.lights import draw_lights
from egotouch_sdk.synthetic.linalg import Array, reject_from, unit
from egotouch_sdk.synthetic.plan import draw_plan, draw_subject
from egotouch_sdk.synthetic.render import Camera, Layers, render_layers
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.stage import Stage, Touch, draw_possible

#: Stored side in pixels at 2.5 px/mm: the 100 px patch plus room for rotation, scale and shift at training time.
SIDE_PX = 144
PX_PER_MM = 2.5
_VIEWS = 2
_MAX_DRAWS = 400
_CAMERA_DRAWS = 12
_LEAST_FACING = 0.72


@dataclass(frozen=True, slots=True)
class LabelledLayers:
    """One rendered patch and everything that is true about it (JSON-ready)."""

    layers: Layers
    labels: dict[str, Any]


def draw_stage(rng: np.random.Generator, host: HandRig, touching: HandRig, identity: SkinIdentity) -> Stage:
    """A possible scene of any finger and place; raises `ImpossibleSceneError` after 400 draws."""
    finger, place = draw_subject(rng)
    return draw_possible(lambda: draw_plan(rng, host, finger, place), host, touching, identity, _MAX_DRAWS)


def draw_depths(rng: np.random.Generator) -> list[dict[str, float]]:
    """A close hover, a far hover, a light touch and a firm one: keyword arguments for `Stage.at`."""
    far = rng.uniform(6, 25) if rng.random() < 0.8 else rng.uniform(25, 60)
    return [
        {"hover_mm": float(np.exp(rng.uniform(np.log(1.0), np.log(6.0))))},
        {"hover_mm": float(far)},
        {"force_n": float(rng.uniform(0.15, 1.0))},
        {"force_n": float(rng.uniform(1.0, 3.5))},
    ]


def _cameras(rng: np.random.Generator, stage: Stage) -> list[tuple[Array, float]]:
    """Direction (3,) from the contact and distance (m) of each view; the first is the plan's own."""
    chosen = [(stage.aim.view, stage.plan.distance_m)]
    for _ in range(_CAMERA_DRAWS):
        direction, distance = unit(stage.aim.view + rng.normal(0, 0.25, 3)), float(rng.uniform(0.26, 0.5))
        if direction @ stage.normal > _LEAST_FACING and not stage.hidden_from(stage.contact + direction * distance):
            chosen.append((direction, distance))
        if len(chosen) == _VIEWS:
            return chosen
    return chosen * _VIEWS


def _patch_camera(touch: Touch, stage: Stage, direction: Array, distance: float) -> Camera:
    tip, dip = touch.landmarks_m[stage.plan.finger.tip], touch.landmarks_m[stage.plan.finger.dip]
    origin = stage.contact + direction * distance
    up = reject_from(tip - dip, unit(tip - origin))
    width_m = SIDE_PX / PX_PER_MM / 1000
    return Camera(origin, tip, up, float(2 * np.arctan(width_m / 2 / np.linalg.norm(tip - origin))), SIDE_PX, SIDE_PX)


def _labels(touch: Touch, stage: Stage, camera: Camera) -> dict[str, Any]:
    host = stage.host_landmarks_m[[HandJoint.WRIST, HandJoint.MIDDLE_FINGER_MCP]]
    tip = touch.landmarks_m[stage.plan.finger.tip]
    wide = Camera(camera.origin, camera.target, camera.up, 1.0, 1000, 1000)
    wrist, mcp, at = wide.project(np.vstack([host, tip]))[:, :2]
    r_palms, theta_rad = polar(wrist, mcp, at, mirror=False)
    axis = unit(touch.landmarks_m[stage.plan.finger.tip] - touch.landmarks_m[stage.plan.finger.dip])
    return {
        "touch": touch.force_n > 0,
        "force_n": touch.force_n,
        "hover_mm": touch.hover_mm,
        "dent_mm": touch.dent_mm,
        "finger": str(stage.plan.finger),
        "place": stage.plan.place,
        "r_palms": r_palms,
        "theta_rad": theta_rad,
        "pitch_rad": float(np.arcsin(np.clip(-axis @ stage.normal, -1, 1))),
        "distance_mm": float(np.linalg.norm(tip - camera.origin) * 1e3),
    }


def render_series(
    rng: np.random.Generator, host: HandRig, touching: HandRig, identity: SkinIdentity, samples: int, seed: int
) -> list[LabelledLayers]:
    """Eight labelled patches of one new scene: 4 depths x 2 views; raises `ImpossibleSceneError` when none can be drawn."""
    stage = draw_stage(rng, host, touching, identity)
    lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    backdrop = draw_backdrop(rng, stage.contact, stage.aim.view, stage.aim.up)
    directions = _cameras(rng, stage)
    patches = []
    for depth in draw_depths(rng):
        touch = stage.at(**depth)
        cameras = [_patch_camera(touch, stage, *d) for d in directions]
        views = render_layers(touch.host, touch.touching, lights, stage.contact, backdrop, cameras, samples, int(rng.integers(1 << 30)))
        for layers, camera in zip(views, cameras, strict=True):
            patches.append(LabelledLayers(layers, {**_labels(touch, stage, camera), "light": lights.kind, "seed": seed}))
    return patches
