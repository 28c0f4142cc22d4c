"""Two consumers of one camera in asyncio: one counts clicks, the other follows the finger.

python examples/async_events.py [SOURCE]     SOURCE: camera index (default 0), URL, video, folder of images, recording or script
"""

import asyncio
import sys
from contextlib import suppress

from egotouch_sdk import EgoTouch


async def count_clicks(et: EgoTouch) -> None:
    clicks = 0
    async for event in et.events("click"):
        clicks += 1
        print(f"click {clicks} with the {event.hand} {event.finger}")


async def follow(et: EgoTouch) -> None:
    async for event in et.events("down", "move", queue=8):  # a slow consumer gets merged moves, never a lost down
        print(f"({event.x_mm:5.1f}, {event.y_mm:5.1f}) mm  pitch {event.pitch_deg:3.0f}  yaw {event.yaw_deg:4.0f} degrees")


async def main() -> None:
    async with EgoTouch(sys.argv[1] if len(sys.argv) > 1 else 0) as et:
        await asyncio.gather(count_clicks(et), follow(et))


with suppress(KeyboardInterrupt):  # Ctrl-C stops the camera on its way out
    asyncio.run(main())
