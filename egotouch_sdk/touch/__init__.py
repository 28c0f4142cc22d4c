"""Touch and force from finger-up patches."""

from egotouch_sdk.touch.manifest import TouchManifest
from egotouch_sdk.touch.model import SHIPPED_MODEL, TouchModel
from egotouch_sdk.touch.stream import TouchStream

__all__ = ["SHIPPED_MODEL", "TouchManifest", "TouchModel", "TouchStream"]
