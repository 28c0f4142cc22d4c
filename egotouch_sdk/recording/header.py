"""What a recording says about itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from egotouch_sdk import __version__
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import ConfigError, RecordingError
from egotouch_sdk.state import Thresholds
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Rises when an older reader cannot read the file. Newer fields and topics do not count, readers pass over them.
FORMAT = 1

_UPDATE = "Update with: pip install --upgrade egotouch-sdk"


@dataclass(frozen=True, slots=True)
class Header:
    """All that a replay needs besides the observations.

    `config` and `thresholds` are those that the recorded events were made with, `sdk_version` the version that made them.
    `model_sha256` has the SHA-256 of each model file by name, `source` what was recorded, `fps` its announced rate (None: unknown).
    """

    config: TouchConfig
    thresholds: Thresholds
    model_sha256: Mapping[str, str] = field(default_factory=dict)
    source: str = ""
    fps: float | None = None
    created_unix_ms: int = 0
    sdk_version: str = __version__

    def to_proto(self) -> pb.RecordingHeader:
        """The header as the first message of a file."""
        return pb.RecordingHeader(
            format=FORMAT,
            sdk_version=self.sdk_version,
            config_json=self.config.model_dump_json(),
            down_probability=self.thresholds.down,
            up_probability=self.thresholds.up,
            model_sha256=dict(self.model_sha256),
            source=self.source,
            fps=self.fps or 0.0,
            created_unix_ms=self.created_unix_ms,
        )

    @classmethod
    def from_proto(cls, message: pb.RecordingHeader) -> Header:
        """The header in a message; raises `RecordingError` for a newer format and for settings that this version does not know."""
        if not 1 <= message.format <= FORMAT:
            raise RecordingError(
                f"the recording has format {message.format} (egotouch {message.sdk_version}), this version reads {FORMAT}", hint=_UPDATE
            )
        try:
            return cls(
                config=TouchConfig.model_validate_json(message.config_json),
                thresholds=Thresholds(message.down_probability, message.up_probability),
                model_sha256=dict(message.model_sha256),
                source=message.source,
                fps=message.fps or None,
                created_unix_ms=message.created_unix_ms,
                sdk_version=message.sdk_version,
            )
        except ConfigError as error:
            raise RecordingError(
                f"the recording was made by egotouch {message.sdk_version} with settings that {__version__} refuses: {error.message}",
                hint=f"Use egotouch {message.sdk_version}",
            ) from error
