"""Turns renders into training batches: a fresh random camera for every view of every patch or film."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor
from torch.utils.data import Dataset, Sampler

from egotouch_sdk.patches import normalise
from egotouch_sdk.synthetic.air import in_the_air
from egotouch_sdk.training.augment import view
from egotouch_sdk.training.films import RenderedFilm, before_clutter, view_film
from egotouch_sdk.training.folder import Rendered
from egotouch_sdk.training.shards import HOVER_MAX_MM, PatchLabel, RenderedPatch


class Sample(NamedTuple):
    """Tensors of one sample of T frames, T = 1 for a patch, or of a batch with N in front.

    `patch` (T, 3, 100, 100), `polar` (T, 2), `touch`, `force_n`, `hover_mm` (T,).
    """

    patch: Tensor
    polar: Tensor
    touch: Tensor
    force_n: Tensor
    hover_mm: Tensor


class PatchDataset(Dataset[Sample]):
    """Item (index, seed) is patch or film `index` seen by the random camera of `seed`; `air_share` of the hovers lose their host.

    `ordinary` cameras are in good order; training's vary more widely than cameras do. Of a film `frames` are shown, None for all.
    """

    def __init__(
        self, rendered: Sequence[Rendered], air_share: float = 0.0, ordinary: bool = False, frames: int | None = None
    ) -> None:
        self.rendered, self.air_share, self.ordinary, self.frames = rendered, air_share, ordinary, frames

    def __len__(self) -> int:
        return len(self.rendered)

    def __getitem__(self, key: tuple[int, int]) -> Sample:
        cv2.setNumThreads(1)
        index, seed = key
        rendered, rng = self.rendered[index], np.random.default_rng(seed)
        in_air = not any(label.touch for label in rendered.labels) and rng.random() < self.air_share
        if isinstance(rendered, RenderedFilm):
            rendered = before_clutter(rendered, rng) if in_air else rendered
            count = len(rendered.labels)
            chosen = sorted(rng.permutation(count)[: self.frames].tolist()) if self.frames else range(count)
            images, polar = view_film(rendered, rng, self.ordinary, chosen)
            labels = tuple(rendered.labels[k] for k in chosen)
        else:
            if in_air:
                rendered = RenderedPatch(in_the_air(rendered.layers, rng), replace(rendered.label, hover_mm=HOVER_MAX_MM))
            image, place = view(rendered, rng, self.ordinary)
            labels = rendered.labels
            images, polar = image[None], np.array([place], np.float32)
        return Sample(
            patch=torch.from_numpy(normalise(images)),
            polar=torch.from_numpy(polar),
            touch=torch.tensor([float(label.touch) for label in labels]),
            force_n=torch.tensor([label.force_n for label in labels]),
            hover_mm=torch.tensor([label.hover_mm for label in labels]),
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


def fixed_views(rendered: Sequence[Rendered], views: int, seed: int) -> tuple[list[int], Sample]:
    """The held-out pictures: `views` fixed ordinary cameras per patch or film, as their indices and one batch."""
    keys = [(i, int(np.random.default_rng([seed, i, v]).integers(2**62))) for v in range(views) for i in range(len(rendered))]
    dataset = PatchDataset(rendered, ordinary=True)
    return [index for index, _ in keys], collate([dataset[key] for key in keys])
