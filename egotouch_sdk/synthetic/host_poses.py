"""Random touches without pictures: exact landmarks of both hands and the exact answer, about five scenes a second."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.host_truth import HostTruth, view_of
from egotouch_sdk.synthetic.patches_job import participant
from egotouch_sdk.synthetic.stage import ImpossibleSceneError
from egotouch_sdk.synthetic.stills import draw_scene


def draw_poses(count: int, participants: tuple[int, ...], seed: int) -> Iterator[HostTruth]:
    """`count` views of scenes drawn as for stills; the same arguments give the same ones."""
    host, touching = HandRig("left"), HandRig("right")
    for index in range(count):
        number = participants[index % len(participants)]
        try:
            stage, touch, camera = draw_scene(np.random.default_rng([seed, index]), host, touching, participant(number), detail=False)
        except ImpossibleSceneError:
            continue
        yield view_of(stage, touch, camera, number)
