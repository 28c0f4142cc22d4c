"""Every error that egotouch_sdk raises on purpose.

    EgoTouchError
    ├── ConfigError        a setting is unknown or out of range
    ├── SourceError        a camera, file or folder gives no usable frames
    ├── FrameError         an array or data object has the wrong shape, type or range
    ├── ModelError         a model file is missing, altered or of the wrong kind
    ├── GrammarError       events break the event grammar (of the SDK's own events only in debug mode)
    ├── LayoutError        a skin layout cannot be built: a bad region, a name used twice, an unknown key
    ├── RecordingError     a recording cannot be read, or was made by an incompatible version
    ├── ProtocolError      a message of the wire protocol is malformed or out of order
    ├── QueueFullError     an asynchronous consumer that asked for every event is too slow
    └── MissingExtraError  an optional dependency is not installed

Each carries `code` (stable, for programs), `message` (what is wrong) and `hint` (the next step).
"""

from __future__ import annotations


class EgoTouchError(Exception):
    """Base of all errors raised on purpose; `str()` gives the message and the next step in one line."""

    code = "egotouch"

    def __init__(self, message: str, *, hint: str = "") -> None:
        super().__init__(message, hint)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message}. {self.hint}" if self.hint else self.message


class ConfigError(EgoTouchError):
    """A setting is unknown, of the wrong type or out of range."""

    code = "config"


class SourceError(EgoTouchError):
    """A camera, video, folder or push source cannot deliver frames."""

    code = "source"


class SourceWarning(UserWarning):
    """A source ended early or repaired its own metadata, but what it delivered is sound."""


class FrameError(EgoTouchError, ValueError):
    """A value handed to the SDK has the wrong shape, type, unit or order."""

    code = "frame"


class ModelError(EgoTouchError):
    """A model file is missing, altered, or not what its manifest says."""

    code = "model"


class GrammarError(EgoTouchError):
    """Events break the event grammar: a defect of the SDK, or of a program that makes events itself."""

    code = "grammar"


class LayoutError(EgoTouchError, ValueError):
    """A layout of skin views cannot be built: a polygon that crosses itself, a name used twice, a key that does not exist."""

    code = "layout"


class RecordingError(EgoTouchError):
    """A recording is not one, is damaged at its start, or was made by an incompatible version."""

    code = "recording"


class ProtocolError(EgoTouchError):
    """A message of the wire protocol is malformed, too large or out of order."""

    code = "protocol"


class QueueFullError(EgoTouchError):
    """An asynchronous consumer with `overflow="raise"` did not take its events in time."""

    code = "queue_full"


class MissingExtraError(EgoTouchError, ImportError):
    """A feature needs an optional dependency that is not installed."""

    code = "missing_extra"

    def __init__(self, feature: str, extra: str) -> None:
        super().__init__(f"{feature} needs an optional package", hint=f"Install it with: pip install 'egotouch-sdk[{extra}]'")
        self.extra = extra
