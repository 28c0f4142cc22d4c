"""One round of the study: a scene, a finger that moves in it, one light and one camera, as patches with their exact truth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import HandJoint
from egotouch_sdk.observation import PATCH_PX
from egotouch_sdk.patches import PATCH_PX_PER_MM, polar
from egotouch_sdk.study_data import RoundMeta, StudyRound
from egotouch_sdk.surface import Surface
from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.camera import LUMA, LightLayers, photograph
from egotouch_sdk.synthetic.camera_settings import MIX_WEIGHTS, CameraSettings, LightMix, draw_settings
from egotouch_sdk.synthetic.finger_motion import FingerMotion, FingerPath
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.head_motion import HeadMotion
from egotouch_sdk.synthetic.lights import Lights, draw_lights
from egotouch_sdk.synthetic.linalg import Array, reject_from, unit
from egotouch_sdk.synthetic.outfit import draw_outfit, dress_both
from egotouch_sdk.synthetic.participants import PARTICIPANTS, study_skin
from egotouch_sdk.synthetic.plan import draw_plan
from egotouch_sdk.synthetic.render import Camera, Layers, render_layers
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.srgb import linear_to_srgb
from egotouch_sdk.synthetic.stage import PATCH_DETAIL, ImpossibleSceneError, Stage, Touch
from egotouch_sdk.synthetic.study_plan import LIGHTS, RoundPlan
from egotouch_sdk.synthetic.tracker_error import TrackerError, draw_tracker_error

#: Light paths per pixel; the camera's own smoothing takes out what noise is left.
SAMPLES = 6
_MAX_DRAWS = 1000
#: Light of a nail and of pressed skin follows force with this time constant, seconds (0.2 to 1 s in reference measurements).
_BLANCH_S = (0.2, 0.6)
_BLANCH_STEP_S = 1 / 300
#: Longest smear of the finger and of the whole picture in patch pixels, the bounds of the training camera.
_MAX_FINGER_PX, _MAX_CAMERA_PX = 14.0, 6.0
_NOISE, _DIM_NOISE, _DAYLIGHT_NOISE = (0.001, 0.006), 2.0, 0.6
#: A camera brightens dark skin only in part: its level follows the tone's luma, relative to type III's, to this power (our choice).
_METERING, _MIDDLE_LUMA, _SKIN_LEVEL = 0.55, 0.36, (0.05, 0.42)
#: Bounds that keep the noise of few samples from looking like blotches and hair, and the spread of tone from one round to the next.
_MAX_OCCLUSION, _MIN_SAMPLE_BLUR_PX, _TONE_SPREAD = 1.7, 1.5, 0.04


@dataclass(frozen=True, slots=True)
class _Scene:
    """What stays the same through a round."""

    plan: RoundPlan
    stage: Stage
    lights: Lights
    settings: CameraSettings
    motion: FingerMotion
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
    rng = np.random.default_rng([plan.seed, 3])
    backdrop = draw_backdrop(rng, scene.stage.contact, scene.stage.aim.view, scene.stage.aim.up)
    times_s = np.arange(plan.frames) / plan.fps
    path = scene.motion.at(times_s)
    colour_n = _lagging_force(scene.motion, times_s, float(rng.uniform(*_BLANCH_S)))
    patches, polars = [], []
    for k in range(plan.frames):
        touch = _posed(scene.stage, path, k, float(colour_n[k]))
        camera = _camera(scene, touch, k)
        layers = render_layers(
            touch.host, touch.touching, scene.lights, scene.stage.contact, backdrop, [camera], samples, plan.seed % 10**6 * 1000 + k
        )[0]
        settings = _settings_at(scene, camera, float(times_s[k]), float(scene.error.scale[k]))
        patches.append(photograph(_light_layers(layers), settings, np.random.default_rng([plan.seed, 4, k])))
        polars.append(_polar(scene.stage, camera))
    return StudyRound(
        meta=_meta(plan, scene.motion),
        patches=np.stack(patches),
        polar=np.array(polars, np.float32),
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
    return _Scene(
        plan,
        stage,
        lights,
        _draw_camera(np.random.default_rng([plan.seed, 1]), plan, _skin(plan.participant, level).traits.tone),
        FingerMotion(np.random.default_rng([plan.seed, 2]), plan.touch_type, plan.seconds),
        HeadMotion(rng, plan.walking),
        draw_tracker_error(rng, plan.frames, plan.fps),
    )


def _draw_stage(rng: np.random.Generator, plan: RoundPlan, level: int) -> Stage:
    skin, host, touching = _skin(plan.participant, level), HandRig("left", level), HandRig("right", level)
    for _ in range(_MAX_DRAWS):
        scene = draw_plan(rng, host, plan.finger, plan.place)
        try:
            Stage(scene, host, touching, skin, detail=False)
            outfit = draw_outfit(rng, plan.participant, plan.outdoors, host.wrist_coords[scene.site])
            return Stage(scene, host, touching, dress_both(skin, outfit), detail=True, fineness=PATCH_DETAIL)
        except ImpossibleSceneError:
            continue
    raise ImpossibleSceneError(f"no possible scene in {_MAX_DRAWS} draws for participant {plan.participant}, round {plan.number}")


def _draw_camera(rng: np.random.Generator, plan: RoundPlan, tone: tuple[float, float, float]) -> CameraSettings:
    """One camera for a round: a draw of the training camera without its tracker error and motion, lit as the round is.

    The participant's skin keeps its tone, the camera meters half-way towards it; no painted folds and nothing stuck to the finger.
    """
    mix = LIGHTS[plan.light].mix
    drawn = draw_settings(rng)
    weights = np.array([rng.uniform(low, high) for low, high in MIX_WEIGHTS[mix]])
    warmth, tint = rng.normal(-0.02 if plan.outdoors else 0.02, 0.07, 3), rng.normal(0, 0.015, 3)
    noise = np.exp(rng.uniform(*np.log(_NOISE))) * (_DIM_NOISE if mix is LightMix.DIM else _DAYLIGHT_NOISE if plan.outdoors else 1.0)
    metered = (float(np.array(tone) @ LUMA) / _MIDDLE_LUMA) ** _METERING
    return replace(
        drawn,
        light_gains=(weights[:, None] * np.exp(np.stack([warmth, tint, -warmth], 1))).astype(np.float32),
        occlusion_power=min(drawn.occlusion_power, _MAX_OCCLUSION),
        sample_blur_px=max(drawn.sample_blur_px, _MIN_SAMPLE_BLUR_PX),
        folds=drawn.folds[:0],
        tone_power=float(np.exp(rng.normal(0, _TONE_SPREAD))),
        skin_level=float(np.clip(drawn.skin_level * metered, *_SKIN_LEVEL)),
        shift_px=(0.0, 0.0),
        turn_rad=0.0,
        scale=1.0,
        finger_motion_px=(0.0, 0.0),
        camera_motion_px=(0.0, 0.0),
        noise=float(noise),
        distractor=None,
    )


def _posed(stage: Stage, path: FingerPath, k: int, colour_n: float) -> Touch:
    along, across = path.at_mm[k] * 1e-3
    offset_m = (float(along), float(across))
    return stage.moved(float(path.force_n[k]), float(path.hover_mm[k]), offset_m, float(path.tilt_rad[k]), colour_n)


def _lagging_force(motion: FingerMotion, times_s: Array, constant_s: float) -> Array:
    """Force behind a first-order low-pass at `times_s` (T,)."""
    fine_s = np.arange(0.0, float(times_s[-1]) + _BLANCH_STEP_S, _BLANCH_STEP_S)
    force = motion.at(fine_s).force_n
    lagging, value = np.empty(len(fine_s)), 0.0
    for k, now in enumerate(force):
        value += (now - value) * _BLANCH_STEP_S / constant_s
        lagging[k] = value
    return np.asarray(np.interp(times_s, fine_s, lagging))


def _camera(scene: _Scene, touch: Touch, k: int) -> Camera:
    """A camera that sees exactly the patch a tracker with this frame's error would cut."""
    stage, error = scene.stage, scene.error
    finger = stage.plan.finger
    tip, dip = touch.landmarks_m[finger.tip], touch.landmarks_m[finger.dip]
    origin = stage.contact + stage.aim.view * stage.plan.distance_m
    forward = unit(tip - origin)
    up = reject_from(tip - dip, forward)
    right = np.cross(forward, up)
    turn, (right_mm, up_mm) = error.turn_rad[k], error.tip_mm[k]
    target = tip + (right_mm * right + up_mm * up) * 1e-3
    width_m = PATCH_PX / PATCH_PX_PER_MM / 1000 / error.scale[k]
    fov_rad = float(2 * np.arctan(width_m / 2 / np.linalg.norm(target - origin)))
    return Camera(origin, target, np.cos(turn) * up + np.sin(turn) * right, fov_rad, PATCH_PX, PATCH_PX)


