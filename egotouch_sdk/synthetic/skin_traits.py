"""What makes one person's skin different from another's, drawn from a seed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from egotouch_sdk.synthetic.srgb import srgb_to_linear

#: sRGB albedo of the back of the hand for Fitzpatrick types I..VI (our choice, near published skin palettes).
FITZPATRICK_SRGB = np.array(
    [[238, 205, 188], [226, 183, 160], [205, 155, 127], [172, 122, 94], [126, 84, 63], [82, 54, 42]], dtype=np.float64
)
#: The asset's index finger is 13.4 mm wide at its last joint (measured on the mesh); adults' are 14 to 19 mm (our choice of range).
MAX_FINGER_FATNESS_M = 1.8e-3


@dataclass(frozen=True, slots=True)
class SkinTraits:
    """One person's skin.

    `fitzpatrick` 1..6; `tone` and `polish` linear RGB (polish None for bare nails); `scale` of the whole hand, `fatness_m` added
    along the normals, on the fingers also `finger_fatness_m`; `redness`, `creases`, `veins`, `mottle` relative strengths; `hair` 0..3;
    `nail_length` 0..1; `roughness` of the surface 0..1.
    """

    fitzpatrick: float
    tone: tuple[float, float, float]
    scale: float
    fatness_m: float
    finger_fatness_m: float
    redness: float
    creases: float
    veins: float
    mottle: float
    hair: float
    freckles: int
    moles: int
    nail_length: float
    polish: tuple[float, float, float] | None
    roughness: float


def draw_traits(seed: int, fitzpatrick: float) -> SkinTraits:
    """Traits for a seed and a skin type 1..6 (fractions lie between types). Raises `ValueError` outside 1..6."""
    if not 1 <= fitzpatrick <= 6:
        raise ValueError(f"fitzpatrick is {fitzpatrick}, need 1..6")
    rng = np.random.default_rng([seed, 1])
    index = fitzpatrick - 1
    base = np.stack([np.interp(index, range(6), FITZPATRICK_SRGB[:, channel]) for channel in range(3)])
    tone = srgb_to_linear(base) * np.exp(rng.normal(0, 0.06)) * np.exp(rng.normal(0, 0.03, 3))
    polish = srgb_to_linear(rng.uniform(20, 240, 3)) if rng.random() < 0.06 else None
    hairy = rng.random() < 0.55
    freckled = fitzpatrick < 3.2 and rng.random() < 0.4
    return SkinTraits(
        fitzpatrick=fitzpatrick,
        tone=(float(tone[0]), float(tone[1]), float(tone[2])),
        scale=float(rng.uniform(0.88, 1.1)),
        fatness_m=float(rng.normal(0.35e-3, 0.5e-3)),
        finger_fatness_m=float(np.random.default_rng([seed, 3]).uniform(0.0, MAX_FINGER_FATNESS_M)),
        redness=float(rng.uniform(0.5, 1.3)),
        creases=float(rng.uniform(0.5, 1.4)),
        veins=float(rng.uniform(0, 1) * (1 if fitzpatrick < 5 else 0.3)),
        mottle=float(rng.uniform(0.6, 1.2)),
        hair=float(rng.uniform(0.3, 3) if hairy else rng.uniform(0, 0.3)),
        freckles=int(rng.integers(150, 900)) if freckled else int(rng.integers(0, 60)),
        moles=int(rng.poisson(12)),
        nail_length=float(rng.uniform(0, 0.7) * rng.uniform()),
        polish=None if polish is None else (float(polish[0]), float(polish[1]), float(polish[2])),
        roughness=float(rng.uniform(0.36, 0.6)),
    )
