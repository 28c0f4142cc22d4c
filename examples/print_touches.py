"""Print every touch that a camera or a video shows.

python examples/print_touches.py [SOURCE]     SOURCE: camera index (default 0), video file, URL or folder of images
"""

import sys

from egotouch_sdk import EventType, TouchPipeline, open_source

pipeline = TouchPipeline()
with open_source(sys.argv[1] if len(sys.argv) > 1 else 0) as source:
    for frame in source:
        for event in pipeline.process(frame).events:
            if event.type in (EventType.DOWN, EventType.UP, EventType.CANCEL):
                print(f"{event.timestamp_ns / 1e9:8.3f} s  {event.type:<6} {event.hand} {event.finger}  {event.force_n:.1f} N")
