"""Clicks, long clicks, drags, force presses and flings from touches."""

from egotouch_sdk.gestures.contact import GestureStates
from egotouch_sdk.gestures.recognizer import GestureRecognizer
from egotouch_sdk.gestures.table import DragState, ForceState, PressState

__all__ = ["DragState", "ForceState", "GestureRecognizer", "GestureStates", "PressState"]
