"""The training-time camera: rendered light layers and albedo in, a patch as a real camera would give it out.

A render stores the light of separate lamps and the skin's albedo; mixing, colouring, exposing and blurring them here gives many
pictures of one render. Order of steps as in a camera: light, skin, framing, motion, lens, sensor, tone, JPEG or H.264, upscaling.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, cos, hypot, pi, sin, sqrt

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.observation import PATCH_PX
from egotouch_sdk.synthetic.camera_settings import CameraSettings
from egotouch_sdk.synthetic.coding import through_h264, through_jpeg
from egotouch_sdk.synthetic.sensor import LUMA, develop, upscale
from egotouch_sdk.synthetic.srgb import srgb_to_linear

FloatImage = npt.NDArray[np.float32]

BACKGROUND, HOST, TOUCHING_HAND = 0, 1, 2
#: Step in depth at which the groove along the outline has lost two thirds of its strength, in millimetres (our choice).
CREASE_STEP_MM = 4.0
#: Linear value of each sRGB code (IEC 61966-2-1).
SRGB_TO_LINEAR = srgb_to_linear(np.arange(256)).astype(np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class LightLayers:
    """One rendered fingertip before the camera, at 2.5 px per mm with the tip at the centre and the finger up.

    `light` (S, S, 3) float: linear irradiance of the key, window and ambient lights, 1 = white diffuse in the open.
    `depth_mm` (S, S) float: distance from the camera relative to the tip, larger = farther.
    `albedo` (S, S, 3) uint8: sRGB-encoded RGB. `segment` (S, S) uint8: 0 background, 1 host limb, 2 touching hand.
    S is at least 100, more leaves room for shifts. Raises `FrameError` for shapes or types that do not fit.
    """

    light: npt.NDArray[np.floating]
    albedo: npt.NDArray[np.uint8]
    segment: npt.NDArray[np.uint8]
    depth_mm: npt.NDArray[np.floating]

    def __post_init__(self) -> None:
        side = self.segment.shape[0]
        shapes = (self.light.shape, self.albedo.shape, self.segment.shape, self.depth_mm.shape)
        if shapes != ((side, side, 3), (side, side, 3), (side, side), (side, side)) or side < PATCH_PX:
            raise FrameError(f"light, albedo, segment and depth have shapes {shapes}; need squares of {PATCH_PX} px or more")
        if self.albedo.dtype != np.uint8 or self.segment.dtype != np.uint8:
            raise FrameError(f"albedo is {self.albedo.dtype} and segment {self.segment.dtype}, need uint8")


def photograph(layers: LightLayers, settings: CameraSettings, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    """A patch, uint8 (100, 100, 3) RGB, through the given camera; `rng` draws the sensor's noise."""
    return photograph_film([layers], [settings], rng)[0]


def photograph_film(
    layers: Sequence[LightLayers], settings: Sequence[CameraSettings], rng: np.random.Generator
) -> list[npt.NDArray[np.uint8]]:
    """The T patches of a film as `photograph` gives them, coded as one video where the first frame's settings have a `crf`.

    The pixels across the patch must not change in a film.
    """
    raw = [develop(_to_sensor(each, how), how, rng) for each, how in zip(layers, settings, strict=True)]
    if settings[0].crf is not None:
        return [upscale(picture) for picture in through_h264(raw, settings[0].crf)]
    return [upscale(through_jpeg(picture, how.jpeg_quality)) for picture, how in zip(raw, settings, strict=True)]


def _to_sensor(layers: LightLayers, settings: CameraSettings) -> FloatImage:
    """Linear light on the sensor, float (100, 100, 3), exposed."""
    to_layers = framing(layers.segment.shape[0], settings)
    light = _warp(np.asarray(layers.light, np.float32), to_layers)
    albedo = _warp(SRGB_TO_LINEAR[layers.albedo], to_layers)
    segment = np.asarray(_warp(layers.segment, to_layers, cv2.INTER_NEAREST), np.uint8)
    light = _deepen_shade(_smooth_within(light, segment, settings.sample_blur_px), segment, settings.occlusion_power)
    light = light * _fold_shade(segment, settings.folds)[..., None]
    if settings.crease_depth > 0:
        depth_mm = _warp(np.asarray(layers.depth_mm, np.float32), to_layers, cv2.INTER_NEAREST)
        light = light * (1 - settings.crease_depth * groove(depth_mm, segment, settings.crease_width_px))[..., None]
    image = _skin(albedo, segment, settings) * _illuminate(light, segment, settings)
    if settings.distractor is not None:
        image = _add_distractor(image, segment, settings.distractor)
    image = _blur_moving_finger(image, segment, settings.finger_motion_px)
    image = _optics(image, settings)
    return _expose(image, segment, settings)


