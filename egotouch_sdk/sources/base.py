"""What every source of frames has in common."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from types import TracebackType
from typing import Protocol, Self, runtime_checkable

from egotouch_sdk.frame import Frame


class SourceWarning(UserWarning):
    """A source ended early or repaired its own metadata, but what it delivered is sound."""


@runtime_checkable
class FrameSource(Protocol):
    """An iterable of frames that is closed after use; works in a `with` statement.

    Timestamps rise strictly. Iterating raises `SourceError` when frames stop coming for any other reason than the end of a file,
    and `FrameError` for an image that no stage can work on. A property is None where the source does not know it.
    """

    @property
    @abstractmethod
    def is_live(self) -> bool:
        """True when frames are lost unless they are taken in time."""

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
    def __iter__(self) -> Iterator[Frame]:
        """Yield frames in capture order."""

    @abstractmethod
    def close(self) -> None:
        """Release the device or file; may be called twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
