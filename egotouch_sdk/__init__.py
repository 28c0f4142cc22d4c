"""Touch on bare skin from any RGB camera.

Every public name is imported on first use, so `import egotouch_sdk` loads neither the networks' runtime nor a camera.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.ego_touch import EgoTouch
    from egotouch_sdk.engine import EventEngine
    from egotouch_sdk.errors import (
        ConfigError,
        EgoTouchError,
        FrameError,
        GrammarError,
        LayoutError,
        MissingExtraError,
        ModelError,
        ProtocolError,
        QueueFullError,
        RecordingError,
        SourceError,
    )
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.frame_observation import FrameObservation
    from egotouch_sdk.joints import Finger, HandJoint, Handedness
    from egotouch_sdk.listeners import ErrorEvent, Subscription, TouchListener, TrackingState
    from egotouch_sdk.observation import FingertipPatch, GateReason, GateResult, HandObservation, HostPoint, TouchEstimate, TouchPair
    from egotouch_sdk.pipeline import FrameResult, TouchPipeline
    from egotouch_sdk.sources import FrameSource, ObservationSource, PushSource, open_source
    from egotouch_sdk.surface import Surface
    from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

__version__ = "0.1.0"

__all__ = [
    "CancelReason",
    "ConfigError",
    "EgoTouch",
    "EgoTouchError",
    "ErrorEvent",
    "EventEngine",
    "EventType",
    "Finger",
    "FingertipPatch",
    "Frame",
    "FrameError",
    "FrameObservation",
    "FrameResult",
    "FrameSource",
    "GateReason",
    "GateResult",
    "GrammarError",
    "HandJoint",
    "HandObservation",
    "Handedness",
    "HostPoint",
    "LayoutError",
    "MissingExtraError",
    "ModelError",
    "ObservationSource",
    "ProtocolError",
    "PushSource",
    "QueueFullError",
    "RecordingError",
    "SourceError",
    "Subscription",
    "Surface",
    "TouchConfig",
    "TouchEstimate",
    "TouchEvent",
    "TouchListener",
    "TouchPair",
    "TouchPipeline",
    "TrackingState",
    "__version__",
    "open_source",
]

_MODULE_OF = {
    name: f"egotouch_sdk.{module}"
    for module, names in {
        "config": ("TouchConfig",),
        "ego_touch": ("EgoTouch",),
        "engine": ("EventEngine",),
        "errors": (
            "ConfigError",
            "EgoTouchError",
            "FrameError",
            "GrammarError",
            "LayoutError",
            "MissingExtraError",
            "ModelError",
            "ProtocolError",
            "QueueFullError",
            "RecordingError",
            "SourceError",
        ),
        "frame": ("Frame",),
        "frame_observation": ("FrameObservation",),
        "joints": ("Finger", "HandJoint", "Handedness"),
        "listeners": ("ErrorEvent", "Subscription", "TouchListener", "TrackingState"),
        "observation": ("FingertipPatch", "GateReason", "GateResult", "HandObservation", "HostPoint", "TouchEstimate", "TouchPair"),
        "pipeline": ("FrameResult", "TouchPipeline"),
        "sources": ("FrameSource", "ObservationSource", "PushSource", "open_source"),
        "surface": ("Surface",),
        "touch_event": ("CancelReason", "EventType", "TouchEvent"),
    }.items()
    for name in names
}


def __getattr__(name: str) -> object:
    try:
        module = _MODULE_OF[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    value = getattr(import_module(module), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
