"""What people look at: an annotated picture of each frame, as a video file or a page in the browser."""

from __future__ import annotations

from egotouch_sdk.view.annotate import Annotator

__all__ = ["Annotator"]
