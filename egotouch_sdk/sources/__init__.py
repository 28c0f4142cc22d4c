"""Where frames come from: camera, video file, image folder, or the app itself."""

from __future__ import annotations

from egotouch_sdk.sources.base import FrameSource, ObservationSource, SourceWarning
from egotouch_sdk.sources.camera import CameraSource
from egotouch_sdk.sources.image_folder import ImageFolderSource, read_image
from egotouch_sdk.sources.opener import open_frames, open_source
from egotouch_sdk.sources.push import PushSource, WhenFull
from egotouch_sdk.sources.video_file import VideoFileSource

__all__ = [
    "CameraSource",
    "FrameSource",
    "ImageFolderSource",
    "ObservationSource",
    "PushSource",
    "SourceWarning",
    "VideoFileSource",
    "WhenFull",
    "open_frames",
    "open_source",
    "read_image",
]
