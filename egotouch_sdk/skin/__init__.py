"""Buttons, sliders and keypads on skin: a layout in millimetres, and a listener that brings it to life.

    volume = SkinSlider(
        name="volume",
        region=Region.rectangle(Surface.INNER_FOREARM, x_mm=0, y_mm=-90, width_mm=30, height_mm=100),
        start_mm=(0, -130),
        end_mm=(0, -50),
    )
    skin = SkinViewGroup([volume, SkinKeypad.phone("pad", Surface.PALM, Handedness.LEFT)])

    @skin.slider("volume").onChange
    def turned(change): print(f"volume {change.value:.0%}")

    @skin.keypad("pad").onKey
    def pressed(press): print(f"key {press.key}")

    with EgoTouch(0) as et:
        et.addListener(skin)
        et.run()

Places are those of events: the host frame, origin wrist, +y to the middle MCP, +x to the thumb side. The wearer sees the thumb side
on the left or on the right depending on hand and side; `reading_axes` says where right and up are, and keypads turn their keys by it.
"""

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
