"""Smooth host points: each finger of each hand for itself, position and angles with a 1 euro filter each."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

from egotouch_sdk.config import HostConfig
from egotouch_sdk.filters.one_euro import OneEuroFilter
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HostPoint


@dataclass(slots=True)
class _Track:
    position: OneEuroFilter
    angles: OneEuroFilter
    last: HostPoint
    time_ns: int


class HostPointFilter:
    """Smooths the host points of every finger over capture time; never used to decide whether something touches.

    A finger starts afresh, its point unchanged, after a gap of `gap_ms`, on another surface, and when it jumps by `jump_mm` or more
    from one frame to the next, so that a teleport stays visible.
    """

    def __init__(self, config: HostConfig | None = None) -> None:
        self._config = config or HostConfig()
        self._tracks: dict[tuple[int, Finger], _Track] = {}

    def apply(self, hand_id: int, finger: Finger, point: HostPoint, timestamp_ns: int) -> HostPoint:
        """The smoothed point of one finger in one frame; its surface is the point's own."""
        key, config = (hand_id, finger), self._config
        track = self._tracks.get(key)
        if track is None or self._is_new(track, point, timestamp_ns):
            track = self._tracks[key] = _Track(
                OneEuroFilter(config.position_min_cutoff_hz, config.position_beta_hz_s_mm),
                OneEuroFilter(config.angle_min_cutoff_hz, config.angle_beta_hz_s_rad),
                point,
                timestamp_ns,
            )
        track.last, track.time_ns = point, timestamp_ns
        x_mm, y_mm = track.position.apply((point.x_mm, point.y_mm), timestamp_ns)
        pitch_rad, east, north = track.angles.apply((point.pitch_rad, sin(point.yaw_rad), cos(point.yaw_rad)), timestamp_ns)
        return HostPoint(point.surface, x_mm, y_mm, min(max(pitch_rad, 0.0), pi / 2), atan2(east, north))

    def reset(self) -> None:
        """Forget every finger; afterwards the filter behaves like a new one."""
        self._tracks.clear()

    def _is_new(self, track: _Track, point: HostPoint, timestamp_ns: int) -> bool:
        way_mm = hypot(point.x_mm - track.last.x_mm, point.y_mm - track.last.y_mm)
        late = timestamp_ns - track.time_ns > self._config.gap_ms * 1e6
        return late or point.surface is not track.last.surface or way_mm >= self._config.jump_mm
