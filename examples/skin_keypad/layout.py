"""Where the keys are: pure data, in millimetres on the limb that is touched."""

from egotouch_sdk import Handedness, Surface
from egotouch_sdk.skin import SkinKeypad, SkinLayout

#: One keypad on each of the wearer's hands, so that either can be dialled on; named after the hand.
LAYOUTS = {surface: SkinLayout(tuple(SkinKeypad.phone(hand, surface, hand) for hand in Handedness)) for surface in Surface}
