"""Still pictures of one hand touching the other limb, all of both hands in view, with the exact answer in the host frame."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.host_truth import HostTruth, draw_camera, view_of
from egotouch_sdk.synthetic.lights import draw_lights
from egotouch_sdk.synthetic.patches_job import participant
from egotouch_sdk.synthetic.plan import draw_plan, draw_subject
from egotouch_sdk.synthetic.render import Camera, Layers, render_layers
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.stage import ImpossibleSceneError, Stage, Touch

_SAMPLES = 6
_MAX_DRAWS = 400
_SKIN_LEVEL = 0.2
_TOUCH_SHARE = 0.75


def draw_scene(
    rng: np.random.Generator, host: HandRig, touching: HandRig, identity: SkinIdentity, detail: bool = True
) -> tuple[Stage, Touch, Camera]:
    """A random possible scene, three of four with a touch, and a camera that sees both hands; raises `ImpossibleSceneError`."""
    finger, place = draw_subject(rng)
    for _ in range(_MAX_DRAWS):
        plan = draw_plan(rng, host, finger, place)
        depth = {"force_n": float(rng.uniform(0.2, 3.5))} if rng.random() < _TOUCH_SHARE else {"hover_mm": float(rng.uniform(1.0, 25.0))}
        try:
            stage = Stage(plan, host, touching, identity, detail=False)
        except ImpossibleSceneError:
            continue
        camera = draw_camera(rng, stage, stage.at(hover_mm=1.0))
        if camera is None:
            continue
        try:
            stage = Stage(plan, host, touching, identity, detail=True) if detail else stage
        except ImpossibleSceneError:
            continue
        return stage, stage.at(**depth), camera
    raise ImpossibleSceneError(f"no possible scene in {_MAX_DRAWS} draws")


def render_still(rng: np.random.Generator, host: HandRig, touching: HandRig, number: int) -> tuple[npt.NDArray[np.uint8], HostTruth]:
    """A BGR picture (480, 640, 3) of participant `number` and its truth; raises `ImpossibleSceneError`."""
    identity = participant(number)
    stage, touch, camera = draw_scene(rng, host, touching, identity)
    lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    backdrop = draw_backdrop(rng, stage.contact, stage.aim.view, stage.aim.up)
    seed = int(rng.integers(1 << 30))
    layers = render_layers(touch.host, touch.touching, lights, stage.contact, backdrop, [camera], _SAMPLES, seed, px_per_mm=1.3)[0]
    return _develop(layers, rng), view_of(stage, touch, camera, number)


def render_stills(folder: Path, count: int, participants: tuple[int, ...], seed: int, report: Callable[[str], None]) -> None:
    """Render stills 0 .. `count` - 1 into `folder`, those that are there left alone: NNNN.jpg and NNNN.json."""
    folder.mkdir(parents=True, exist_ok=True)
    host, touching = HandRig("left"), HandRig("right")
    for index in range(count):
        truth_path = folder / f"{seed}-{index:04d}.json"
        if truth_path.exists():
            continue
        try:
            image, truth = render_still(np.random.default_rng([seed, index]), host, touching, participants[index % len(participants)])
        except ImpossibleSceneError:
            continue
        cv2.imwrite(str(truth_path.with_suffix(".jpg")), image, [cv2.IMWRITE_JPEG_QUALITY, 92])
        truth_path.write_text(json.dumps(truth.to_dict(), separators=(",", ":")) + "\n")
        report(f"{index + 1}/{count} stills")


def _develop(layers: Layers, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    """Light layers mixed at random, exposed for skin, with an ordinary camera's blur, noise and tone curve."""
    gains = rng.uniform(0.15, 0.8, 3)[:, None] * rng.uniform(0.88, 1.12, (3, 3))
    image = (layers.light @ gains.astype(np.float32)) * layers.albedo
    skin = image[layers.segment > 0]
    gain = _SKIN_LEVEL / max(float(np.median(skin.mean(-1))), 1e-4)
    image = np.asarray(cv2.GaussianBlur((image * gain).astype(np.float32), (0, 0), 0.8), np.float32)
    image = image + rng.standard_normal(image.shape).astype(np.float32) * np.sqrt(np.maximum(image, 0) * 4e-5 + 1.5e-6)
    tone = np.clip(np.maximum(image, 0) / (1 + 0.22 * image) * 1.18, 0, 1) ** (1 / 2.2)
    return np.ascontiguousarray((tone * 255).astype(np.uint8)[:, :, ::-1])
