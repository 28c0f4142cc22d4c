"""The proximity gate: which hand touches which, with which fingers, or why none does."""

from egotouch_sdk.gate.fingers import active_fingers
from egotouch_sdk.gate.memory import HostMemory
from egotouch_sdk.gate.proximity import find_pairs

__all__ = ["HostMemory", "active_fingers", "find_pairs"]
