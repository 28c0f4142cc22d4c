"""What a camera, a room and a hand tracker may do to one fingertip picture: the ranges and one draw from them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from math import exp, log, pi, radians

import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.lens import Lens


class LightMix(StrEnum):
    """How the separately rendered lights are mixed."""

    SOFT = "soft"
    KEY = "key"
    MIXED = "mixed"
    DIM = "dim"


#: Share of each mix (our choice: hard light, that of sun and lamps, as often as soft light, since it is the harder to judge).
MIX_SHARES = {LightMix.SOFT: 0.32, LightMix.MIXED: 0.27, LightMix.KEY: 0.31, LightMix.DIM: 0.10}
#: The same for choosing thresholds, which must suit the light that is common: mostly indoor soft light (our choice).
ORDINARY_MIX_SHARES = {LightMix.SOFT: 0.45, LightMix.MIXED: 0.30, LightMix.KEY: 0.12, LightMix.DIM: 0.13}
#: Weight ranges of (key, window, ambient) for each mix.
MIX_WEIGHTS: dict[LightMix, tuple[tuple[float, float], tuple[float, float], tuple[float, float]]] = {
    LightMix.SOFT: ((0.0, 0.05), (0.0, 0.4), (0.6, 1.0)),
    LightMix.MIXED: ((0.1, 0.7), (0.1, 0.8), (0.2, 0.9)),
    LightMix.KEY: ((0.8, 1.6), (0.0, 0.3), (0.1, 0.4)),
    LightMix.DIM: ((0.0, 0.3), (0.0, 0.4), (0.3, 0.8)),
}
#: Depth of the groove beside a pressed finger: with it, touches have creases as dark as photographs of touches (`egotouch synth check`).
CREASE_DEPTH = (0.4, 0.9)
#: Share of pictures with little or no colour, so that colour is never all there is to go by (our choice).
PALE_SHARE = 0.15
#: What an ordinary camera in good order gives: the middle of what training sees (our choice).
_CONTRAST, _HAZE, _SATURATION = (0.8, 1.12), (-0.03, 0.05), (0.8, 1.3)
_SHARPENING, _OPTICAL_BLUR_PX, _JPEG, _ORDINARY_PX = (0.2, 0.9), (0.4, 1.1), (70, 96), 60
#: Largest tip error of the hand tracker in patch pixels, 12 px = 4.8 mm (its p90 in our rendering study was 3.9 to 6.5 mm).
MAX_SHIFT_PX = 12.0
#: Largest error of the finger's direction (our choice).
MAX_TURN_RAD = radians(12.0)
#: Range of the patch scale error.
SCALE_RANGE = (0.75, 1.45)
#: Pixels a camera has on the patch's 40 mm: 20 for 640x480 at 60 cm, 100 and more for 1080p at 30 cm.
NATIVE_RANGE_PX = (20.0, 130.0)


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """One camera, room, skin and tracker error. Colours are linear RGB gains; lengths are patch pixels (2.5 per mm).

    `occlusion_power` deepens shade: each layer is raised to it where it is below the open level, as from smaller lights overhead
    and darker surroundings. `sample_blur_px` smooths the renderer's sampling noise before that, never across an outline.
    `crease_depth` 0..1 and `crease_width_px` darken the groove where skin wells up against the finger's flank.
    `folds` (K, 8): dark skin folds across the host, each the three points of a quadratic curve in patch pixels, width and depth.
    `light_gains` (3, 3): RGB gain of the key, window and ambient layers. `crevice_tint` (3,): exponents added per channel
    where light is scarce (negative = lighter there). `tone_power` bends albedo (above 1 = darker skin), `tone_gains` (3, 3): RGB gain of
    background, host and touching hand. `native_px` is the number of camera pixels across the patch.
    `finger_motion_px` and `camera_motion_px` are (x, y) paths during the exposure. `skin_level` is the linear level that
    exposure gives the mean of the skin. `distractor` is None or (row, side, width, height, level) beside the finger.
    `lens` is None for a picture without a lens's faults, `crf` None for JPEG, else the rate factor of H.264 in its place.
    """

    occlusion_power: float
    sample_blur_px: float
    crease_depth: float
    crease_width_px: float
    folds: npt.NDArray[np.float32]
    light_gains: npt.NDArray[np.float32]
    crevice_tint: npt.NDArray[np.float32]
    tone_power: float
    tone_gains: npt.NDArray[np.float32]
    shift_px: tuple[float, float]
    turn_rad: float
    scale: float
    native_px: int
    finger_motion_px: tuple[float, float]
    camera_motion_px: tuple[float, float]
    optical_blur_px: float
    skin_level: float
    white_balance: npt.NDArray[np.float32]
    noise: float
    noise_grain_px: float
    gamma: float
    shoulder: float
    contrast: float
    haze: float
    saturation: float
    sharpening: float
    jpeg_quality: int
    distractor: tuple[float, float, float, float, float] | None
    lens: Lens | None = None
    crf: int | None = None


def draw_settings(rng: np.random.Generator, mix_shares: dict[LightMix, float] = MIX_SHARES) -> CameraSettings:
    """One random draw, `mix_shares` saying how often each light is met.

    It never looks at the label, so that neither blur nor light nor framing can stand for touch.
    """
    mix = LightMix(str(rng.choice(list(mix_shares), p=list(mix_shares.values()))))
    return CameraSettings(
        occlusion_power=1.0 if rng.random() < 0.3 else float(rng.uniform(1.0, 3.2)),
        sample_blur_px=float(rng.uniform(0.7, 1.8)),
        crease_depth=0.0 if rng.random() < 0.05 else float(rng.uniform(*CREASE_DEPTH)),
        crease_width_px=float(rng.uniform(0.9, 2.2)),
        folds=_folds(rng),
        light_gains=_light_gains(rng, mix),
        crevice_tint=_crevice_tint(rng),
        tone_power=_tone_power(rng),
        tone_gains=_tone_gains(rng),
        shift_px=(_bounded_normal(rng, 4.5, MAX_SHIFT_PX), _bounded_normal(rng, 5.0, MAX_SHIFT_PX)),
        turn_rad=_bounded_normal(rng, MAX_TURN_RAD / 2, MAX_TURN_RAD),
        scale=float(np.clip(exp(rng.normal(0.03, 0.16)), *SCALE_RANGE)),
        native_px=_native_px(rng),
        finger_motion_px=_motion(rng, share=0.4, longest_px=16.0),
        camera_motion_px=_motion(rng, share=0.15, longest_px=6.0),
        optical_blur_px=float(rng.uniform(0.4, 1.6)),
        skin_level=exp(rng.uniform(log(0.10), log(0.38))),
        white_balance=np.exp(rng.normal(0, 0.07, 3)).astype(np.float32),
        noise=exp(rng.uniform(log(0.001), log(0.012))) * (2.0 if mix is LightMix.DIM else 1.0),
        noise_grain_px=float(rng.uniform(0.4, 1.0)),
        gamma=float(rng.uniform(1.9, 2.5)),
        shoulder=float(rng.uniform(0.0, 0.5)),
        contrast=float(rng.uniform(0.55, 1.15)),
        haze=float(rng.uniform(-0.06, 0.10)),
        saturation=float(rng.uniform(0.0, 0.7) if rng.random() < PALE_SHARE else rng.uniform(0.7, 1.4)),
        sharpening=float(max(0.0, rng.uniform(-0.3, 1.2))),
        jpeg_quality=int(rng.integers(45, 96)),
        distractor=_distractor(rng),
    )


def in_good_order(drawn: CameraSettings, rng: np.random.Generator) -> CameraSettings:
    """The same draw from an ordinary camera in good order: training exaggerates, the study and the choice of thresholds do not."""
    return replace(
        drawn,
        contrast=float(rng.uniform(*_CONTRAST)),
        haze=float(rng.uniform(*_HAZE)),
        saturation=float(rng.uniform(*_SATURATION)),
        sharpening=float(rng.uniform(*_SHARPENING)),
        optical_blur_px=float(rng.uniform(*_OPTICAL_BLUR_PX)),
        jpeg_quality=int(rng.integers(*_JPEG)),
        native_px=max(drawn.native_px, _ORDINARY_PX),
    )


def _bounded_normal(rng: np.random.Generator, sigma: float, bound: float) -> float:
    return float(np.clip(rng.normal(0, sigma), -bound, bound))


def _folds(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """A cupped hand has darker and more folds than the rendered one; a third of the pictures stay as rendered."""
    count = 0 if rng.random() < 0.35 else int(rng.integers(1, 5))
    points = rng.uniform(-10, 110, (count, 6))
    return np.column_stack([points, rng.uniform(0.6, 2.0, count), rng.uniform(0.15, 0.7, count)]).astype(np.float32)


def _light_gains(rng: np.random.Generator, mix: LightMix) -> npt.NDArray[np.float32]:
    weights = np.array([rng.uniform(low, high) for low, high in MIX_WEIGHTS[mix]])
    warmth = rng.normal(0, 0.09, 3)
    tint = rng.normal(0, 0.02, 3)
    colours = np.exp(np.stack([warmth, tint, -warmth], 1))
    return (weights[:, None] * colours).astype(np.float32)


def _crevice_tint(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Renders bounce light off one grey of 0.45; skin of types II to IV reflects about 0.45, 0.28 and 0.2, darker skin less."""
    depth = rng.uniform(-0.05, 0.25)
    return np.array([depth - rng.uniform(0, 0.2), depth, depth + rng.uniform(-0.05, 0.15)], np.float32)


