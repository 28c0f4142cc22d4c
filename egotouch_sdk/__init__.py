"""Touch on bare skin from any RGB camera.

Every public name is imported on first use, so `import egotouch_sdk` loads neither the networks' runtime nor a camera.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.errors import ConfigError, EgoTouchError, FrameError, MissingExtraError, ModelError, SourceError
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.joints import Finger, HandJoint, Handedness
    from egotouch_sdk.observation import FingertipPatch, GateReason, GateResult, HandObservation, TouchEstimate, TouchPair
    from egotouch_sdk.pipeline import FrameResult, TouchPipeline
    from egotouch_sdk.sources import FrameSource, PushSource, open_source
    from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

__version__ = "0.1.0"

__all__ = [
    "CancelReason",
    "ConfigError",
    "EgoTouchError",
    "EventType",
    "Finger",
    "FingertipPatch",
    "Frame",
    "FrameError",
    "FrameResult",
    "FrameSource",
    "GateReason",
    "GateResult",
    "HandJoint",
    "HandObservation",
    "Handedness",
    "MissingExtraError",
    "ModelError",
    "PushSource",
    "SourceError",
    "TouchConfig",
    "TouchEstimate",
    "TouchEvent",
    "TouchPair",
    "TouchPipeline",
    "__version__",
    "open_source",
]

_MODULE_OF = {
    name: f"egotouch_sdk.{module}"
    for module, names in {
        "config": ("TouchConfig",),
        "errors": ("ConfigError", "EgoTouchError", "FrameError", "MissingExtraError", "ModelError", "SourceError"),
        "frame": ("Frame",),
        "joints": ("Finger", "HandJoint", "Handedness"),
        "observation": ("FingertipPatch", "GateReason", "GateResult", "HandObservation", "TouchEstimate", "TouchPair"),
        "pipeline": ("FrameResult", "TouchPipeline"),
        "sources": ("FrameSource", "PushSource", "open_source"),
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
