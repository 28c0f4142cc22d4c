"""The MCAP file under a recording: written so that a crash loses little, read as far as it is whole."""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import NamedTuple

from egotouch_sdk.errors import MissingExtraError, RecordingError

try:
    from mcap.exceptions import EndOfFile, InvalidMagic, McapError
    from mcap.reader import make_reader
    from mcap.records import Channel, Chunk, Footer, Message, Schema
    from mcap.stream_reader import StreamReader, breakup_chunk
    from mcap.writer import Writer
    from zstandard import ZstdError, frame_content_size
except ModuleNotFoundError as error:
    raise MissingExtraError("recording", "recording") from error

#: What mcap 1.6 raises on bytes that are no MCAP, are cut off or were altered.
_DAMAGE = (McapError, ZstdError, struct.error, ValueError, KeyError, EOFError, MemoryError, OverflowError)
#: Chunks end where we say so, never in the middle of a frame.
_CHUNK_BYTES = 1 << 30
#: Nobody records more in half a second; a chunk that claims to be larger is not unpacked (our choice).
_MAX_UNPACKED_BYTES = 1 << 28


class Record(NamedTuple):
    """One message of a recording: topic and content."""

    topic: str
    data: bytes


class DamagedError(Exception):
    """The file is not whole; what was read before is sound."""


class ContainerWriter:
    """Writes an MCAP file in whole chunks: what `flush` has written survives the end of the process and a full disk.

    Raises `RecordingError` when the file cannot be made or written; it then keeps all chunks before the failed one.
    """

    def __init__(self, path: Path, *, overwrite: bool, library: str) -> None:
        self._file = _Appender(path, overwrite=overwrite)
        self._writer = Writer(self._file, chunk_size=_CHUNK_BYTES)
        self._channels: dict[str, int] = {}
        self._writer.start(profile="egotouch", library=library)
        self.flush()

    @property
    def size_bytes(self) -> int:
        """Bytes in the file so far."""
        return self._file.written

    def add(self, topic: str, schema_name: str, schema: bytes, timestamp_ns: int, data: bytes) -> None:
        """Put one message into the current chunk; `schema` is a serialised FileDescriptorSet with the message type `schema_name`."""
        if topic not in self._channels:
            schema_id = self._writer.register_schema(schema_name, "protobuf", schema)
            self._channels[topic] = self._writer.register_channel(topic, "protobuf", schema_id)
        self._writer.add_message(self._channels[topic], timestamp_ns, data, timestamp_ns)

    def flush(self) -> None:
        """End the chunk and hand it to the operating system."""
        self._writer.flush()

    def close(self) -> None:
        """Write the index and close the file; may be called twice. After a failed write the file stays without an index."""
        if not self._file.closed:
            try:
                self._writer.finish()
                self._file.flush()
            finally:
                self._file.close()

    def abandon(self) -> None:
        """Close the file as it is."""
        self._file.close()


class _Appender(io.IOBase):
    """A file that grows by whole flushes: one that fails is taken back."""

    def __init__(self, path: Path, *, overwrite: bool) -> None:
        self._path = path
        try:
            self._file: io.FileIO | None = io.FileIO(path, "w" if overwrite else "x")
        except FileExistsError as error:
            raise RecordingError(f"{path} exists already", hint="Choose another name, or overwrite it with --force") from error
        except OSError as error:
            raise RecordingError(f"cannot write {path} ({error.strerror})", hint="Choose a folder that exists and is yours") from error
        self._pending = bytearray()
        self.written = 0

    @property
    def closed(self) -> bool:
        return self._file is None

    def tell(self) -> int:
        return self.written + len(self._pending)

    def write(self, data: bytes) -> int:
        self._pending += data
        return len(data)

    def flush(self) -> None:
        if self._file is None or not self._pending:
            return
        rest = memoryview(bytes(self._pending))
        self._pending.clear()
        size = len(rest)
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError as error:
            self._take_back()
            raise RecordingError(
                f"cannot go on writing {self._path} ({error.strerror})",
                hint=f"The first {self.written} bytes are a sound recording; make room and record the rest into another file",
            ) from error
        self.written += size

    def close(self) -> None:
        if self._file is not None:
            self._file.close()
            self._file = None

    def _take_back(self) -> None:
        assert self._file is not None
        try:
            os.ftruncate(self._file.fileno(), self.written)
        finally:
            self.close()


def read_records(path: Path) -> Generator[Record, None, None]:
    """The messages of the file in their order.

    Raises `DamagedError` where the file stops to be whole and `RecordingError` when it cannot be opened.
    """
    try:
        file = path.open("rb")
    except OSError as error:
        raise RecordingError(f"cannot read {path} ({error.strerror})", hint="Check the path") from error
    with file:
        channels: dict[int, str] = {}
        records = iter(StreamReader(file, emit_chunks=True, record_size_limit=path.stat().st_size).records)
        while not isinstance(record := _next_whole(records), Footer):
            for part in _parts(record):
                if isinstance(part, Channel):
                    channels[part.id] = part.topic
                elif isinstance(part, Message):
                    if part.channel_id not in channels:
                        raise DamagedError(f"message of an unknown channel {part.channel_id}")
                    yield Record(channels[part.channel_id], part.data)


def message_count(path: Path, topic: str) -> int | None:
    """Number of messages on `topic` by the file's index; None where it has none."""
    try:
        with path.open("rb") as file:
            summary = make_reader(file).get_summary()
            if summary is None or summary.statistics is None:
                return None
            counts: dict[int, int] = summary.statistics.channel_message_counts
            return sum(counts.get(number, 0) for number, channel in summary.channels.items() if channel.topic == topic)
    except (OSError, *_DAMAGE):
        return None


def _next_whole(records: Iterator[object]) -> object:
    try:
        return next(records)
    except (StopIteration, EndOfFile):
        raise DamagedError("the file ends too early") from None
    except InvalidMagic:
        raise DamagedError("it does not begin like an MCAP file") from None
    except struct.error:
        raise DamagedError("a record is too short") from None
    except _DAMAGE as error:
        raise DamagedError(str(error)) from error


def _parts(record: object) -> list[Channel | Message | Schema]:
    if not isinstance(record, Chunk):
        return [record] if isinstance(record, Channel | Message) else []
    try:
        packed_n = frame_content_size(record.data) if record.compression == "zstd" else 0
        if max(record.uncompressed_size, packed_n) > _MAX_UNPACKED_BYTES:
            raise DamagedError(f"a chunk claims to hold {max(record.uncompressed_size, packed_n)} bytes")
        return list(breakup_chunk(record, validate_crc=True))
    except _DAMAGE as error:
        raise DamagedError(str(error)) from error