def _tone_power(rng: np.random.Generator) -> float:
    """Half of the pictures stay near their tone; the others move towards another one (a power keeps creases and hue)."""
    return exp(rng.normal(0, 0.08) if rng.random() < 0.5 else rng.uniform(log(0.65), log(1.9)))


def _tone_gains(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    skin = np.exp(rng.normal(0, 0.04, 3) + rng.normal(0, 0.08))
    limbs = [skin * np.exp(rng.normal(0, 0.03, 3)) for _ in range(2)]
    background = np.exp(rng.normal(0, 0.5) + rng.normal(0, 0.25, 3))
    return np.stack([background, *limbs]).astype(np.float32)


def _native_px(rng: np.random.Generator) -> int:
    low, high = NATIVE_RANGE_PX
    return int(exp(rng.triangular(log(low), log(80.0), log(high))))


def _motion(rng: np.random.Generator, share: float, longest_px: float) -> tuple[float, float]:
    if rng.random() >= share:
        return 0.0, 0.0
    length, angle = rng.uniform(2.0, longest_px), rng.uniform(0, pi)
    return float(length * np.cos(angle)), float(length * np.sin(angle))


def _distractor(rng: np.random.Generator) -> tuple[float, float, float, float, float] | None:
    """A dark or coloured tab beside the finger, in a fifth of the pictures, touching or not."""
    if rng.random() >= 0.2:
        return None
    side = -1.0 if rng.random() < 0.5 else 1.0
    return float(rng.uniform(45, 90)), side, float(rng.uniform(3, 9)), float(rng.uniform(5, 22)), exp(rng.uniform(log(0.02), log(0.6)))