def _settings_at(scene: _Scene, camera: Camera, time_s: float, scale: float) -> CameraSettings:
    """The round's camera at one time, with the smears of the true motion during the exposure."""
    stage, half_s = scene.stage, scene.plan.exposure_s / 2
    ends = scene.motion.at([time_s - half_s, time_s + half_s])
    frame = np.stack([stage.heading, np.cross(stage.normal, stage.heading), stage.normal], 1)
    height_mm = ends.hover_mm - 1e3 * np.array([stage.plan.tissue.sink_m(float(f)) if f > 0 else 0.0 for f in ends.force_n])
    points = stage.contact + np.column_stack([ends.at_mm, height_mm]) @ frame.T * 1e-3
    seen = camera.project(points)[:, :2]
    head_mm = np.diff(scene.head.at([time_s - half_s, time_s + half_s]), axis=0)[0]
    return replace(
        scene.settings,
        finger_motion_px=_bounded(seen[1] - seen[0], _MAX_FINGER_PX),
        camera_motion_px=_bounded(head_mm * [1, -1] * PATCH_PX_PER_MM * scale, _MAX_CAMERA_PX),
    )


def _bounded(path_px: Array, longest_px: float) -> tuple[float, float]:
    length = float(np.hypot(*path_px))
    x, y = path_px * min(1.0, longest_px / max(length, 1e-9))
    return float(x), float(y)


def _light_layers(layers: Layers) -> LightLayers:
    """Rendered layers as training reads them from a shard, with the same rounding."""
    middle = layers.depth_m.shape[0] // 2
    depth_mm = np.clip((layers.depth_m - layers.depth_m[middle, middle]) * 1e3, -300, 300)
    return LightLayers(
        np.clip(layers.light, 0, 60).astype(np.float16), linear_to_srgb(layers.albedo), layers.segment, depth_mm.astype(np.float16)
    )


def _polar(stage: Stage, camera: Camera) -> npt.NDArray[np.float64]:
    """(R, theta) of the fingertip as the tracker sees it, from the camera's own place."""
    wide = Camera(camera.origin, camera.target, camera.up, 1.0, 1000, 1000)
    host = stage.host_landmarks_m[[HandJoint.WRIST, HandJoint.MIDDLE_FINGER_MCP]]
    wrist, mcp, at = wide.project(np.vstack([host, camera.target]))[:, :2]
    return np.array(polar(wrist, mcp, at, mirror=False))
