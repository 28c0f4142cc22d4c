"""Files that are cut off, altered, or no recording at all."""

from __future__ import annotations

import random
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

from egotouch_sdk.errors import RecordingError, SourceWarning
from egotouch_sdk.recording import RecordingSource, topics
from egotouch_sdk.recording.container import ContainerWriter
from egotouch_sdk.replay import replay
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.recordings import record_taps

FRAMES = 60


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A recording of two seconds."""
    path = tmp_path_factory.mktemp("recording") / "taps.mcap"
    record_taps(path, FRAMES)
    return path.read_bytes()


def sound_part(path: Path) -> tuple[int, bool]:
    """Frames that can be read, each of them replayed to the same events, and whether a warning said that some are missing."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        frames = list(replay(RecordingSource(path)))
    assert all(frame.is_identical for frame in frames)
    assert [frame.index for frame in frames if frame.index is not None] == list(range(len(frames) - (frames[-1].index is None)))
    assert {warning.category for warning in caught} <= {SourceWarning}
    return sum(frame.index is not None for frame in frames), bool(caught)


@pytest.mark.parametrize("twentieth", range(20))
def test_what_is_whole_of_a_cut_recording_is_read(whole: bytes, tmp_path: Path, twentieth: int) -> None:
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole[: len(whole) * twentieth // 20])
    try:
        frames, warned = sound_part(path)
    except RecordingError:
        assert twentieth <= 6, "the first frames are whole in all longer parts"
        return
    assert warned
    assert FRAMES * (twentieth - 6) / 20 <= frames <= FRAMES


def test_a_recording_without_its_footer_keeps_every_frame(whole: bytes, tmp_path: Path) -> None:
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole[:-20])
    assert sound_part(path) == (FRAMES, True)


def test_altered_bytes_end_the_recording_and_never_alter_a_frame(whole: bytes, tmp_path: Path) -> None:
    path, chance = tmp_path / "altered.mcap", random.Random(1)
    warned_n = refused_n = 0
    for _ in range(200):
        data = bytearray(whole)
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        path.write_bytes(data)
        try:
            warned_n += sound_part(path)[1]
        except RecordingError:
            refused_n += 1
    assert warned_n > 50
    assert refused_n > 1


@pytest.mark.parametrize("content", [b"", b"just text\n", b"\x89MCAP0\r\n", b"\x89PNG\r\n\x1a\n" + bytes(100), bytes(5000)])
def test_another_file_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "other.mcap"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=r"other\.mcap") as caught:
        RecordingSource(path)
    assert caught.value.hint


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="No such file"):
        RecordingSource(tmp_path / "none.mcap")


def file_with(path: Path, topic: str, message: object) -> Path:
    """An MCAP file with one message."""
    container = ContainerWriter(path, overwrite=True, library="test")
    container.add(topic, message.DESCRIPTOR.full_name, topics.schema_of(message.DESCRIPTOR.name), 0, message.SerializeToString())  # type: ignore[attr-defined]
    container.close()
    return path


def test_a_recording_of_another_program_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="no egotouch recording"):
        RecordingSource(file_with(tmp_path / "robot.mcap", "/robot/pose", pb.Resume()))


@pytest.mark.parametrize("data", [b"", b"hi", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n\x01\x00"])
def test_a_file_of_a_few_bytes_is_refused_in_words(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "short.mcap"
    path.write_bytes(data)
    with pytest.raises(RecordingError, match=r"nothing of it is whole \((the file ends too early|a record is too short)\)"):
        RecordingSource(path)


def test_a_later_format_is_refused(tmp_path: Path) -> None:
    header = pb.RecordingHeader(format=2, sdk_version="9.1.0")
    with pytest.raises(RecordingError, match=r"format 2 \(egotouch 9.1.0\).*upgrade"):
        RecordingSource(file_with(tmp_path / "later.mcap", topics.HEADER, header))


def test_settings_of_a_later_version_are_refused(tmp_path: Path) -> None:
    header = pb.RecordingHeader(format=1, sdk_version="9.1.0", config_json='{"teleport": {}}', down_probability=0.6, up_probability=0.4)
    with pytest.raises(RecordingError, match=r"egotouch 9\.1\.0 with settings that .* refuses.*teleport"):
        RecordingSource(file_with(tmp_path / "later.mcap", topics.HEADER, header))


def test_a_header_without_thresholds_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="thresholds"):
        RecordingSource(file_with(tmp_path / "empty.mcap", topics.HEADER, pb.RecordingHeader(format=1, config_json="{}")))


def test_a_chunk_that_would_fill_the_memory_is_not_unpacked(whole: bytes, tmp_path: Path) -> None:
    """The claimed size of the first chunk, 8 + 8 bytes after its opcode and length, is made a million times larger."""
    path, data = tmp_path / "bomb.mcap", bytearray(whole)
    header_bytes = 8 + 9 + int.from_bytes(data[9:17], "little")
    assert data[header_bytes] == 0x06, "the first record after the file's header is a chunk"
    data[header_bytes + 9 + 16 + 5] = 0xFF
    path.write_bytes(data)
    with pytest.raises(RecordingError, match="claims to hold"):
        RecordingSource(path)


def test_without_its_extra_a_recording_names_the_way_to_install_it(whole: bytes, tmp_path: Path) -> None:
    path = tmp_path / "taps.mcap"
    path.write_bytes(whole)
    script = "import sys; sys.modules['mcap'] = None\nfrom egotouch_sdk.cli.main import main; sys.exit(main(['run', sys.argv[1]]))"
    run = subprocess.run([sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert run.stderr == "egotouch: error: recording needs an optional package. Install it with: pip install 'egotouch-sdk[recording]'\n"
