"""What every source has in common: of camera frames, and of what perception found in them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from types import TracebackType
from typing import Protocol, Self, runtime_checkable

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import SourceWarning
from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.state import Thresholds

__all__ = ["FrameSource", "ObservationSource", "SourceWarning"]


class _Source(Protocol):
    """What is known of any source; it works in a `with` statement. A property is None where the source does not know it."""

    @property
    @abstractmethod
    def is_live(self) -> bool:
        """True when items come at the speed of the clock, and are lost unless they are taken in time."""

    @property
    @abstractmethod
    def width_px(self) -> int | None:
        """Image width in pixels as announced; single frames may differ."""

    @property
    @abstractmethod
    def height_px(self) -> int | None:
        """Image height in pixels as announced; single frames may differ."""

    @property
    @abstractmethod
    def fps(self) -> float | None:
        """Frames per second as announced."""

    @property
    @abstractmethod
    def frame_count(self) -> int | None:
        """Number of frames as announced."""

    @abstractmethod
    def close(self) -> None:
        """Release the device or file; may be called twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()


@runtime_checkable
class FrameSource(_Source, Protocol):
    """An iterable of frames that is closed after use.

    Timestamps rise strictly. Iterating raises `SourceError` when frames stop coming for any other reason than the end of a file,
    and `FrameError` for an image that no stage can work on.
    """

    @abstractmethod
    def __iter__(self) -> Iterator[Frame]:
        """Yield frames in capture order."""


@runtime_checkable
class ObservationSource(_Source, Protocol):
    """An iterable of what perception found in each frame, closed after use: a recording or a simulator.

    An `EventEngine` turns its observations into events, where a `FrameSource` needs a whole `TouchPipeline`. Otherwise the same
    holds: timestamps rise strictly, and iterating raises a typed error when observations stop for any reason but the end.
    """

    @property
    @abstractmethod
    def config(self) -> TouchConfig | None:
        """Settings to replay with; None where the source has none of its own."""

    @property
    @abstractmethod
    def thresholds(self) -> Thresholds | None:
        """Touch thresholds of the model behind the observations; None where no model was."""

    @abstractmethod
    def __iter__(self) -> Iterator[FrameObservation]:
        """Yield observations in capture order."""
