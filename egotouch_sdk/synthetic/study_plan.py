"""The study's rounds as the paper had them: who touches where with which finger, how, and in which light."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import radians, tan

import numpy as np

from egotouch_sdk.joints import FINGERS, Finger
from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.camera_settings import LightMix
from egotouch_sdk.synthetic.participants import PARTICIPANTS
from egotouch_sdk.synthetic.plan import PLACES

FPS = 30.0
ROUNDS = 36
_TYPES = (TouchType.TAP, TouchType.LIGHT_PRESS, TouchType.HARD_PRESS, TouchType.HOVER)
_OTHER_FINGERS = tuple(finger for finger in FINGERS if finger is not Finger.INDEX)
#: Share of rounds in which the wearer walks (our choice; the paper's wearers sat, stood and walked).
_WALKING = {False: 0.15, True: 0.45}


class StudyLight(StrEnum):
    """The light of one round."""

    ROOM = "room"
    WINDOW = "window"
    LAMP = "lamp"
    DIM = "dim"
    SUN = "sun"
    OVERCAST = "overcast"
    SHADE = "shade"


@dataclass(frozen=True, slots=True)
class LightFacts:
    """What a light is in the picture: kinds of key lamp, mix of the light layers, nominal lux and exposure time in seconds (ranges)."""

    outdoors: bool
    share: float
    keys: tuple[str, ...]
    mix: LightMix
    lux: tuple[float, float]
    exposure_s: tuple[float, float]


#: Shares within indoors and outdoors, lux and exposure times are our choice from common light levels; lux is nominal: a camera
#: meters on the skin, so it shows in noise and exposure time alone.
LIGHTS: dict[StudyLight, LightFacts] = {
    StudyLight.ROOM: LightFacts(False, 0.40, ("panel",), LightMix.SOFT, (250, 700), (1 / 120, 1 / 50)),
    StudyLight.WINDOW: LightFacts(False, 0.25, ("panel", "bulb"), LightMix.MIXED, (500, 2500), (1 / 240, 1 / 80)),
    StudyLight.LAMP: LightFacts(False, 0.20, ("bulb",), LightMix.KEY, (150, 500), (1 / 100, 1 / 45)),
    StudyLight.DIM: LightFacts(False, 0.15, ("bulb", "panel"), LightMix.DIM, (15, 60), (1 / 40, 1 / 31)),
    StudyLight.SUN: LightFacts(True, 0.40, ("sun",), LightMix.KEY, (30_000, 90_000), (1 / 2000, 1 / 500)),
    StudyLight.OVERCAST: LightFacts(True, 0.35, ("panel",), LightMix.SOFT, (4_000, 20_000), (1 / 1000, 1 / 250)),
    StudyLight.SHADE: LightFacts(True, 0.25, ("sun", "panel"), LightMix.MIXED, (1_500, 8_000), (1 / 500, 1 / 150)),
}


@dataclass(frozen=True, slots=True)
class StudyCamera:
    """A camera on a headset: pixels across its picture and its horizontal field of view in degrees."""

    width_px: int
    field_deg: float

    def px_per_mm(self, distance_m: float) -> float:
        """Pixels on a millimetre of skin at a distance in metres."""
        return self.width_px / (2e3 * distance_m * tan(radians(self.field_deg / 2)))


#: Participants wear these in turn: a 1080p camera and a pass-through camera of 1280 px, both of an ordinary field (our choice).
STUDY_CAMERAS = (StudyCamera(1920, 70.0), StudyCamera(1280, 80.0))


@dataclass(frozen=True, slots=True)
class RoundPlan:
    """One round before anything is rendered; `seed` re-creates all that is drawn later."""

    participant: int
    number: int
    place: str
    finger: Finger
    touch_type: TouchType
    light: StudyLight
    lux: float
    exposure_s: float
    walking: bool
    seed: int
    seconds: float
    fps: float = FPS

    @property
    def outdoors(self) -> bool:
        """True in daylight under the open sky."""
        return LIGHTS[self.light].outdoors

    @property
    def frames(self) -> int:
        """Number of frames, at least 1."""
        return max(1, round(self.seconds * self.fps))


def plan_round(study_seed: int, participant: int, number: int, seconds: float) -> RoundPlan:
    """Round `number` (0..35) of a participant (0..14): 32 of the index finger, then 4 of the other fingers.

    The 32: every place x touch type x indoors and outdoors. A quarter of the firm presses slide (`TouchType.DRAG`), at places that
    rotate over participants, as do place, type and daylight of the other fingers' rounds.
    """
    rng = np.random.default_rng([study_seed, participant, number, 11])
    if number < ROUNDS - len(_OTHER_FINGERS):
        finger, outdoors = Finger.INDEX, bool(number % 2)
        place, touch_type = PLACES[number // 8], _TYPES[number // 2 % 4]
        if touch_type is TouchType.HARD_PRESS and (number // 8 + 2 * outdoors + participant) % 4 == 0:
            touch_type = TouchType.DRAG
    else:
        index = number - (ROUNDS - len(_OTHER_FINGERS))
        finger, outdoors = _OTHER_FINGERS[index], bool((index + participant) % 2)
        touch_type = (*_TYPES[:3], TouchType.DRAG)[(index + participant // 2) % 4]
        place = "palm" if finger is Finger.THUMB else PLACES[(index + participant) % 4]
    lights = [light for light, facts in LIGHTS.items() if facts.outdoors == outdoors]
    light = lights[int(rng.choice(len(lights), p=[LIGHTS[one].share for one in lights]))]
    facts = LIGHTS[light]
    return RoundPlan(
        participant=participant,
        number=number,
        place=place,
        finger=finger,
        touch_type=touch_type,
        light=light,
        lux=_log_uniform(rng, facts.lux),
        exposure_s=_log_uniform(rng, facts.exposure_s),
        walking=bool(rng.random() < _WALKING[outdoors]),
        seed=int(rng.integers(1 << 31)),
        seconds=seconds,
    )


def plan_study(seed: int, participants: int, rounds: int, seconds: float) -> list[RoundPlan]:
    """All rounds of the first `participants` (1..15), `rounds` (1..36) each, in the order to render them.

    Participants take turns, each with an order of conditions of their own, so a study that stops early is still balanced.
    Raises `ValueError` outside these ranges.
    """
    if not 1 <= participants <= len(PARTICIPANTS) or not 1 <= rounds <= ROUNDS or not seconds > 0:
        raise ValueError(
            f"{participants} participants, {rounds} rounds, {seconds} s; need 1..{len(PARTICIPANTS)}, 1..{ROUNDS}, more than 0"
        )
    orders = [np.random.default_rng([seed, who, 12]).permutation(ROUNDS)[:rounds] for who in range(participants)]
    return [plan_round(seed, who, int(orders[who][turn]), seconds) for turn in range(rounds) for who in range(participants)]


def _log_uniform(rng: np.random.Generator, limits: tuple[float, float]) -> float:
    return float(np.exp(rng.uniform(np.log(limits[0]), np.log(limits[1]))))
