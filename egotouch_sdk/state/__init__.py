"""Touch events from filtered touch probabilities."""

from egotouch_sdk.state.inputs import Thresholds
from egotouch_sdk.state.machine import TouchStateMachine
from egotouch_sdk.state.sample import FingertipSample
from egotouch_sdk.state.table import PointerState

__all__ = ["FingertipSample", "PointerState", "Thresholds", "TouchStateMachine"]
