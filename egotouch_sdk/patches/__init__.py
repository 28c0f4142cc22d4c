"""Finger-up patches and (R, theta): the touch model's two inputs, made the same way everywhere."""

from egotouch_sdk.model_input import STD_FLOOR, normalise
from egotouch_sdk.patches.cut import PATCH_CENTRE_PX, PATCH_PX_PER_MM, cut_patch
from egotouch_sdk.patches.extract import PatchRefusal, extract, refusal
from egotouch_sdk.patches.polar import HOST_UNKNOWN, polar
from egotouch_sdk.patches.scale import DIP_TO_TIP_MM, tip_px_per_mm

__all__ = [
    "DIP_TO_TIP_MM",
    "HOST_UNKNOWN",
    "PATCH_CENTRE_PX",
    "PATCH_PX_PER_MM",
    "STD_FLOOR",
    "PatchRefusal",
    "cut_patch",
    "extract",
    "normalise",
    "polar",
    "refusal",
    "tip_px_per_mm",
]
