from dataclasses import replace
from math import radians

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import FrameError
from egotouch_sdk.patches import PATCH_PX_PER_MM, cut_patch
from egotouch_sdk.synthetic.camera import LightLayers, framing, photograph, photograph_film
from egotouch_sdk.synthetic.camera_settings import CameraSettings, draw_settings
from egotouch_sdk.synthetic.lens import Lens

SIDE = 144


def seen_by_chance(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return photograph(layers(), draw_settings(rng), rng)


def layers(side: int = SIDE, step_mm: float = 10.0) -> LightLayers:
    y, x = np.mgrid[:side, :side] - side / 2
    finger = (np.abs(x) < 25) & (y > -10)
    segment = np.where(finger, 2, 1).astype(np.uint8)
    segment[: side // 10] = 0
    albedo = np.where(segment[..., None] == 2, [205, 150, 125], [215, 150, 140]).astype(np.uint8)
    light = np.repeat((0.8 + 0.2 * x / side)[..., None], 3, 2).astype(np.float16)
    depth_mm = np.where(segment == 2, 0.0, step_mm).astype(np.float16)
    return LightLayers(light, albedo, segment, depth_mm)


def plain(seed: int = 0) -> CameraSettings:
    """A camera that adds nothing, to change one thing at a time."""
    return replace(
        draw_settings(np.random.default_rng(seed)), occlusion_power=1.0, sample_blur_px=0.5, crease_depth=0.0,
        folds=np.zeros((0, 8), np.float32),
        shift_px=(0.0, 0.0), turn_rad=0.0, scale=1.0, native_px=100,
        finger_motion_px=(0.0, 0.0), camera_motion_px=(0.0, 0.0), optical_blur_px=0.5, noise=1e-6, sharpening=0.0, jpeg_quality=95,
        distractor=None, haze=0.0, contrast=1.0, saturation=1.0, skin_level=0.2, shoulder=0.0, gamma=2.2, tone_power=1.0,
        white_balance=np.ones(3, np.float32), tone_gains=np.ones((3, 3), np.float32),
        light_gains=np.full((3, 3), 1 / 3, np.float32), crevice_tint=np.zeros(3, np.float32),
    )  # fmt: skip


def shoot(settings: CameraSettings) -> np.ndarray:
    return photograph(layers(), settings, np.random.default_rng(0)).astype(float)


def test_one_seed_gives_one_picture_and_two_seeds_two() -> None:
    first, again, other = (seen_by_chance(seed) for seed in (4, 4, 5))
    assert first.shape == (100, 100, 3) and first.dtype == np.uint8
    assert np.array_equal(first, again) and not np.array_equal(first, other)


def test_pictures_vary_like_cameras_do_and_stay_usable() -> None:
    pictures = [seen_by_chance(seed) for seed in range(150)]
    luma = np.array([cv2.cvtColor(p, cv2.COLOR_RGB2GRAY).astype(float) for p in pictures])
    means, sharpness = luma.mean((1, 2)), [cv2.Laplacian(image, cv2.CV_64F).var() for image in luma]
    assert 80 < means.mean() < 180 and means.std() > 15
    assert np.median(luma.std((1, 2))) > 3
    assert np.percentile(sharpness, 90) > 3 * np.percentile(sharpness, 10)
    assert np.mean([(p == 255).all(2).mean() for p in pictures]) < 0.05


def test_exposure_is_metered_on_skin_whatever_the_background() -> None:
    bright, dark = layers(), layers()
    bright.albedo[bright.segment == 0], dark.albedo[dark.segment == 0] = 255, 5
    skin = np.s_[40:100, 10:90]
    pictures = [photograph(item, plain(), np.random.default_rng(0)).astype(float) for item in (bright, dark)]
    assert abs(pictures[0][skin].mean() - pictures[1][skin].mean()) < 3
    expected = 255 * 0.2 ** (1 / 2.2)
    assert pictures[0][skin].mean() == pytest.approx(expected, rel=0.1)


def test_finger_motion_smears_the_finger_and_leaves_the_host_sharp() -> None:
    speckled = layers()
    speckled.albedo[...] = (speckled.albedo * np.random.default_rng(0).uniform(0.7, 1.0, (SIDE, SIDE, 1))).astype(np.uint8)
    still = photograph(speckled, plain(), np.random.default_rng(0)).astype(float)
    moving = photograph(speckled, replace(plain(), finger_motion_px=(12.0, 0.0)), np.random.default_rng(0)).astype(float)
    finger, host = np.s_[60:95, 35:65], np.s_[20:95, 2:12]
    assert moving[finger][..., 1].std() < 0.7 * still[finger][..., 1].std()
    assert moving[host].std() == pytest.approx(still[host].std(), rel=0.05)


def test_crevices_turn_redder_than_open_skin() -> None:
    shaded = layers()
    shaded.light[100:110] *= 0.2
    tint = np.array([-0.2, 0.0, 0.1], np.float32)
    row, open_row = np.s_[80:86, 5:20], np.s_[50:56, 5:20]
    grey = photograph(shaded, plain(), np.random.default_rng(0)).astype(float)
    red = photograph(shaded, replace(plain(), crevice_tint=tint), np.random.default_rng(0)).astype(float)
    ratio = lambda picture, part: picture[part][..., 0].mean() / picture[part][..., 2].mean()  # noqa: E731
    assert ratio(red, row) > 1.1 * ratio(grey, row)
    assert ratio(red, open_row) == pytest.approx(ratio(grey, open_row), rel=0.03)


def test_shift_moves_the_finger_by_that_many_pixels() -> None:
    def left_edge(settings: CameraSettings) -> int:
        blue = shoot(settings)[80, :, 2]
        return int(np.abs(np.diff(blue))[:50].argmax())

    assert left_edge(replace(plain(), shift_px=(10.0, 0.0))) - left_edge(plain()) == pytest.approx(10, abs=1)


def test_lower_resolution_and_more_blur_lose_detail() -> None:
    def sharpness(settings: CameraSettings) -> float:
        return float(cv2.Laplacian(shoot(settings).mean(2), cv2.CV_64F).var())

    assert sharpness(replace(plain(), native_px=25)) < sharpness(plain())
    assert sharpness(replace(plain(), optical_blur_px=2.5)) < sharpness(plain())


def test_settings_never_depend_on_the_label_and_stay_in_range() -> None:
    drawn = [draw_settings(np.random.default_rng(seed)) for seed in range(400)]
    assert max(np.hypot(*s.finger_motion_px) for s in drawn) <= 16.0
    assert 0.3 < np.mean([np.hypot(*s.finger_motion_px) > 0 for s in drawn]) < 0.5
    assert all(20 <= s.native_px <= 130 and 0.75 <= s.scale <= 1.45 and max(map(abs, s.shift_px)) <= 12 for s in drawn)
    assert all(45 <= s.jpeg_quality <= 95 for s in drawn)


@pytest.mark.parametrize("bad", ["small", "dtype", "shape"])
def test_layers_that_do_not_fit_are_refused(bad: str) -> None:
    good = layers()
    light, albedo, segment = {
        "small": (good.light[:80, :80], good.albedo[:80, :80], good.segment[:80, :80]),
        "dtype": (good.light, good.albedo.astype(np.float32), good.segment),
        "shape": (good.light[:-1], good.albedo, good.segment),
    }[bad]
    with pytest.raises(FrameError):
        LightLayers(light, albedo, segment, good.depth_mm[: len(segment), : len(segment)])


def test_deeper_shade_darkens_the_crevice_and_not_open_skin() -> None:
    shaded = layers()
    shaded.light[100:110] *= 0.5
    crevice, open_skin = np.s_[80:86, 5:20], np.s_[50:56, 5:20]

    def ratio(power: float) -> float:
        picture = photograph(shaded, replace(plain(), occlusion_power=power), np.random.default_rng(0)).astype(float)
        return float(picture[crevice].mean() / picture[open_skin].mean())

    assert ratio(1.0) == pytest.approx(0.5 ** (1 / 2.2), rel=0.1)
    assert ratio(2.5) < 0.75 * ratio(1.0)


def test_sampling_noise_is_smoothed_and_the_outline_keeps_its_edge() -> None:
    noisy = layers()
    noisy.light[...] = np.where((noisy.segment == 2)[..., None], 1.0, 0.4)
    noisy.light[...] += np.random.default_rng(0).normal(0, 0.1, noisy.light.shape)

    def shot(blur_px: float) -> np.ndarray:
        return photograph(noisy, replace(plain(), sample_blur_px=blur_px), np.random.default_rng(0)).astype(float)

    flat = np.s_[60:90, 2:15]
    assert shot(2.0)[flat][..., 1].std() < 0.7 * shot(0.3)[flat][..., 1].std()
    step = [np.abs(np.diff(shot(blur)[70:90, 15:40].mean((0, 2)))).max() for blur in (0.3, 2.0)]
    assert step[1] > 0.8 * step[0]


def test_a_groove_darkens_the_outline_where_skin_reaches_up_to_the_finger() -> None:
    outline, open_skin = np.s_[70:90, 23:25], np.s_[70:90, 5:12]

    def darkness(step_mm: float) -> float:
        camera = replace(plain(), crease_depth=0.6, crease_width_px=1.5)
        picture = photograph(layers(step_mm=step_mm), camera, np.random.default_rng(0)).astype(float)
        return float(picture[outline].mean() / picture[open_skin].mean())

    firm, light, hover = darkness(0.0), darkness(4.0), darkness(9.0)
    assert firm < 0.85
    assert firm < light < hover
    assert hover > 0.97


def test_a_fold_darkens_the_host_under_its_line_and_never_the_finger() -> None:
    fold = np.array([[0, 80, 50, 80, 99, 80, 1.0, 0.5]], np.float32)
    before, after = shoot(plain()), shoot(replace(plain(), folds=fold))
    assert after[80, 5:15].mean() < 0.85 * before[80, 5:15].mean()
    assert after[60, 5:15].mean() == pytest.approx(before[60, 5:15].mean(), rel=0.02)
    assert after[80, 45:55].mean() == pytest.approx(before[80, 45:55].mean(), rel=0.03)


def test_a_lens_stretches_darkens_and_splits_what_the_plain_camera_shows() -> None:
    straight = shoot(plain())
    wide = shoot(replace(plain(), lens=Lens(radians(38), 0.0, barrel=0.0, shading=0.8, fringe_px=1.0)))
    assert (wide[90, :, 1] < 130).sum() >= (straight[90, :, 1] < 130).sum()
    assert np.abs(wide - straight).mean() > 2
    assert wide[:, 5:15].mean() - wide[:, 85:95].mean() > straight[:, 5:15].mean() - straight[:, 85:95].mean() + 5


def test_a_film_as_video_differs_from_the_same_film_as_stills_and_keeps_its_order() -> None:
    settings = [replace(plain(), shift_px=(shift, 0.0)) for shift in (-8.0, 0.0, 8.0)]
    stills = photograph_film([layers()] * 3, settings, np.random.default_rng(0))
    video = photograph_film([layers()] * 3, [replace(each, crf=28) for each in settings], np.random.default_rng(0))
    errors = [[np.abs(a.astype(float) - b).mean() for b in video] for a in stills]
    assert np.argmin(errors, axis=1).tolist() == [0, 1, 2] and min(errors[0]) > 0


@pytest.mark.parametrize(("shift", "turn_rad", "scale"), [((0.0, 0.0), 0.0, 1.0), ((7.0, -4.0), 0.2, 1.25), ((-10.0, 5.0), -0.15, 1.0)])
def test_patches_are_framed_as_the_pipeline_cuts_them_around_a_missed_tip(
    shift: tuple[float, float], turn_rad: float, scale: float
) -> None:
    picture = cv2.GaussianBlur(np.random.default_rng(0).integers(0, 255, (SIDE, SIDE, 3), dtype=np.uint8), (0, 0), 3)
    turn = np.array([[np.cos(turn_rad), -np.sin(turn_rad)], [np.sin(turn_rad), np.cos(turn_rad)]])
    believed_px = (SIDE - 1) / 2 - turn @ shift / scale
    cut = cut_patch(picture, believed_px, turn @ (0.0, -1.0), PATCH_PX_PER_MM / scale, False)
    to_picture = framing(SIDE, replace(plain(), shift_px=shift, turn_rad=turn_rad, scale=scale))
    framed = cv2.warpAffine(picture[..., ::-1], to_picture, (100, 100), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP)
    assert np.abs(cut.astype(int) - framed)[5:-5, 5:-5].max() <= 1
