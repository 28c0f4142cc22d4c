"""What the server tells every client about itself."""

from __future__ import annotations

from dataclasses import dataclass, field

from egotouch_sdk import __version__
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Counts additions to the schema; clients and servers of different minors work together.
PROTOCOL_MINOR = 0
#: What every server of this version can do.
FEATURES = ("resume", "late_edges", "clock")
#: Largest force that the model can tell, in newtons (EgoTouch, UIST'24, section 5: sensor range).
FORCE_MAX_N = 3.5


@dataclass(frozen=True, slots=True)
class ServerInfo:
    """Version, features and gesture settings for the Welcome."""

    version: str = __version__
    features: tuple[str, ...] = FEATURES
    settings: pb.GestureSettings = field(default_factory=pb.GestureSettings)

    @classmethod
    def of(cls, config: TouchConfig, *features: str) -> ServerInfo:
        """What a server with these settings says; `features` are those beyond what every server can do."""
        gestures = config.gestures
        settings = pb.GestureSettings(
            touch_slop_mm=gestures.touch_slop_mm,
            double_click_slop_mm=gestures.double_click_slop_mm,
            long_press_timeout_ms=gestures.long_press_timeout_ms,
            double_tap_timeout_ms=gestures.double_tap_timeout_ms,
            force_enter_n=gestures.force_enter_n,
            force_exit_n=gestures.force_exit_n,
            force_max_n=FORCE_MAX_N,
        )
        return cls(features=(*FEATURES, *features), settings=settings)
