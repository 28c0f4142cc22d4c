"""The annotated view of a run: a page in the browser, a video file, or both."""

from __future__ import annotations

import os
import sys
import webbrowser
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.frame_result import FrameResult
    from egotouch_sdk.view.server import ViewServer
    from egotouch_sdk.view.video_writer import VideoWriter

#: The true force in newtons of a frame, by its number.
TrueForce = Callable[[int], float]

#: How long a run waits for the browser to show its first picture (our choice).
BROWSER_TIMEOUT_S = 4.0


def open_browser(url: str) -> bool:
    """Ask the desktop's browser to open `url`; False where there is no desktop."""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return False
    try:
        return webbrowser.open(url)
    except webbrowser.Error:
        return False


class Views:
    """Draws frames only for those who look: browsers on the page, and the video file."""

    def __init__(
        self, title: str, *, show: bool, save: Path | None, fps: float | None, port: int = 0, true_force_n: TrueForce | None = None
    ) -> None:
        self._true_force_n = true_force_n
        self.server: ViewServer | None = None
        self._writer: VideoWriter | None = None
        self._annotator = None
        if not (show or save):
            return
        from egotouch_sdk.view.annotate import HEIGHT_PX, WIDTH_PX, Annotator
        from egotouch_sdk.view.server import ViewServer
        from egotouch_sdk.view.video_writer import VideoWriter

        self._annotator = Annotator(title)
        if save:
            self._writer = VideoWriter(save, fps=fps, width_px=WIDTH_PX, height_px=HEIGHT_PX)
        if show:
            self.server = ViewServer(port)

    def show_in_browser(self) -> bool:
        """Print the page's address and open it; True once a browser shows it."""
        if self.server is None:
            return False
        sys.stderr.write(f"view: {self.server.url}\n")
        sys.stderr.flush()
        return open_browser(self.server.url) and self.server.wait_for_viewer(BROWSER_TIMEOUT_S)

    def __call__(self, frame: Frame, result: FrameResult) -> None:
        """Take in one frame, and draw it if anybody looks."""
        if self._annotator is None:
            return
        self._annotator.add(result, self._true_force_n(frame.index) if self._true_force_n else None)
        watched = self.server is not None and self.server.viewers > 0
        if self._writer or watched:
            picture = self._annotator.draw(frame, result)
            if self._writer:
                self._writer.write(picture, frame.timestamp_ns)
            if self.server and watched:
                self.server.show(picture)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Finish the video file and take the page down."""
        if self._writer:
            self._writer.close()
        if self.server:
            self.server.close()
