"""Turns rendered patches into training batches: a fresh random camera for every view of every patch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import pi
from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor
from torch.utils.data import Dataset, Sampler

from egotouch_sdk.patches import HOST_UNKNOWN, normalise
from egotouch_sdk.synthetic.air import in_the_air
from egotouch_sdk.synthetic.camera import photograph
from egotouch_sdk.synthetic.camera_settings import draw_settings
from egotouch_sdk.training.shards import HOVER_MAX_MM, PatchLabel, RenderedPatch

#: Share of training samples whose host place is withheld, so that the model also works when the host is unknown.
HOST_UNKNOWN_SHARE = 0.5
#: Spread of the tracker's error on R (relative) and theta (radians) in training (our choice).
POLAR_JITTER = (0.05, 0.06)
#: Share of hovers whose surroundings are replaced by clutter, so that a hand before anything but skin is no touch (our choice).
AIR_SHARE = 0.08
#: Share of touches that may be drags, and how far these move during an exposure relative to a finger in the air (our choice).
DRAG_SHARE, DRAG_MOTION = 0.35, 0.35
#: Share of mirrored training samples, their theta negated.
FLIP_SHARE = 0.5


class Sample(NamedTuple):
    """Tensors of one sample or one batch: `patch` (3, 100, 100), `polar` (2,), `touch`, `force_n`, `hover_mm` scalars."""

    patch: Tensor
    polar: Tensor
    touch: Tensor
    force_n: Tensor
    hover_mm: Tensor


def view(rendered: RenderedPatch, rng: np.random.Generator) -> tuple[npt.NDArray[np.uint8], tuple[float, float]]:
    """One camera picture, uint8 (100, 100, 3) RGB, with its (r_palms, theta_rad)."""
    label = rendered.label
    settings = draw_settings(rng)
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


class PatchDataset(Dataset[Sample]):
    """Item (index, seed) is patch `index` seen by the random camera of `seed`; `air_share` of the hovers lose their host."""

    def __init__(self, rendered: Sequence[RenderedPatch], air_share: float = 0.0) -> None:
        self.rendered = rendered
        self.air_share = air_share

    def __len__(self) -> int:
        return len(self.rendered)

    def __getitem__(self, key: tuple[int, int]) -> Sample:
        cv2.setNumThreads(1)
        index, seed = key
        rendered, rng = self.rendered[index], np.random.default_rng(seed)
        if not rendered.label.touch and rng.random() < self.air_share:
            rendered = RenderedPatch(in_the_air(rendered.layers, rng), replace(rendered.label, hover_mm=HOVER_MAX_MM))
        image, polar = view(rendered, rng)
        label = rendered.label
        return Sample(
            patch=torch.from_numpy(normalise(image[None])[0]),
            polar=torch.tensor(polar, dtype=torch.float32),
            touch=torch.tensor(float(label.touch)),
            force_n=torch.tensor(label.force_n),
            hover_mm=torch.tensor(label.hover_mm),
        )


class SeededOrder(Sampler[tuple[int, int]]):
    """Draws patch and camera; the draw depends on run seed, epoch and position only.

    An epoch has as many draws as there are patches. Without `weights` each patch comes once, with them in that proportion on average.
    """

    def __init__(self, count: int, seed: int, weights: npt.NDArray[np.floating] | None = None) -> None:
        self.count, self.seed, self.epoch = count, seed, 0
        self.shares = None if weights is None else weights / weights.sum()

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[tuple[int, int]]:
        rng = np.random.default_rng([self.seed, self.epoch])
        seeds = rng.integers(0, 2**62, self.count)
        order = rng.permutation(self.count) if self.shares is None else rng.choice(self.count, self.count, p=self.shares)
        yield from ((int(i), int(s)) for i, s in zip(order, seeds, strict=True))


def finger_weights(labels: Sequence[PatchLabel]) -> npt.NDArray[np.float64]:
    """Weights (N,) that bring rare fingers halfway (by square root) to the same share: renders lose more thumbs to occlusion."""
    fingers = np.array([label.finger for label in labels])
    return np.array([1 / np.sqrt((fingers == finger).sum()) for finger in fingers])


def collate(samples: Sequence[Sample]) -> Sample:
    """Stack samples into a batch."""
    return Sample(*(torch.stack(column) for column in zip(*samples, strict=True)))


def fixed_views(rendered: Sequence[RenderedPatch], views: int, seed: int) -> tuple[list[int], Sample]:
    """The held-out pictures: `views` fixed random cameras per patch, as patch indices and one batch."""
    keys = [(i, int(np.random.default_rng([seed, i, v]).integers(2**62))) for v in range(views) for i in range(len(rendered))]
    dataset = PatchDataset(rendered)
    return [index for index, _ in keys], collate([dataset[key] for key in keys])
