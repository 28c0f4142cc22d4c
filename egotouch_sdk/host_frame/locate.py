"""From the landmarks of two tracked hands to a point in the host frame."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from math import pi

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame.features import SeenTip, see
from egotouch_sdk.host_frame.linear_map import LinearMap
from egotouch_sdk.joints import Finger, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair
from egotouch_sdk.surface import Surface, surface_at

DEFAULTS = HostConfig()

#: Wrist to middle MCP in millimetres between MediaPipe's landmarks (the generic WebXR hand with landmarks placed as MediaPipe places
#: them, our measurement).
PALM_MM = 83.0


@dataclass(frozen=True, slots=True)
class TrackerFit:
    """What the tracker's landmarks mean: on each surface `position` gives x and y in palm lengths, `angle` gives the pitch and what to add
    to the yaw as seen, both in radians."""

    position: dict[Surface, LinearMap]
    angle: LinearMap


@cache
def tracker_fit() -> TrackerFit:
    """The shipped fit (`tracker_fit.json`), made by `egotouch evaluate host-frame --fit`."""
    data = json.loads((files("egotouch_sdk") / "host_frame" / "tracker_fit.json").read_text(encoding="utf-8"))
    return TrackerFit({Surface(name): LinearMap.from_dict(data["position"][name]) for name in Surface}, LinearMap.from_dict(data["angle"]))


def locate(
    pair: TouchPair, finger: Finger, config: HostConfig = DEFAULTS, *, mirrored: bool = False, fit: TrackerFit | None = None
) -> HostPoint | None:
    """The host point of one finger of `pair`; None when the host's wrist and middle MCP lie on one spot in the picture.

    `mirrored` says that the picture is a mirror image; `fit` replaces the shipped one.
    """
    seen = see(pair, finger)
    if seen is None:
        return None
    fit = fit or tracker_fit()
    surface = surface_under(seen, shows_palm=shows_palm(pair.host, mirrored=mirrored))
    palm_mm = config.palm_mm or PALM_MM
    x_palms, y_palms = fit.position[surface](seen.position)
    pitch_rad, turn_rad = fit.angle(seen.angle)
    return HostPoint(surface, x_palms * palm_mm, y_palms * palm_mm, min(max(pitch_rad, 0.0), pi / 2), wrapped(seen.yaw_rad + turn_rad))


def surface_under(seen: SeenTip, *, shows_palm: bool) -> Surface:
    """The skin under a fingertip: the forearm begins at the wrist as seen."""
    return surface_at(seen.tip[1], palm_side=shows_palm)


def shows_palm(host: HandObservation, *, mirrored: bool = False) -> bool:
    """True when the palm faces the camera: seen from the palm, a left hand's thumb side lies to the left of wrist to knuckles."""
    wrist, knuckle = host.xy_px(HandJoint.WRIST).tolist(), host.xy_px(HandJoint.MIDDLE_FINGER_MCP).tolist()
    index, pinky = host.xy_px(HandJoint.INDEX_FINGER_MCP).tolist(), host.xy_px(HandJoint.PINKY_MCP).tolist()
    cross = (knuckle[0] - wrist[0]) * (index[1] - pinky[1]) - (knuckle[1] - wrist[1]) * (index[0] - pinky[0])
    return bool((cross > 0) == (host.handedness is Handedness.RIGHT)) != mirrored


def wrapped(angle_rad: float) -> float:
    """The same angle in (-pi, pi]."""
    turned = (angle_rad + pi) % (2 * pi) - pi
    return pi if turned == -pi else turned
