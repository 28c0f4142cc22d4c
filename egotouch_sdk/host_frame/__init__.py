"""Where on the host limb a fingertip is, and at which angles the finger meets it."""

from egotouch_sdk.host_frame.locate import locate

__all__ = ["locate"]
