"""Recordings: what perception found in each frame, with the events of it, in an MCAP file that can be replayed.

Record a camera, and read it back:

    pipeline = TouchPipeline()
    header = Header(pipeline.config, pipeline.engine.thresholds, model_sha256(pipeline.config))
    with Recorder("session.mcap", header) as recorder, open_source(0) as camera:
        for frame in camera:
            recorder.write(pipeline.process(frame))
        recorder.end(frame.timestamp_ns, pipeline.finish(frame.timestamp_ns))

    for observation in RecordingSource("session.mcap"):
        ...
"""

from __future__ import annotations

from egotouch_sdk.recording.header import Header
from egotouch_sdk.recording.models import model_sha256
from egotouch_sdk.recording.recorder import RecordedEngine, Recorder
from egotouch_sdk.recording.source import RecordedEnd, RecordedFrame, RecordingSource

__all__ = ["Header", "RecordedEnd", "RecordedEngine", "RecordedFrame", "Recorder", "RecordingSource", "model_sha256"]
