"""Buttons, sliders and keypads on skin: a layout in millimetres, and a listener that brings it to life."""

from egotouch_sdk.skin.group import SkinViewGroup
from egotouch_sdk.skin.handles import KeyPress, KeypadHandle, SliderChange, SliderHandle, ViewHandle
from egotouch_sdk.skin.keypad import SkinKeypad
from egotouch_sdk.skin.layout import SkinItem, SkinLayout
from egotouch_sdk.skin.loading import layout_from_dict, layout_to_dict, load_layout
from egotouch_sdk.skin.reading import Reading, ReadingAxes, reading_axes
from egotouch_sdk.skin.region import Region
from egotouch_sdk.skin.snapshot import FingerSnapshot, SkinSnapshot, ViewSnapshot
from egotouch_sdk.skin.views import SkinButton, SkinSlider, SkinView

__all__ = [
    "FingerSnapshot",
    "KeyPress",
    "KeypadHandle",
    "Reading",
    "ReadingAxes",
    "Region",
    "SkinButton",
    "SkinItem",
    "SkinKeypad",
    "SkinLayout",
    "SkinSlider",
    "SkinSnapshot",
    "SkinView",
    "SkinViewGroup",
    "SliderChange",
    "SliderHandle",
    "ViewHandle",
    "ViewSnapshot",
    "layout_from_dict",
    "layout_to_dict",
    "load_layout",
    "reading_axes",
]
