"""Print what fingers do on skin.

python examples/print_touches.py [SOURCE]     SOURCE: camera index (default 0), URL, video, folder of images, recording or script
"""

import sys

from egotouch_sdk import EgoTouch, TouchEvent

with EgoTouch(sys.argv[1] if len(sys.argv) > 1 else 0) as et:

    @et.onTouchDown
    @et.onTouchUp
    @et.onTouchCancel
    def touch(event: TouchEvent) -> None:
        where = f"{event.surface} at ({event.x_mm:.0f}, {event.y_mm:.0f}) mm"
        print(f"{event.timestamp_ns / 1e9:8.3f} s  {event.type:<6}  {event.hand} {event.finger}  {where}  {event.force_n:.1f} N")

    @et.onClick(finger="index")
    def click(event: TouchEvent) -> None:
        print(f"{event.timestamp_ns / 1e9:8.3f} s  click   on the {event.surface}")

    et.run()  # until the video ends or Ctrl-C
