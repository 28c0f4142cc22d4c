"""Touch events from filtered touch probabilities."""

from egotouch_sdk.state.inputs import Thresholds
from egotouch_sdk.state.machine import TouchStateMachine
from egotouch_sdk.state.sample import FingertipSample

__all__ = ["FingertipSample", "Thresholds", "TouchStateMachine"]
