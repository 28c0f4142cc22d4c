"""One annotated picture per frame: hands on the video, fingertip cards, events, force over time."""

from __future__ import annotations

import cv2
import numpy as np

from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.view.cards import CARD_HEIGHT_PX, draw_card, draw_ticker
from egotouch_sdk.view.hands import Placement, draw_hand, draw_tip, role_colour
from egotouch_sdk.view.palette import MUTED, PANEL, TEXT, Image, blank, put_text, put_text_right
from egotouch_sdk.view.plot import ForcePlot
from egotouch_sdk.view.timeline import Timeline

WIDTH_PX = 1280
HEIGHT_PX = 720
VIDEO_WIDTH_PX = 960
VIDEO_HEIGHT_PX = 540
#: A fingertip unseen for longer is shown muted.
STALE_NS = 150_000_000
CARDS = 2


class Annotator:
    """Draws a 1280x720 BGR picture for each frame; remembers the last seconds for the force plot.

    Feed every result in order with `add`, and call `draw` for those frames that somebody looks at.
    """

    def __init__(self, title: str = "egotouch") -> None:
        self.timeline = Timeline()
        self._title = title
        self._background = blank(WIDTH_PX, HEIGHT_PX)
        self._plot = ForcePlot(0, VIDEO_HEIGHT_PX, VIDEO_WIDTH_PX, HEIGHT_PX - VIDEO_HEIGHT_PX)

    def add(self, result: FrameResult, true_force_n: float | None = None) -> None:
        """Take in one frame's result, and the true force where it is known."""
        self.timeline.add(result, true_force_n)

    def draw(self, frame: Frame, result: FrameResult) -> Image:
        """The picture of the frame that was added last."""
        canvas = self._background.copy()
        self._draw_video(canvas, frame, result)
        self._plot.draw(canvas, self.timeline)
        self._draw_panel(canvas, result)
        return canvas

    def _draw_video(self, canvas: Image, frame: Frame, result: FrameResult) -> None:
        scale = min(VIDEO_WIDTH_PX / frame.width_px, VIDEO_HEIGHT_PX / frame.height_px)
        width, height = round(frame.width_px * scale), round(frame.height_px * scale)
        left, top = (VIDEO_WIDTH_PX - width) // 2, (VIDEO_HEIGHT_PX - height) // 2
        video = canvas[top : top + height, left : left + width]
        video[:] = cv2.resize(frame.image, (width, height), interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        placement = Placement(scale, 0.0, 0.0)
        for hand in result.hands:
            draw_hand(video, hand, placement, role_colour(hand, result.gate))
        for patch in result.fingertips:
            track = self.timeline.tracks[(patch.handedness, patch.finger)]
            tip = placement.apply(np.asarray(patch.tip_px, np.float32))
            draw_tip(video, tip, track.state, track.samples[-1].force_n)

    def _draw_panel(self, canvas: Image, result: FrameResult) -> None:
        left, width = VIDEO_WIDTH_PX + 12, WIDTH_PX - VIDEO_WIDTH_PX - 24
        put_text(canvas, self._title, (left, 32), 0.75, TEXT, bold=True)
        put_text_right(canvas, f"{result.timestamp_ns / 1e9:.2f} s", (left + width, 32), 0.5, MUTED)
        touches = self.timeline.touches
        summary = f"gate {result.gate.reason.value.replace('_', ' ')}"
        put_text(canvas, summary, (left, 58), 0.45, MUTED)
        put_text_right(canvas, f"{touches} touch{'es' if touches != 1 else ''}", (left + width, 58), 0.45, MUTED)
        top = 74
        for tip, track in self.timeline.newest(CARDS):
            fresh = self.timeline.now_ns - track.samples[-1].timestamp_ns < STALE_NS
            draw_card(canvas, left, top, width, tip, track, fresh)
            top += CARD_HEIGHT_PX + 4
        top = 74 + CARDS * (CARD_HEIGHT_PX + 4) + 22
        cv2.line(canvas, (left, top - 22), (left + width, top - 22), PANEL, 2)
        draw_ticker(canvas, left, top, width, self.timeline.ticker)

