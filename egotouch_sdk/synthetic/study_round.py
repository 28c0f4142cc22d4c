"""One round of the study: a scene, a finger that moves in it, one light and one camera, as patches with their exact truth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from egotouch_sdk.observation import PATCH_MM
from egotouch_sdk.patches import PATCH_PX_PER_MM
from egotouch_sdk.study_data import RoundMeta, StudyRound
from egotouch_sdk.surface import Surface
from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.camera import photograph
from egotouch_sdk.synthetic.camera_settings import MIX_WEIGHTS, CameraSettings, LightMix, draw_settings, in_good_order
from egotouch_sdk.synthetic.finger_motion import FingerMotion
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.head_motion import HeadMotion
from egotouch_sdk.synthetic.lights import draw_lights
from egotouch_sdk.synthetic.linalg import Array
from egotouch_sdk.synthetic.moving_scene import BLANCH_S, Footage, MovingScene, film, seen_polar, tip_travel_px
from egotouch_sdk.synthetic.outfit import draw_outfit, dress_both
from egotouch_sdk.synthetic.participants import PARTICIPANTS, study_skin
from egotouch_sdk.synthetic.plan import ScenePlan, draw_plan
from egotouch_sdk.synthetic.sensor import LUMA
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.stage import PATCH_DETAIL, ImpossibleSceneError, Stage, draw_possible
from egotouch_sdk.synthetic.study_plan import LIGHTS, STUDY_CAMERAS, RoundPlan
from egotouch_sdk.synthetic.tracker_error import TrackerError, draw_tracker_error

#: Light paths per pixel; the camera's own smoothing takes out what noise is left.
SAMPLES = 6
_MAX_DRAWS = 1000
#: Longest smear of the finger and of the whole picture in patch pixels, the bounds of the training camera.
MAX_FINGER_PX, MAX_CAMERA_PX = 14.0, 6.0
_NOISE, _DIM_NOISE, _DAYLIGHT_NOISE = (0.001, 0.006), 2.0, 0.6
#: A camera brightens dark skin only in part: its level follows the tone's luma, relative to type III's, to this power (our choice).
_METERING, _MIDDLE_LUMA, _SKIN_LEVEL = 0.55, 0.36, (0.05, 0.42)
#: Bounds that keep the noise of few samples from looking like blotches and hair, and the spread of tone from one round to the next.
_MAX_OCCLUSION, _MIN_SAMPLE_BLUR_PX, _TONE_SPREAD = 1.7, 1.5, 0.04


@dataclass(frozen=True, slots=True)
class _Scene:
    """What stays the same through a round."""

    plan: RoundPlan
    moving: MovingScene
    settings: CameraSettings
    head: HeadMotion
    error: TrackerError


@lru_cache(maxsize=2)
def _skin(number: int, level: int) -> SkinIdentity:
    return study_skin(number, level)


def render_round(plan: RoundPlan, samples: int = SAMPLES, level: int = 4) -> StudyRound:
    """Render one round; the same plan gives the same patches. `level` is the rigs' number of subdivisions (4 for the study).

    Raises `ImpossibleSceneError` when no possible scene is found.
    """
    scene = _draw_scene(plan, level)
    times_s = np.arange(plan.frames) / plan.fps
    footage = film(scene.moving, times_s, samples, plan.seed)
    patches = [
        photograph(
            footage.layers[footage.shown[k]], _settings_at(scene, footage, k, float(times_s[k])), np.random.default_rng([plan.seed, 4, k])
        )
        for k in range(plan.frames)
    ]
    path, error = footage.path, scene.error
    return StudyRound(
        meta=_meta(plan, scene.moving.motion),
        patches=np.stack(patches),
        polar=np.array([seen_polar(scene.moving.stage, footage.cameras[k], error.tip_mm[k]) for k in range(plan.frames)], np.float32),
        timestamp_ns=np.round(times_s * 1e9).astype(np.int64),
        touch=path.touch,
        force_n=path.force_n.astype(np.float32),
        hover_mm=path.hover_mm.astype(np.float32),
        gate=np.ones(plan.frames, bool),
    )


def _meta(plan: RoundPlan, motion: FingerMotion) -> RoundMeta:
    person = PARTICIPANTS[plan.participant]
    return RoundMeta(
        participant=plan.participant,
        round=plan.number,
        fitzpatrick=person.fitzpatrick,
        hair=person.hair,
        place=Surface(plan.place),
        finger=plan.finger,
        touch_type=plan.touch_type,
        light=str(plan.light),
        outdoors=plan.outdoors,
        walking=plan.walking,
        touching_hand=person.touching_hand,
        seed=plan.seed,
        fps=plan.fps,
        lux=round(plan.lux, 1),
        acts=tuple(act.to_dict() for act in motion.acts),
    )


def _draw_scene(plan: RoundPlan, level: int) -> _Scene:
    rng = np.random.default_rng([plan.seed, 0])
    stage = _draw_stage(rng, plan, level)
    facts = LIGHTS[plan.light]
    lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    while lights.kind not in facts.keys:
        lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    more = np.random.default_rng([plan.seed, 3])
    moving = MovingScene(
        stage,
        lights,
        draw_backdrop(more, stage.contact, stage.aim.view, stage.aim.up),
        FingerMotion(np.random.default_rng([plan.seed, 2]), plan.touch_type, plan.seconds),
        float(more.uniform(*BLANCH_S)),
    )
    return _Scene(
        plan,
        moving,
        _draw_camera(np.random.default_rng([plan.seed, 1]), plan, _skin(plan.participant, level).traits.tone, stage.plan.distance_m),
        HeadMotion(rng, plan.walking),
        draw_tracker_error(rng, plan.frames, plan.fps),
    )


def _draw_stage(rng: np.random.Generator, plan: RoundPlan, level: int) -> Stage:
    skin, host, touching = _skin(plan.participant, level), HandRig("left", level), HandRig("right", level)

    def dress(scene: ScenePlan) -> SkinIdentity:
        return dress_both(skin, draw_outfit(rng, plan.participant, plan.outdoors, host.wrist_coords[scene.site]))

    try:
        return draw_possible(
            lambda: draw_plan(rng, host, plan.finger, plan.place), host, touching, skin, _MAX_DRAWS, dress, PATCH_DETAIL
        )
    except ImpossibleSceneError as problem:
        raise ImpossibleSceneError(f"{problem} for participant {plan.participant}, round {plan.number}") from problem


def _draw_camera(rng: np.random.Generator, plan: RoundPlan, tone: tuple[float, float, float], distance_m: float) -> CameraSettings:
    """One camera for a round: an ordinary one in good order, lit as the round is, with the resolution that its distance leaves.

    The participant's skin keeps its tone, the camera meters half-way towards it; no painted folds and nothing stuck to the finger.
    Tracker error and motion are those of each frame.
    """
    mix = LIGHTS[plan.light].mix
    drawn = draw_settings(rng)
    weights = np.array([rng.uniform(low, high) for low, high in MIX_WEIGHTS[mix]])
    warmth, tint = rng.normal(-0.02 if plan.outdoors else 0.02, 0.07, 3), rng.normal(0, 0.015, 3)
    noise = np.exp(rng.uniform(*np.log(_NOISE))) * (_DIM_NOISE if mix is LightMix.DIM else _DAYLIGHT_NOISE if plan.outdoors else 1.0)
    metered = (float(np.array(tone) @ LUMA) / _MIDDLE_LUMA) ** _METERING
    lit = replace(
        drawn,
        light_gains=(weights[:, None] * np.exp(np.stack([warmth, tint, -warmth], 1))).astype(np.float32),
        occlusion_power=min(drawn.occlusion_power, _MAX_OCCLUSION),
        sample_blur_px=max(drawn.sample_blur_px, _MIN_SAMPLE_BLUR_PX),
        folds=drawn.folds[:0],
        tone_power=float(np.exp(rng.normal(0, _TONE_SPREAD))),
        skin_level=float(np.clip(drawn.skin_level * metered, *_SKIN_LEVEL)),
        noise=float(noise),
        distractor=None,
    )
    px_per_mm = STUDY_CAMERAS[plan.participant % len(STUDY_CAMERAS)].px_per_mm(distance_m)
    return replace(in_good_order(lit, rng), native_px=round(px_per_mm * PATCH_MM))


def _settings_at(scene: _Scene, footage: Footage, k: int, time_s: float) -> CameraSettings:
    """The round's camera in frame `k`: where the tracker misses the tip, and the smears of the true motion during the exposure."""
    half_s, error = scene.plan.exposure_s / 2, scene.error
    scale, (right_mm, up_mm) = float(error.scale[k]), error.tip_mm[k]
    travel_px = tip_travel_px(scene.moving, footage.cameras[k], time_s - half_s, time_s + half_s)
    head_mm = np.diff(scene.head.at([time_s - half_s, time_s + half_s]), axis=0)[0]
    return replace(
        scene.settings,
        shift_px=(float(-right_mm * PATCH_PX_PER_MM * scale), float(up_mm * PATCH_PX_PER_MM * scale)),
        turn_rad=float(error.turn_rad[k]),
        scale=scale,
        finger_motion_px=bounded(travel_px * scale, MAX_FINGER_PX),
        camera_motion_px=bounded(head_mm * [1, -1] * PATCH_PX_PER_MM * scale, MAX_CAMERA_PX),
    )


def bounded(path_px: Array, longest_px: float) -> tuple[float, float]:
    """A smear (x, y) in pixels, shortened to `longest_px`."""
    length = float(np.hypot(*path_px))
    x, y = path_px * min(1.0, longest_px / max(length, 1e-9))
    return float(x), float(y)
