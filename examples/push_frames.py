"""An app with a camera of its own: one thread pushes frames, another gets touch events.

python examples/push_frames.py VIDEO     the video stands for the app's camera
"""

import sys
from threading import Thread

from egotouch_sdk import EventType, PushSource, TouchPipeline, open_source


def camera_thread(camera: PushSource, video: str) -> None:
    with open_source(video) as frames:
        for frame in frames:
            camera.push(frame.image, frame.timestamp_ns)  # BGR, uint8, (height, width, 3)
    camera.close()


camera = PushSource()  # keeps the newest frame only: touches never lag behind
Thread(target=camera_thread, args=(camera, sys.argv[1])).start()

pipeline = TouchPipeline()
taken = 0
for frame in camera:
    taken += 1
    for event in pipeline.process(frame).events:
        if event.type is EventType.DOWN:
            print(f"{event.hand} {event.finger} touches")
print(f"{taken} of {frame.index + 1} frames were taken in time")
