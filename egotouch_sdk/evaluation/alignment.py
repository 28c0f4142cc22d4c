"""Frame scores after a hard alignment in time: dynamic time warping within a Sakoe-Chiba band, solved exactly.

The paper corrects its frame scores by DTW with a radius of 4 frames (EgoTouch, UIST'24), 133 ms at 30 frames per second. Its library
only approximates that: its radius is no hard limit. Here no frame is ever compared with one more than `radius` frames away.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from egotouch_sdk.evaluation.confusion import Bools, Confusion

#: Frames that a call may be early or late (EgoTouch, UIST'24).
RADIUS = 4
_FAR = (1 << 60, 0)


def align(touch: Bools, called: Bools, radius: int = RADIUS) -> list[tuple[int, int]]:
    """The warping path between truth (T,) and calls (T,): pairs (frame of the truth, frame of the calls), both from 0 to T - 1.

    Every frame of either side is on it, in order, and the two frames of a pair are at most `radius` apart. Of all such paths it has
    the fewest pairs that disagree, and of those the fewest pairs; where that leaves a choice, steps in both come late.
    """
    frames, width = len(touch), 2 * radius + 1
    if not frames:
        return []
    truth, calls = touch.tolist(), called.tolist()
    cost: list[list[tuple[int, int]]] = []
    for i in range(frames):
        row = [_FAR] * width
        above = cost[-1] if cost else None
        for k in range(max(radius - i, 0), min(width, frames - i + radius)):
            before = (0, 0) if i == 0 and k == radius else _FAR
            if above is not None:
                before = min(above[k], above[k + 1] if k + 1 < width else _FAR)
            if k > 0:
                before = min(before, row[k - 1])
            row[k] = (before[0] + (truth[i] != calls[i + k - radius]), before[1] + 1)
        cost.append(row)
    return _trace(cost, radius)


def _trace(cost: list[list[tuple[int, int]]], radius: int) -> list[tuple[int, int]]:
    i, k, width = len(cost) - 1, radius, 2 * radius + 1
    path = [(i, i)]
    while (i, k) != (0, radius):
        steps = []
        if i > 0:
            steps.append((cost[i - 1][k], i - 1, k))
            if k + 1 < width:
                steps.append((cost[i - 1][k + 1], i - 1, k + 1))
        if k > 0:
            steps.append((cost[i][k - 1], i, k - 1))
        _, i, k = min(steps, key=lambda step: step[0])
        path.append((i, i + k - radius))
    return path[::-1]


def aligned_confusion(touch: Bools, called: Bools, gate: Bools, radius: int = RADIUS) -> Confusion:
    """Calls against the truth over the pairs of the alignment, each run of open frames (`gate`, (T,)) for itself."""
    total = Confusion()
    for start, stop in runs(gate):
        path = np.array(align(touch[start:stop], called[start:stop], radius))
        total = total + Confusion.of(touch[start:stop][path[:, 0]], called[start:stop][path[:, 1]])
    return total


def runs(flags: Bools | Sequence[bool]) -> list[tuple[int, int]]:
    """First frame and first frame after of every run of True in (T,)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], np.asarray(flags, bool), [False]]).astype(np.int8)))
    return [(int(start), int(stop)) for start, stop in list(pairwise(edges.tolist()))[::2]]
