"""Finger-up patches and (R, theta): the touch model's two inputs, made the same way everywhere."""

from egotouch_sdk.patches.cut import PATCH_PX_PER_MM, cut_patch, normalise
from egotouch_sdk.patches.polar import HOST_UNKNOWN, polar

__all__ = ["HOST_UNKNOWN", "PATCH_PX_PER_MM", "cut_patch", "normalise", "polar"]
