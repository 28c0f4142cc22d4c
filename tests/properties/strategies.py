"""Random observation streams for the state machine."""

from __future__ import annotations

from hypothesis import strategies as st

from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.state import FingertipSample
from egotouch_sdk.surface import Surface

#: Values at, around and between the thresholds 0.6 and 0.4.
PROBABILITIES = st.sampled_from([0.0, 0.3, 0.4, 0.5, 0.6, 1.0])
#: From one nanosecond over usual frame times to stalls.
GAPS_NS = st.sampled_from([1, 11_000_000, 33_000_000, 100_000_000, 250_000_000, 250_000_001, 2_000_000_000])
#: Mostly where the finger was, sometimes far off.
PLACES_PX = st.sampled_from([(500.0, 500.0), (501.0, 500.0), (520.0, 510.0), (900.0, 100.0)])
SURFACES = st.sampled_from([Surface.PALM, Surface.PALM, Surface.INNER_FOREARM])


@st.composite
def samples(draw: st.DrawFn) -> list[FingertipSample]:
    """One frame's fingertips: any fingers of either side, at most one of a kind."""
    slots = draw(st.lists(st.tuples(st.sampled_from(list(Handedness)), st.sampled_from(FINGERS[:3])), max_size=4, unique=True))
    result = []
    for handedness, finger in slots:
        x, y = draw(PLACES_PX)
        point = HostPoint(draw(SURFACES), x / 2, y / 2, 0.7, 0.0)
        probability, force = draw(PROBABILITIES), draw(st.sampled_from([0.0, 1.0, 3.5]))
        hand_id = draw(st.sampled_from([1, 1, 1, 2]))
        result.append(FingertipSample(hand_id, handedness, finger, probability, force, (x, y), 2.0, (x / 1000, y / 1000), point))
    return result


#: A whole stream: frames with the time since the one before, and now and then the end of a source (None).
STREAMS = st.lists(st.one_of(st.tuples(GAPS_NS, samples()), st.none()), max_size=30)
