"""Frames from a camera or a network stream, newest first."""

from __future__ import annotations

from collections.abc import Iterator
from threading import Condition, Thread

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.clock import now_ns
from egotouch_sdk.errors import SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.sources.base import FrameSource
from egotouch_sdk.sources.opencv import open_capture
from egotouch_sdk.sources.presentation import sound_fps

#: A camera that is silent for longer counts as unplugged (our choice; ten frames at 2 fps, the slowest webcams in the dark).
STALL_TIMEOUT_S = 5.0
#: Failed grabs in a row after which a camera counts as unplugged; drivers drop single frames (our choice).
FAILED_GRABS_TOLERATED = 10


class CameraSource(FrameSource):
    """Reads a camera by index (0 is the first), device path or stream URL (http, rtsp).

    A thread takes every frame and stamps it with the monotonic clock as soon as it is grabbed; iteration gets the newest,
    so a slow consumer skips frames and never falls behind. `Frame.index` counts what the camera delivered.
    `width_px`, `height_px` and `fps` are wishes; the properties say what the camera answered.
    Raises `SourceError` when the camera cannot be opened, is unplugged, or is silent for `stall_timeout_s`.
    """

    def __init__(
        self,
        target: int | str,
        *,
        width_px: int | None = None,
        height_px: int | None = None,
        fps: float | None = None,
        stall_timeout_s: float = STALL_TIMEOUT_S,
    ) -> None:
        self.target = target
        self._stall_timeout_s = stall_timeout_s
        self._capture = self._open()
        wishes = {cv2.CAP_PROP_FRAME_WIDTH: width_px, cv2.CAP_PROP_FRAME_HEIGHT: height_px, cv2.CAP_PROP_FPS: fps}
        for prop, value in wishes.items():
            if value is not None:
                self._capture.set(prop, float(value))
        self._width_px = int(self._capture.get(cv2.CAP_PROP_FRAME_WIDTH)) or None
        self._height_px = int(self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT)) or None
        self._fps = sound_fps(self._capture.get(cv2.CAP_PROP_FPS))
        self._changed = Condition()
        self._newest: tuple[npt.NDArray[np.uint8], int, int] | None = None
        self._running = True
        self._unplugged = False
        self._thread = Thread(target=self._grab_frames, name=f"egotouch-camera-{target}", daemon=True)
        self._thread.start()

    @property
    def is_live(self) -> bool:
        """True: what is not taken is gone."""
        return True

    @property
    def width_px(self) -> int | None:
        """Image width in pixels as the camera answered."""
        return self._width_px

    @property
    def height_px(self) -> int | None:
        """Image height in pixels as the camera answered."""
        return self._height_px

    @property
    def fps(self) -> float | None:
        """Frames per second as the camera answered."""
        return self._fps

    @property
    def frame_count(self) -> int | None:
        """Unknown: a camera has no end."""
        return None

    def __iter__(self) -> Iterator[Frame]:
        while True:
            with self._changed:
                heard = self._changed.wait_for(lambda: self._newest or self._unplugged or not self._running, self._stall_timeout_s)
                taken, self._newest = self._newest, None
                if taken is None:
                    if not self._running:
                        return
                    silence = "was unplugged or its stream ended" if heard else f"sent no frame for {self._stall_timeout_s:g} s"
                    raise SourceError(f"camera {self.target} {silence}", hint="Plug it in again; `egotouch doctor` lists cameras")
            yield Frame(*taken)

    def close(self) -> None:
        """Stop the thread and release the camera."""
        with self._changed:
            self._running = False
            self._changed.notify_all()
        # A driver may block in `grab`; the thread is a daemon and releases the camera itself when the driver lets go.
        self._thread.join(timeout=1.0)

    def _open(self) -> cv2.VideoCapture:
        timeout_ms = round(self._stall_timeout_s * 1000)
        if isinstance(self.target, str) and "://" in self.target:
            params = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, timeout_ms, cv2.CAP_PROP_READ_TIMEOUT_MSEC, timeout_ms]
            capture = open_capture(self.target, cv2.CAP_FFMPEG, params)
        else:
            capture = open_capture(self.target)
        if capture is None:
            raise SourceError(f"cannot open camera {self.target}", hint="Check that it is plugged in; `egotouch doctor` lists cameras")
        return capture

    def _grab_frames(self) -> None:
        failed = 0
        index = 0
        last_ns = -1
        while self._running and failed <= FAILED_GRABS_TOLERATED:
            grabbed = self._capture.grab()
            stamp_ns = max(now_ns(), last_ns + 1)
            ok, image = self._capture.retrieve() if grabbed else (False, None)
            if not ok or image is None:
                failed += 1
                continue
            failed = 0
            last_ns = stamp_ns
            with self._changed:
                self._newest = (np.asarray(image, np.uint8), stamp_ns, index)
                self._changed.notify_all()
            index += 1
        self._capture.release()
        with self._changed:
            self._unplugged = self._running
            self._changed.notify_all()
