"""What goes into a recording comes out of it."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from google.protobuf import message_factory
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from mcap.reader import make_reader

from egotouch_sdk.config import GestureConfig, TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.errors import RecordingError
from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.recording import RecordedEnd, RecordedFrame, Recorder, RecordingSource
from egotouch_sdk.replay import replay
from egotouch_sdk.sources import ObservationSource, open_source
from egotouch_sdk.touch_event import CancelReason, EventType
from tests.support.recordings import FRAME_NS, record_taps, taps
from tests.support.wire import exact, rounded


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "taps.mcap"


def messages_by_other_program(path: Path) -> list[tuple[str, Any]]:
    """Topic and message of every record, decoded with nothing but the schemas inside the file."""
    decoded = []
    for schema, channel, message in make_reader(io.BytesIO(path.read_bytes())).iter_messages():
        assert schema is not None and schema.encoding == channel.message_encoding == "protobuf"
        pool = DescriptorPool()
        for proto in FileDescriptorSet.FromString(schema.data).file:
            pool.Add(proto)
        kind = message_factory.GetMessageClass(pool.FindMessageTypeByName(schema.name))
        decoded.append((channel.topic, kind.FromString(message.data)))
    return decoded


def test_observations_come_back_bit_for_bit(file: Path) -> None:
    record_taps(file)
    source = RecordingSource(file)
    assert [exact(found) for found in source] == [exact(made) for made in taps(60)]
    assert len(list(source)) == 60, "every iteration starts at the beginning"


def test_events_come_back_with_the_frame_that_caused_them(file: Path) -> None:
    record_taps(file)
    engine = EventEngine()
    expected = [tuple(rounded(event) for event in engine.process(observation).events) for observation in taps(60)]
    *frames, end = RecordingSource(file).entries()
    assert [frame.events for frame in frames] == expected
    assert isinstance(end, RecordedEnd)
    assert end.events == tuple(rounded(event) for event in engine.finish(60 * FRAME_NS))
    assert [event.type for event in end.events] == [EventType.HOVER_EXIT]


def test_the_header_says_how_it_was_made(file: Path) -> None:
    config = TouchConfig(gestures=GestureConfig(touch_slop_mm=7.5))
    recorder = record_taps(file, config=config)
    source = RecordingSource(file)
    assert source.header == recorder.header
    assert (source.config, source.thresholds) == (config, EventEngine(config).thresholds)
    assert (source.is_live, source.width_px, source.height_px, source.fps, source.frame_count) == (False, 1280, 720, 30.0, 60)


def test_the_end_keeps_its_reason(file: Path) -> None:
    with record_taps(file, 6, finished=False) as recorder:
        recorder.end(7 * FRAME_NS, (), CancelReason.SOURCE_STALLED)
    *_, end = RecordingSource(file).entries()
    assert end == RecordedEnd(7 * FRAME_NS, CancelReason.SOURCE_STALLED)


def test_a_replay_gives_the_same_events(file: Path) -> None:
    record_taps(file)
    frames = list(replay(RecordingSource(file)))
    assert sum(len(frame.replayed) for frame in frames) > 60
    assert all(frame.is_identical for frame in frames)


def test_a_replay_with_other_settings_gives_others(file: Path) -> None:
    record_taps(file)
    impatient = TouchConfig(gestures=GestureConfig(long_press_timeout_ms=30))
    replayed = [event.type for frame in replay(RecordingSource(file), impatient) for event in frame.replayed]
    recorded = [event.type for frame in replay(RecordingSource(file), impatient) for event in frame.recorded]
    assert EventType.LONG_CLICK in replayed
    assert EventType.LONG_CLICK not in recorded


def test_a_recording_is_opened_like_any_source(file: Path) -> None:
    record_taps(file)
    with open_source(file) as source:
        assert isinstance(source, RecordingSource)
        assert isinstance(source, ObservationSource)


def test_other_programs_read_it_by_the_schemas_inside(file: Path) -> None:
    record_taps(file, 10)
    messages = messages_by_other_program(file)
    assert messages[0][0] == "/egotouch/header"
    assert messages[0][1].source == "taps"
    assert [message.index for topic, message in messages if topic == "/egotouch/observation"] == list(range(10))
    assert sum(len(message.events) for topic, message in messages if topic == "/egotouch/events") > 10


def test_there_are_no_pictures_unless_they_are_given(file: Path) -> None:
    record_taps(file, 10)
    assert "/egotouch/image" not in [topic for topic, _ in messages_by_other_program(file)]


def test_pictures_are_recorded_in_foxgloves_form(file: Path) -> None:
    grey = np.full((720, 1280, 3), 100, np.uint8)
    header = record_taps(file.with_name("other.mcap"), 1).header
    with Recorder(file, header) as recorder:
        for observation in taps(3):
            recorder.write(FrameResult(observation), Frame(grey, observation.timestamp_ns, observation.index))
    images = [message for topic, message in messages_by_other_program(file) if topic == "/egotouch/image"]
    assert [image.timestamp.ToNanoseconds() for image in images] == [index * FRAME_NS for index in range(3)]
    assert {image.format for image in images} == {"jpeg"}
    decoded = cv2.imdecode(np.frombuffer(images[0].data, np.uint8), cv2.IMREAD_COLOR)
    assert decoded is not None and abs(decoded.astype(int) - 100).max() <= 1
    assert [entry.observation.index for entry in RecordingSource(file).entries() if isinstance(entry, RecordedFrame)] == [0, 1, 2]


def test_a_closed_recorder_takes_no_more(file: Path) -> None:
    recorder = record_taps(file, 5)
    with pytest.raises(RecordingError, match="is closed"):
        recorder.write(FrameResult(next(taps(1))))
    recorder.end(10 * FRAME_NS)
    recorder.close()
    assert RecordingSource(file).frame_count == 5
