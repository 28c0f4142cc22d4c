"""Dial a number on bare skin.

python examples/skin_keypad/app.py [SOURCE] [--surface inner_forearm]

Tap keys to dial, hold 0 for +, drag to the left to erase. SOURCE: camera index (default 0), video, recording or simulator script.
"""

import argparse
import sys

from drawing import draw
from layout import LAYOUTS

from egotouch_sdk import EgoTouch, EgoTouchError, Handedness, Surface, TouchEvent
from egotouch_sdk.skin import KeyPress, SkinViewGroup

#: Longer than any way within one key, so that what erases never dials.
ERASE_MM = 25.0
#: ANSI: to the top left, and clear all below.
CLEAR = "\x1b[H\x1b[J"


def main() -> None:
    parser = argparse.ArgumentParser(description="Dial a number on bare skin.")
    parser.add_argument("source", nargs="?", default="0", help="camera index, video, recording or simulator script (default 0)")
    parser.add_argument("--surface", choices=list(Surface), default=Surface.PALM, type=Surface, help="where the keys are (default palm)")
    parser.add_argument("--fast", action="store_true", help="play a file as fast as it can be read")
    options = parser.parse_args()

    skin = SkinViewGroup(LAYOUTS[options.surface])
    number, shown = "", ""

    def dial(press: KeyPress) -> None:
        nonlocal number
        number += press.key

    def plus(press: KeyPress) -> bool:
        nonlocal number
        if press.key != "0":
            return False
        number += "+"
        return True  # this touch dials nothing more

    def erase(event: TouchEvent) -> None:
        nonlocal number
        right_mm, up_mm = skin.keypad(event.host_hand).keypad.axes.to_view(event.dx_mm, event.dy_mm)
        if event.reason is None and right_mm < -max(ERASE_MM, abs(up_mm)):
            number = number[:-1]

    def show(event: TouchEvent) -> None:
        nonlocal shown
        text = draw(skin.keypad(event.host_hand).keypad, skin.snapshot(), number) if sys.stdout.isatty() else number
        if text != shown:
            print(f"{CLEAR}{text}" if sys.stdout.isatty() else text, flush=True)
            shown = text

    for hand in Handedness:
        pad = skin.keypad(hand)
        pad.onKey(dial)
        pad.onLongKey(plus)
        for key in pad.keys.values():
            key.onDragEnd(erase)

    with EgoTouch(options.source, realtime=False if options.fast else None) as et:
        et.addListener(skin)
        for listen in (et.onHoverEnter, et.onHoverMove, et.onHoverExit, et.onTouchDown, et.onTouchMove, et.onTouchUp, et.onTouchCancel):
            listen(show)
        et.run()
    print(f"Dialled {number or 'nothing'}")


if __name__ == "__main__":
    try:
        main()
    except EgoTouchError as error:
        sys.exit(f"app.py: {error}")
