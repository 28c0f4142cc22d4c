"""Recordings: what perception found in each frame, with the events of it, in an MCAP file that can be replayed."""

from __future__ import annotations

from egotouch_sdk.recording.header import Header
from egotouch_sdk.recording.models import model_sha256
from egotouch_sdk.recording.recorder import RecordedEngine, Recorder
from egotouch_sdk.recording.source import RecordedEnd, RecordedFrame, RecordingSource

__all__ = ["Header", "RecordedEnd", "RecordedEngine", "RecordedFrame", "Recorder", "RecordingSource", "model_sha256"]
