"""Training films: a few frames of a finger that comes down, presses, slides, hovers or leaves, as labelled layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.camera import LightLayers
from egotouch_sdk.synthetic.finger_motion import TRAINING_PACE, FingerMotion, contact_spans
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.lights import draw_lights
from egotouch_sdk.synthetic.linalg import Array
from egotouch_sdk.synthetic.moving_scene import BLANCH_S, Footage, MovingScene, film, seen_polar
from egotouch_sdk.synthetic.outfit import draw_sleeves, dress_both
from egotouch_sdk.synthetic.plan import ScenePlan, draw_plan, draw_subject
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.stage import PATCH_DETAIL, Stage, draw_possible

#: Frames of a film: 0.4 s at 30 fps, from before a finger comes down until it rests.
FRAMES = 12
#: Films of one pose, each with its own light and motion.
FILMS_PER_SCENE = 2
_MAX_DRAWS = 400
_KINDS = {TouchType.TAP: 0.28, TouchType.LIGHT_PRESS: 0.26, TouchType.HARD_PRESS: 0.20, TouchType.DRAG: 0.10, TouchType.HOVER: 0.16}
#: Most films have the frame rate of ordinary cameras, the others any in this range (our choice).
_FPS, _ORDINARY_FPS, _ORDINARY_SHARE = (15.0, 60.0), 30.0, 0.6
#: Length of the motion that a film is cut from, seconds, and the share of films that hold an edge of a touch, where there is one.
_MOTION_S, _EDGE_SHARE = 2.2, 0.6
_SLEEVED = 0.2


@dataclass(frozen=True, slots=True, eq=False)
class LabelledFilm:
    """A film: `layers` of the pictures that differ, and `labels`, JSON-ready: what is true of the film and of each of its T frames.

    Per frame: `shown` (number of the picture), `touch`, `force_n`, `hover_mm`, `velocity_px` (of the tip, per second, right and down),
    `polar` (R, theta).
    """

    layers: list[LightLayers]
    labels: dict[str, Any]


def render_films(
    rng: np.random.Generator, host: HandRig, touching: HandRig, identity: SkinIdentity, samples: int, seed: int
) -> list[LabelledFilm]:
    """Two films of one new pose; raises `ImpossibleSceneError` when none can be drawn in 400 tries."""
    stage = _draw_stage(rng, host, touching, identity)
    return [_render_film(rng, stage, samples, seed * FILMS_PER_SCENE + k) for k in range(FILMS_PER_SCENE)]


def _draw_stage(rng: np.random.Generator, host: HandRig, touching: HandRig, identity: SkinIdentity) -> Stage:
    finger, place = draw_subject(rng)

    def dress(plan: ScenePlan) -> SkinIdentity:
        return dress_both(identity, draw_sleeves(rng, host.wrist_coords[plan.site])) if rng.random() < _SLEEVED else identity

    return draw_possible(lambda: draw_plan(rng, host, finger, place), host, touching, identity, _MAX_DRAWS, dress, PATCH_DETAIL)


def _render_film(rng: np.random.Generator, stage: Stage, samples: int, seed: int) -> LabelledFilm:
    lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    kind = TouchType(rng.choice(list(_KINDS), p=list(_KINDS.values())))
    motion = FingerMotion(rng, kind, _MOTION_S, TRAINING_PACE)
    backdrop = draw_backdrop(rng, stage.contact, stage.aim.view, stage.aim.up)
    scene = MovingScene(stage, lights, backdrop, motion, float(rng.uniform(*BLANCH_S)))
    fps = _ORDINARY_FPS if rng.random() < _ORDINARY_SHARE else float(np.exp(rng.uniform(*np.log(_FPS))))
    times_s = draw_times(rng, motion, fps)
    footage = film(scene, times_s, samples, seed)
    return LabelledFilm(footage.layers, {**_labels(stage, footage), "fps": fps, "kind": str(kind), "light": lights.kind, "seed": seed})


def draw_times(rng: np.random.Generator, motion: FingerMotion, fps: float) -> Array:
    """Times (T,) of a film's frames within the motion; most films hold an edge of a touch."""
    length_s = (FRAMES - 1) / fps
    fine_s = np.arange(0.0, _MOTION_S, 0.002)
    edges = [edge for span in contact_spans(motion.at(fine_s).touch) for edge in span if 0 < edge < len(fine_s)]
    if edges and rng.random() < _EDGE_SHARE:
        start_s = fine_s[int(rng.choice(edges))] - rng.uniform(0.1, 0.9) * length_s
    else:
        start_s = rng.uniform(0.0, _MOTION_S - length_s)
    return np.asarray(np.clip(start_s, 0.0, _MOTION_S - length_s) + np.arange(FRAMES) / fps)


def _labels(stage: Stage, footage: Footage) -> dict[str, Any]:
    path = footage.path
    return {
        "shown": footage.shown,
        "touch": path.touch.tolist(),
        "force_n": np.round(path.force_n, 4).tolist(),
        "hover_mm": np.round(path.hover_mm, 3).tolist(),
        "velocity_px": np.round(footage.velocity_px, 1).tolist(),
        "polar": [[round(value, 4) for value in seen_polar(stage, camera)] for camera in footage.cameras],
        "finger": str(stage.plan.finger),
        "place": stage.plan.place,
    }
