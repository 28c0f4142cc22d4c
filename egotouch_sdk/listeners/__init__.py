"""From events to the app's own code: listeners, filters, and one thread that calls them."""

from egotouch_sdk.listeners.error_event import ErrorEvent
from egotouch_sdk.listeners.merging import merge
from egotouch_sdk.listeners.touch_listener import TouchListener
from egotouch_sdk.listeners.tracking import TrackingState

__all__ = ["ErrorEvent", "TouchListener", "TrackingState", "merge"]
