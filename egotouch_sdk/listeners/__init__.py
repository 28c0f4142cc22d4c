"""From events to the app's own code: listeners, filters, and one thread that calls them."""

from egotouch_sdk.listeners.delivery import Delivery, Item
from egotouch_sdk.listeners.dispatcher import Dispatcher
from egotouch_sdk.listeners.error_event import ErrorEvent
from egotouch_sdk.listeners.listeners import Listeners, OnTouchListener
from egotouch_sdk.listeners.merging import merge
from egotouch_sdk.listeners.queues import CoalescingBuffer, MergingQueue
from egotouch_sdk.listeners.registry import Subscription
from egotouch_sdk.listeners.touch_listener import TouchListener
from egotouch_sdk.listeners.tracking import TrackingState

__all__ = [
    "CoalescingBuffer",
    "Delivery",
    "Dispatcher",
    "ErrorEvent",
    "Item",
    "Listeners",
    "MergingQueue",
    "OnTouchListener",
    "Subscription",
    "TouchListener",
    "TrackingState",
    "merge",
]
