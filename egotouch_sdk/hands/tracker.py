"""The built-in hand tracker: palm detection, landmarks, tracking and identity on ONNX Runtime."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.association import PALM_JOINTS, hand_baseline_px, is_same_hand, is_same_palm
from egotouch_sdk.hands.identity import HandIds, assign_sides
from egotouch_sdk.hands.landmarker import Landmarker, LocatedHand
from egotouch_sdk.hands.palm_detector import PalmDetection, PalmDetector
from egotouch_sdk.hands.roi import Roi
from egotouch_sdk.hands.track import NEW_HAND_DISTRUST, Track, frame_evidence
from egotouch_sdk.observation import HandObservation

_NS_PER_MS = 1_000_000
#: A hand whose palm is smaller than this is a mistake of the network and could not be followed (our choice).
_MIN_HAND_PX = 2.0

#: Palm and landmark network of each choice of `model`.
NETWORKS = {
    "int8": ("palm_detection_full", "hand_landmark_full_int8"),
    "full": ("palm_detection_full", "hand_landmark_full"),
    "lite": ("palm_detection_lite", "hand_landmark_lite"),
}


@dataclass(frozen=True, slots=True, eq=False)
class _Candidate:
    """A region to look at, and the track whose hand is expected there (none for a new palm)."""

    roi: Roi
    track: Track | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Finding:
    """A hand that was seen in this frame."""

    found: LocatedHand
    evidence: float
    track: Track | None
    distrust: float


class HandTracker:
    """Finds the wearer's hands in BGR frames and keeps them apart over time.

    `max_hands`: 1 or 2. `mirrored`: True for a selfie image. `threads` run whole networks side by side, one per hand, or a known
    hand's beside the search for palms; for two hands on two busy cores that took 9.7 ms, sharing each inference 15.2 ms.
    `palm_every`: while one hand is tracked and another may appear, palms are searched in every n-th frame; without any hand in every
    frame. `min_palm_score`, `min_presence`: 0..1, MediaPipe's 0.5. `coast_ms`: how long a hand that another one covers is carried
    on, its score below 0.5 (about four frames; 0 switches it off). `model`: "int8" (median 0.5 % of a palm from "full" and
    36 % faster), "full" (MediaPipe's weights in float), or "lite", which loses a touched hand in 70 % of frames. All measured by us.

    Raises `ConfigError` for a setting out of range and `ModelError` when the networks are missing or altered.
    """

    def __init__(
        self,
        max_hands: int = 2,
        mirrored: bool = False,
        threads: int = 1,
        palm_every: int = 1,
        *,
        min_palm_score: float = 0.5,
        min_presence: float = 0.5,
        coast_ms: float = 150.0,
        model: str = "int8",
    ) -> None:
        if max_hands not in (1, 2):
            raise ConfigError(f"max_hands is {max_hands}, need 1 or 2", hint="One wearer has two hands")
        if model not in NETWORKS:
            raise ConfigError(f"there is no hand model {model!r}", hint=f"Use one of: {', '.join(NETWORKS)}")
        if threads < 1 or palm_every < 1 or coast_ms < 0 or not 0 < min_palm_score < 1 or not 0 <= min_presence < 1:
            raise ConfigError(
                f"hand tracker got {threads=}, {palm_every=}, {coast_ms=}, {min_palm_score=}, {min_presence=}",
                hint="Need threads >= 1, palm_every >= 1, coast_ms >= 0, scores between 0 and 1",
            )
        palm_model, landmark_model = NETWORKS[model]
        self._palms = PalmDetector(palm_model, min_palm_score)
        self._landmarks = Landmarker(landmark_model)
        self._pool = ThreadPoolExecutor(threads, "egotouch-hands") if threads > 1 else None
        self._max_hands = max_hands
        self._mirrored = mirrored
        self._palm_every = palm_every
        self._min_presence = min_presence
        self._coast_ns = round(coast_ms * _NS_PER_MS)
        self.reset()

    def reset(self) -> None:
        """Forget all hands; the next frame may carry any time."""
        self._tracks: list[Track] = []
        self._ids = HandIds()
        self._last_ns = -1
        self._size_px: tuple[int, int] | None = None
        self._frames_since_palms = 0

    def track(self, frame: Frame) -> tuple[HandObservation, ...]:
        """Hands in this frame, ordered by `hand_id`, one per side of the wearer.

        A frame of another size starts afresh. Raises `FrameError` when the capture time does not rise.
        """
        if frame.timestamp_ns <= self._last_ns:
            raise FrameError(
                f"frame {frame.index} has timestamp_ns={frame.timestamp_ns}, not after {self._last_ns}",
                hint="Feed frames of one source in order, or call reset() between sources",
            )
        size = (frame.width_px, frame.height_px)
        if size != self._size_px:
            self.reset()
        self._size_px, self._last_ns = size, frame.timestamp_ns

        known = [_Candidate(track.roi, track) for track in self._tracks]
        looking = [self._look(frame, candidate) for candidate in known]
        fresh = [_Candidate(palm.roi) for palm in self._new_palms(frame)]
        looking += [self._look(frame, candidate) for candidate in fresh]
        found = [answer() for answer in looking]
        findings = [self._finding(c, f) for c, f in zip(known + fresh, found, strict=True) if self._is_hand(f)]
        self._tracks = self._updated_tracks(_distinct(findings), frame.timestamp_ns)
        return self._observations(frame.timestamp_ns)

    def _look(self, frame: Frame, candidate: _Candidate) -> Callable[[], LocatedHand]:
        """Start the landmark network on a region, or with one thread put it off until the answer is asked for."""
        task = partial(self._landmarks.locate, frame.image, candidate.roi)
        return task if self._pool is None else self._pool.submit(task).result

    def _new_palms(self, frame: Frame) -> list[PalmDetection]:
        """Palms of hands that are not tracked yet, while hands are missing."""
        missing = self._max_hands - sum(not track.coasting for track in self._tracks)
        self._frames_since_palms += 1
        if missing == 0 or (self._tracks and self._frames_since_palms < self._palm_every):
            return []
        self._frames_since_palms = 0
        new: list[PalmDetection] = []
        known = [track.landmarks_px[PALM_JOINTS, :2] for track in self._tracks]
        for palm in self._palms.detect(frame.image):
            if len(new) < missing and not any(is_same_palm(palm, keypoints) for keypoints in known):
                new.append(palm)
                known.append(palm.keypoints_px)
        return new

    def _is_hand(self, found: LocatedHand) -> bool:
        return found.presence > self._min_presence and hand_baseline_px(found.landmarks_px) >= _MIN_HAND_PX

    def _finding(self, candidate: _Candidate, found: LocatedHand) -> _Finding:
        evidence = frame_evidence(found, self._mirrored)
        distrust = NEW_HAND_DISTRUST if candidate.track is None else candidate.track.distrust(found, evidence)
        return _Finding(found, evidence, candidate.track, distrust)

    def _updated_tracks(self, findings: Sequence[_Finding], now_ns: int) -> list[Track]:
        tracks = [f.track.followed(f.found, f.evidence, now_ns) for f in findings if f.track is not None]
        fresh = [f for f in findings if f.track is None]
        for finding in fresh[: self._max_hands - len(tracks)]:
            side = assign_sides([*(track.evidence for track in tracks), finding.evidence])[-1]
            hand_id = self._ids.new(side, [track.hand_id for track in tracks])
            tracks.append(Track(hand_id, finding.found, finding.evidence, now_ns))
        seen, ids = [track.landmarks_px for track in tracks], {track.hand_id for track in tracks}
        for lost in (track for track in self._tracks if track.hand_id not in ids):
            carried = lost.coasted(now_ns, self._coast_ns, seen)
            if carried is not None and len(tracks) < self._max_hands:
                tracks.append(carried)
        return sorted(tracks, key=lambda track: track.hand_id)

    def _observations(self, now_ns: int) -> tuple[HandObservation, ...]:
        sides = assign_sides([track.evidence for track in self._tracks])
        for track, side in zip(self._tracks, sides, strict=True):
            self._ids.confirm(track.hand_id, side)
        return tuple(
            HandObservation(track.hand_id, side, track.score(now_ns, self._coast_ns), track.landmarks_px, track.seen.world_mm)
            for track, side in zip(self._tracks, sides, strict=True)
        )


def _distinct(findings: Sequence[_Finding]) -> list[_Finding]:
    """Of findings on one hand only the most trusted stays."""
    kept: list[_Finding] = []
    for finding in sorted(findings, key=lambda f: f.distrust):
        if not any(is_same_hand(finding.found.landmarks_px, other.found.landmarks_px) for other in kept):
            kept.append(finding)
    return kept
