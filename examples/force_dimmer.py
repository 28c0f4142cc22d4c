"""Dim a lamp with one finger: the harder you press, the brighter it is; a firm press switches the colour.

python examples/force_dimmer.py [SOURCE]     SOURCE: camera index (default 0), URL, video, folder of images, recording or script
"""

import sys

from egotouch_sdk import EgoTouch, EventType, TouchEvent, TouchListener

FULL_N = 3.5  # the hardest press that the touch model knows
BAR = 40


class Lamp(TouchListener):
    colour = "white"

    def shine(self, event: TouchEvent) -> None:
        level = min(event.force_n / FULL_N, 1.0)
        print(f"{self.colour:<6} |{'#' * round(level * BAR):<{BAR}}| {level:4.0%}")

    onTouchDown = onTouchMove = onTouchUp = onTouchCancel = shine  # force_n is 0 on UP and CANCEL: the lamp goes out

    def onForce(self, event: TouchEvent) -> None:
        if event.type is EventType.FORCE_ENTER:
            self.colour = "orange" if self.colour == "white" else "white"


with EgoTouch(sys.argv[1] if len(sys.argv) > 1 else 0) as et:
    et.addListener(Lamp(), finger="index")
    et.run()
