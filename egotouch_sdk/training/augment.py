"""One patch as training sees it: through a random camera, with what else changes; shares and spreads are all our choice."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import numpy.typing as npt

from egotouch_sdk.patches import HOST_UNKNOWN
from egotouch_sdk.synthetic.camera import photograph
from egotouch_sdk.synthetic.camera_settings import ORDINARY_MIX_SHARES, CameraSettings, draw_settings, in_good_order
from egotouch_sdk.synthetic.lens import draw_lens
from egotouch_sdk.training.shards import RenderedPatch

#: Share of training samples whose host place is withheld, so that the model also works when the host is unknown.
HOST_UNKNOWN_SHARE = 0.5
#: Spread of the tracker's error on R (relative) and theta (radians) in training.
POLAR_JITTER = (0.05, 0.06)
#: Share of hovers whose surroundings are replaced by clutter, so that a hand before anything but skin is no touch.
AIR_SHARE = 0.08
#: Share of touches that may be drags, and how far these move during an exposure relative to a finger in the air.
DRAG_SHARE, DRAG_MOTION = 0.35, 0.35
#: Share of mirrored training samples, their theta negated.
FLIP_SHARE = 0.5


#: Share of pictures that come from a video stream, and its constant rate factors: 23 is x264's default, from 33 creases are gone.
VIDEO_SHARE, VIDEO_CRF, ORDINARY_CRF = 0.35, (18, 33), (18, 27)


def draw_camera(rng: np.random.Generator, ordinary: bool) -> CameraSettings:
    """One camera of training's wide range, or an ordinary one in common light; both with a lens, as stills or as video."""
    drawn = in_good_order(draw_settings(rng, ORDINARY_MIX_SHARES), rng) if ordinary else draw_settings(rng)
    crf = int(rng.integers(*(ORDINARY_CRF if ordinary else VIDEO_CRF))) if rng.random() < VIDEO_SHARE else None
    return replace(drawn, lens=draw_lens(rng), crf=crf)


def view(rendered: RenderedPatch, rng: np.random.Generator, ordinary: bool = False) -> tuple[npt.NDArray[np.uint8], tuple[float, float]]:
    """One camera picture, uint8 (100, 100, 3) RGB, with its (r_palms, theta_rad); `ordinary` as in `draw_camera`."""
    label = rendered.label
    settings = draw_camera(rng, ordinary)
    if label.touch:
        settings = replace(settings, finger_motion_px=_motion_on_skin(settings.finger_motion_px, rng))
    image = photograph(rendered.layers, settings, rng)
    r_palms = label.r_palms * float(np.exp(rng.normal(0, POLAR_JITTER[0])))
    theta_rad = label.theta_rad + float(rng.normal(0, POLAR_JITTER[1]))
    if rng.random() < FLIP_SHARE:
        image, theta_rad = np.ascontiguousarray(image[:, ::-1]), -theta_rad
    if rng.random() < HOST_UNKNOWN_SHARE:
        return image, HOST_UNKNOWN
    return image, (r_palms, (theta_rad + pi) % (2 * pi) - pi)


def _motion_on_skin(path_px: tuple[float, float], rng: np.random.Generator) -> tuple[float, float]:
    """A pressing finger is held by the skin: it smears over it only while it drags, and less far than one that flies."""
    share = DRAG_MOTION if rng.random() < DRAG_SHARE else 0.0
    return path_px[0] * share, path_px[1] * share