def framing(side_px: int, settings: CameraSettings) -> npt.NDArray[np.float64]:
    """Affine map (2, 3) from patch pixels to layer pixels: that of `cut_patch`, around where the tracker believes the tip to be."""
    step = 1 / settings.scale
    c, s = cos(settings.turn_rad) * step, sin(settings.turn_rad) * step
    centre, middle = (side_px - 1) / 2, (PATCH_PX - 1) / 2
    dx, dy = middle + settings.shift_px[0], middle + settings.shift_px[1]
    turn = np.array([[c, -s], [s, c]])
    if settings.lens is not None:
        turn = turn @ np.linalg.inv(settings.lens.stretch())
    return np.column_stack([turn, centre - turn @ (dx, dy)])


def _warp(
    image: npt.NDArray[np.floating] | npt.NDArray[np.uint8], to_image: npt.NDArray[np.float64], interpolation: int = cv2.INTER_LINEAR
) -> FloatImage:
    size = (PATCH_PX, PATCH_PX)
    flags = interpolation | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpAffine(image, to_image, size, flags=flags, borderMode=cv2.BORDER_REPLICATE), np.float32)


def _smooth_within(light: FloatImage, segment: npt.NDArray[np.uint8], sigma_px: float) -> FloatImage:
    """Blur inside the hand and outside it separately, so that the light at the finger's outline keeps its edge."""
    hand = (segment == TOUCHING_HAND).astype(np.float32)
    smooth = np.empty_like(light)
    for part in (hand, 1 - hand):
        inside = part > 0
        cover = cv2.GaussianBlur(part, (0, 0), sigma_px)[..., None]
        blurred = cv2.GaussianBlur(light * part[..., None], (0, 0), sigma_px) / np.maximum(cover, 1e-3)
        smooth[inside] = blurred[inside]
    return smooth


def _deepen_shade(light: FloatImage, segment: npt.NDArray[np.uint8], power: float) -> FloatImage:
    """Raise each layer to `power` below its level on open skin (80th percentile), leaving what is brighter."""
    if power == 1.0:
        return light
    skin = light[segment != BACKGROUND]
    open_level = np.maximum(np.percentile(skin[::7] if len(skin) > 50 else light.reshape(-1, 3), 80, axis=0), 1e-3)
    shade = np.clip(light / open_level, 0.02, 1.0)
    return np.asarray(light * cv2.pow(shade.astype(np.float32), power - 1), np.float32)


