"""Touch events from filtered touch probabilities, and the checker of their grammar."""

from egotouch_sdk.state.inputs import Thresholds
from egotouch_sdk.state.machine import TouchStateMachine
from egotouch_sdk.state.sample import FingertipSample
from egotouch_sdk.state.verify import GrammarVerifier, Violation

__all__ = ["FingertipSample", "GrammarVerifier", "Thresholds", "TouchStateMachine", "Violation"]
