"""An app with a camera of its own: one thread pushes frames, listeners get touch events.

python examples/push_frames.py VIDEO     the video stands for the app's camera
"""

import sys
import time
from threading import Thread

from egotouch_sdk import EgoTouch, PushSource, TouchEvent, open_source


def camera_thread(camera: PushSource, video: str) -> None:
    with camera, open_source(video) as frames:  # whatever happens, the camera is closed, which ends the run
        for frame in frames:
            time.sleep(1 / (frames.fps or 30))
            camera.push(frame.image, frame.timestamp_ns)  # BGR, uint8, (height, width, 3), stamped at capture
            pushed.append(frame.index)


if len(sys.argv) != 2:
    sys.exit(__doc__)
pushed: list[int] = []
camera = PushSource()  # keeps the newest frame only: touches never lag behind
with EgoTouch(camera) as et:

    @et.onTouchDown
    def touch(event: TouchEvent) -> None:
        print(f"{event.hand} {event.finger} touches the {event.surface}")

    et.start()
    Thread(target=camera_thread, args=(camera, sys.argv[1])).start()
    et.run()
print(f"{et.stats.frames} of {len(pushed)} frames were taken in time")
