"""The event server: touch events over WebSocket, as protobuf or JSON.

`Session`, `Journal` and `EventHub` are logic without sockets and without a clock; `EventServer` is the asyncio shell around them.
"""

from egotouch_sdk.server.close_code import Close, CloseCode
from egotouch_sdk.server.event_server import EventServer, Settings
from egotouch_sdk.server.hub import EventHub
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.limits import Limits
from egotouch_sdk.server.session import Session

__all__ = ["Close", "CloseCode", "EventHub", "EventServer", "Journal", "Limits", "Session", "Settings"]
