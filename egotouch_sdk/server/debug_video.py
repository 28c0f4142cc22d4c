"""The camera's picture for the debug view, and only for it."""

from __future__ import annotations

from typing import Final

from egotouch_sdk.frame import Frame

#: Large enough to see what a hand does, small enough to cost little (our choice).
WIDTH_PX: Final = 640
JPEG_QUALITY: Final = 75


class DebugVideo:
    """The newest picture as a JPEG of at most 640 px width, coded only while somebody looks.

    `show` belongs to the thread that captures, `newest` to the server's; a picture that was never asked for is never coded.
    """

    def __init__(self) -> None:
        self._wanted = False
        self._jpeg: bytes | None = None

    def show(self, item: object) -> None:
        """Take what the source gave; anything but a `Frame` has no picture."""
        if not self._wanted or not isinstance(item, Frame):
            return
        import cv2  # loaded by whatever gives frames, and by nothing else that serves

        self._wanted = False
        scale = min(WIDTH_PX / item.width_px, 1.0)
        image = cv2.resize(item.image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1.0 else item.image
        self._jpeg = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()

    def newest(self) -> bytes | None:
        """The picture coded last, and a wish for a newer one; None before the first."""
        self._wanted = True
        return self._jpeg