def groove(depth_mm: FloatImage, segment: npt.NDArray[np.uint8], width_px: float) -> FloatImage:
    """How much of a groove (0..1) each pixel lies in: 1 where skin reaches up to the finger's visible outline.

    A pressed finger sinks in and the skin hugs its flanks in a groove of under a millimetre, finer than the contact mesh and the
    light filter resolve. It follows from the step in depth across the outline, for touches and hovers alike: in our renders 0 to 3 mm
    for firm touches, 3 to 5 mm for light ones, 7 mm and more for every hover, where no groove is left.
    """
    hand = segment == TOUCHING_HAND
    outline = (cv2.dilate(hand.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0) & (segment == HOST)
    flank_mm = cv2.dilate(np.where(hand, depth_mm, -1e3).astype(np.float32), np.ones((7, 7), np.uint8))
    step_mm = np.clip(depth_mm - flank_mm, 0.0, 50.0)
    closeness = np.where(outline, np.exp(-((step_mm / CREASE_STEP_MM) ** 2)), 0.0).astype(np.float32)
    spread = cv2.GaussianBlur(closeness, (0, 0), width_px) * np.float32(width_px * sqrt(2 * pi))
    return np.asarray(np.clip(spread, 0.0, 1.0), np.float32)


def _fold_shade(segment: npt.NDArray[np.uint8], folds: npt.NDArray[np.float32]) -> FloatImage:
    """Factor on the light (1 = none lost) from dark folds in the host's skin."""
    shade = np.ones(segment.shape, np.float32)
    t = np.linspace(0, 1, 16)[:, None]
    for x0, y0, x1, y1, x2, y2, width_px, depth in folds:
        curve = (1 - t) ** 2 * (x0, y0) + 2 * t * (1 - t) * (x1, y1) + t**2 * (x2, y2)
        line = np.zeros(segment.shape, np.float32)
        cv2.polylines(line, [np.round(curve).astype(np.int32)], False, 1.0, 1, cv2.LINE_AA)
        spread = cv2.GaussianBlur(line, (0, 0), float(width_px)) * float(width_px * sqrt(2 * pi))
        shade *= 1 - float(depth) * np.minimum(spread, 1.0)
    return np.where(segment == HOST, shade, np.float32(1.0))


def _illuminate(light: FloatImage, segment: npt.NDArray[np.uint8], settings: CameraSettings) -> FloatImage:
    """Coloured irradiance, redder where little light arrives: it got there over skin (interreflection)."""
    mixed = np.maximum(light @ settings.light_gains, 1e-4)
    luma = mixed @ LUMA
    skin = luma[segment != BACKGROUND]
    open_level = float(np.percentile(skin[::7], 90)) if skin.size > 50 else float(luma.max())
    scarcity = np.clip(luma / max(open_level, 1e-3), 0.03, 1.0)
    log_scarcity = np.log(scarcity)[..., None]
    return np.asarray(mixed * np.exp(log_scarcity * settings.crevice_tint), np.float32)


def _skin(albedo: FloatImage, segment: npt.NDArray[np.uint8], settings: CameraSettings) -> FloatImage:
    toned = cv2.pow(albedo, settings.tone_power)
    gains = settings.tone_gains[segment]
    return np.asarray(np.clip(toned * gains, 0.0, 1.0), np.float32)


def _add_distractor(image: FloatImage, segment: npt.NDArray[np.uint8], distractor: tuple[float, float, float, float, float]) -> FloatImage:
    """Draw a rounded tab at the finger's edge in the given row: a sensor, a plaster, a bit of cloth."""
    row, side, width, height, level = distractor
    columns = np.flatnonzero(segment[int(row)] == TOUCHING_HAND)
    if not columns.size:
        return image
    edge = int(columns[0] if side < 0 else columns[-1])
    tab = np.zeros(segment.shape, np.float32)
    cv2.ellipse(tab, (int(edge + side * width / 3), int(row)), (ceil(width / 2), ceil(height / 2)), 0, 0, 360, 1.0, -1, cv2.LINE_AA)
    tab = tab[..., None]
    return np.asarray(image * (1 - tab) + tab * level * float(image.mean()), np.float32)


def _motion_kernel(path_px: tuple[float, float]) -> FloatImage:
    """A line of unit sum along the path (x right, y down)."""
    size = ceil(max(abs(path_px[0]), abs(path_px[1]))) | 1
    kernel = np.zeros((size + 2, size + 2), np.float32)
    centre = (size + 1) / 2
    for t in np.linspace(-0.5, 0.5, 2 * size + 1):
        kernel[round(centre + t * path_px[1]), round(centre + t * path_px[0])] += 1
    return kernel / kernel.sum()


def _blur_moving_finger(image: FloatImage, segment: npt.NDArray[np.uint8], path_px: tuple[float, float]) -> FloatImage:
    """Smear the touching hand alone over what lies behind it, which is filled in from its surroundings."""
    if hypot(*path_px) < 1.0:
        return image
    hand = (segment == TOUCHING_HAND).astype(np.float32)
    visible = 1 - cv2.dilate(hand, np.ones((3, 3), np.uint8))
    near = cv2.GaussianBlur(image * visible[..., None], (0, 0), 5) / (cv2.GaussianBlur(visible, (0, 0), 5)[..., None] + 1e-3)
    behind = image * visible[..., None] + near * (1 - visible[..., None])
    kernel = _motion_kernel(path_px)
    cover = cv2.filter2D(hand, -1, kernel, borderType=cv2.BORDER_REPLICATE)[..., None]
    moving = cv2.filter2D(image * hand[..., None], -1, kernel, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(moving + behind * (1 - cover), np.float32)


def _optics(image: FloatImage, settings: CameraSettings) -> FloatImage:
    if hypot(*settings.camera_motion_px) >= 1.0:
        image = np.asarray(cv2.filter2D(image, -1, _motion_kernel(settings.camera_motion_px), borderType=cv2.BORDER_REPLICATE), np.float32)
    image = np.asarray(cv2.GaussianBlur(image, (0, 0), settings.optical_blur_px), np.float32)
    return image if settings.lens is None else settings.lens.split_colours(image * settings.lens.fall_off())


def _expose(image: FloatImage, segment: npt.NDArray[np.uint8], settings: CameraSettings) -> FloatImage:
    """Scale so that the skin's mean meets its level, never the whole frame's: the background must not decide."""
    skin = image[segment != BACKGROUND] if (segment != BACKGROUND).any() else image.reshape(-1, 3)
    gain = settings.skin_level / max(float(skin.mean(0) @ LUMA), 1e-4)
    return np.asarray(image * (gain * settings.white_balance), np.float32)
