"""The skin of the host limb over its landmarks: height and slope at any place of the host frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.surface import Surface

Floats = npt.NDArray[np.float64]
_Terms = tuple[float, float, float, float, float, float]

#: The hand ends at its wrist joint; MediaPipe's wrist landmark lies 16 mm ahead of it (our measurement on the generic WebXR hand).
WRIST_JOINT_Y_MM = -16.0
FOREARM = frozenset({Surface.INNER_FOREARM, Surface.OUTER_FOREARM})


@dataclass(frozen=True, slots=True)
class _Patch:
    """Height of the skin (mm, along the back's normal) and components of its outward normal beside a unit one along z.

    Each is a polynomial in x and y (1, x, y, x^2, xy, y^2); outside `x_mm`, `y_mm` the edge's value holds.
    """

    outward: float
    x_mm: tuple[float, float]
    y_mm: tuple[float, float]
    height: _Terms
    normal_x: _Terms
    normal_y: _Terms


#: Fitted to the contact points and skin normals of 601 posed touches of the generator (participants 0 to 15, our measurement).
#: What is left on the same touches: palm 2.3 mm and 9 degrees, back of the hand 0.9 mm and 3 degrees; forearm 16 to 21 mm and 16 to
#: 20 degrees, as the wrist bends by up to 18 degrees and landmarks do not tell.
_PATCHES = {
    Surface.PALM: _Patch(
        -1.0,
        (-38.0, 38.0),
        (-5.0, 80.0),
        (-30.85, -0.609, -0.0872, -0.00873, 0.00533, 0.00408),
        (-0.243, 0.00719, 0.000141, -0.000214, -0.00028, 0.0000366),
        (-0.543, 0.000964, 0.0335, -0.0000788, 0.0000323, -0.000324),
    ),
    Surface.BACK_OF_HAND: _Patch(
        1.0,
        (-38.0, 38.0),
        (-5.0, 80.0),
        (15.41, -0.0825, -0.092, -0.00922, 0.000231, 0.000444),
        (0.0975, 0.0279, -0.00129, 0.000218, -0.0000934, 0.0000034),
        (0.123, -0.000553, -0.0046, -0.0000179, -0.0000103, 0.0000658),
    ),
    Surface.INNER_FOREARM: _Patch(
        -1.0,
        (-30.0, 30.0),
        (-190.0, -20.0),
        (-15.5, 0.0, 0.0637, 0.0, 0.0, 0.0),
        (-0.149, 0.0239, 0.0, 0.0, 0.0, 0.0),
        (0.14, 0.0, 0.0, 0.0, 0.0, 0.0),
    ),
    Surface.OUTER_FOREARM: _Patch(
        1.0,
        (-30.0, 30.0),
        (-190.0, -20.0),
        (11.5, 0.0, -0.0836, 0.0, 0.0, 0.0),
        (0.118, 0.0187, 0.0, 0.0, 0.0, 0.0),
        (0.045, 0.0, 0.0, 0.0, 0.0, 0.0),
    ),
}


def surface_at(y_mm: float, shows_back: bool) -> Surface:
    """The surface that faces the camera at `y_mm` of the host frame."""
    if y_mm < WRIST_JOINT_Y_MM:
        return Surface.OUTER_FOREARM if shows_back else Surface.INNER_FOREARM
    return Surface.BACK_OF_HAND if shows_back else Surface.PALM


def height_mm(surface: Surface, x_mm: float, y_mm: float) -> float:
    """Height of the skin over the plane of wrist and knuckles, positive out of the back of the hand."""
    patch = _PATCHES[surface]
    return _value(patch.height, patch, x_mm, y_mm)


def normal_at(surface: Surface, x_mm: float, y_mm: float) -> Floats:
    """Outward unit normal (3,) of the skin in the host frame (z out of the back of the hand)."""
    patch = _PATCHES[surface]
    normal = np.array([_value(patch.normal_x, patch, x_mm, y_mm), _value(patch.normal_y, patch, x_mm, y_mm), patch.outward])
    return np.asarray(normal / np.linalg.norm(normal), np.float64)


def _value(terms: _Terms, patch: _Patch, x_mm: float, y_mm: float) -> float:
    x = min(max(x_mm, patch.x_mm[0]), patch.x_mm[1])
    y = min(max(y_mm, patch.y_mm[0]), patch.y_mm[1])
    a, b, c, d, e, f = terms
    return a + b * x + c * y + d * x * x + e * x * y + f * y * y
