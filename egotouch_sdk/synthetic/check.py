"""Do renders look like photographs? Statistics of patches, those of real ones beside them, touches and hovers apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.observation import PATCH_PX

Patches = npt.NDArray[np.uint8]
Values = npt.NDArray[np.float64]

#: Where the crease is looked for: within 28 px (11 mm) of the tip, beside and beyond it; the finger's own joint folds lie below.
_NEAR_PX, _BELOW_PX = 28.0, 14.0
#: Thin dark lines up to this many pixels (3.6 mm) wide count as a crease.
_LINE_PX = 9
_CREASE_PERCENTILE, _DARK_PERCENTILE = 95.0, 5.0
#: Effect size (Cohen's d) below which two sets count as alike: his "medium" is 0.5 (Cohen 1988).
ALIKE = 0.5
#: The renders' middle range in percent, and the share of real patches that has to lie in it to call them covered: training varies the
#: camera widely on purpose, so renders need to contain real patches, not to be centred on them.
_RANGE, COVERED = (2.5, 97.5), 0.85


@dataclass(frozen=True, slots=True)
class Row:
    """One statistic over one kind of patch: medians, effect size (positive: renders higher), share of real ones in the renders' range."""

    statistic: str
    kind: str
    renders: float
    real: float
    effect: float
    covered: float

    @property
    def verdict(self) -> str:
        """`alike`, `covered` (renders vary around real patches) or `differs`."""
        if abs(self.effect) < ALIKE:
            return "alike"
        return "covered" if self.covered >= COVERED else "differs"


def _luma(patch: Patches) -> npt.NDArray[np.float32]:
    return np.asarray(cv2.cvtColor(patch, cv2.COLOR_RGB2GRAY), np.float32)


def sharpness(patch: Patches) -> float:
    """Variance of the Laplacian of luma codes."""
    return float(cv2.Laplacian(_luma(patch), cv2.CV_32F).var())


def contrast(patch: Patches) -> float:
    """Standard deviation of luma codes."""
    return float(_luma(patch).std())


def crease(patch: Patches) -> float:
    """How much darker thin lines round the tip are than what is beside them, in percent of the mean luma."""
    luma = _luma(patch)
    lines = cv2.morphologyEx(luma, cv2.MORPH_BLACKHAT, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (_LINE_PX, _LINE_PX)))
    y, x = np.mgrid[0:PATCH_PX, 0:PATCH_PX] - (PATCH_PX - 1) / 2
    near = (np.hypot(x, y) < _NEAR_PX) & (y < _BELOW_PX)
    return float(np.percentile(lines[near], _CREASE_PERCENTILE) / max(float(luma.mean()), 1.0) * 100)


def darkness(patch: Patches) -> float:
    """The darkest 5 % of luma in percent of its mean."""
    luma = _luma(patch)
    return float(np.percentile(luma, _DARK_PERCENTILE) / max(float(luma.mean()), 1.0) * 100)


def saturation(patch: Patches) -> float:
    """Median HSV saturation in percent."""
    return float(np.median(cv2.cvtColor(patch, cv2.COLOR_RGB2HSV)[..., 1]) / 2.55)


def hue(patch: Patches) -> float:
    """Mean hue in degrees in (-180, 180], weighted by saturation; red is 0, skin 5 to 25."""
    hsv = cv2.cvtColor(patch, cv2.COLOR_RGB2HSV).astype(np.float64)
    angle = np.radians(hsv[..., 0] * 2)
    return float(np.degrees(np.arctan2((hsv[..., 1] * np.sin(angle)).sum(), (hsv[..., 1] * np.cos(angle)).sum())))


STATISTICS: Mapping[str, Callable[[Patches], float]] = {
    "sharpness": sharpness,
    "contrast": contrast,
    "crease %": crease,
    "dark 5 % of mean": darkness,
    "saturation %": saturation,
    "hue deg": hue,
}


def effect_size(first: Values, second: Values) -> float:
    """Cohen's d with the pooled standard deviation; 0 where neither varies and both agree."""
    spread = np.sqrt((first.var(ddof=1) * (len(first) - 1) + second.var(ddof=1) * (len(second) - 1)) / max(len(first) + len(second) - 2, 1))
    difference = float(first.mean() - second.mean())
    return difference / float(spread) if spread > 0 else float(np.sign(difference)) * (np.inf if difference else 0.0)


def compare(renders: Patches, renders_touch: npt.NDArray[np.bool_], real: Patches, real_touch: npt.NDArray[np.bool_]) -> list[Row]:
    """All rows of the check: every statistic for touches and for hovers.

    `renders` (N, 100, 100, 3) and `real` (M, 100, 100, 3) uint8 RGB with their labels. Kinds with fewer than two patches on either side
    are left out.
    """
    rows = []
    for name, statistic in STATISTICS.items():
        for kind, ours, theirs in (("touch", renders_touch, real_touch), ("hover", ~renders_touch, ~real_touch)):
            first, second = (np.array([statistic(patch) for patch in patches]) for patches in (renders[ours], real[theirs]))
            if min(len(first), len(second)) < 2:
                continue
            low, high = np.percentile(first, _RANGE)
            rows.append(
                Row(
                    name,
                    kind,
                    float(np.median(first)),
                    float(np.median(second)),
                    effect_size(first, second),
                    float(((second >= low) & (second <= high)).mean()),
                )
            )
    return rows


def table(rows: list[Row]) -> str:
    """The rows as text."""
    lines = [f"{'statistic':<17} {'kind':<6} {'renders':>9} {'real':>9} {'effect d':>9} {'real in range':>14}  verdict"]
    lines += [
        f"{row.statistic:<17} {row.kind:<6} {row.renders:>9.1f} {row.real:>9.1f} {row.effect:>+9.2f} {row.covered:>13.0%}  {row.verdict}"
        for row in rows
    ]
    return "\n".join(lines)
