"""What `onError` is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from egotouch_sdk.listeners.tracking import TrackingState
    from egotouch_sdk.touch_event import TouchEvent


@dataclass(frozen=True, slots=True)
class ErrorEvent:
    """Something went wrong without stopping the delivery of events.

    `error` is the exception. `site` says where: `"source"`, or the listener's method and the place of its code, for example
    `onClick of dial (app.py:12)`. `event` is what the listener was handling, None when the source failed.
    """

    error: BaseException
    site: str
    event: TouchEvent | TrackingState | None = None
