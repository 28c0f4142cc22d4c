"""Colours (BGR) and text of the annotated view."""

from __future__ import annotations

from typing import Final

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.view.timeline import TipState

Image = npt.NDArray[np.uint8]
Colour = tuple[int, int, int]

BACKGROUND: Final[Colour] = (24, 20, 18)
PANEL: Final[Colour] = (40, 34, 30)
GRID: Final[Colour] = (66, 58, 52)
TEXT: Final[Colour] = (236, 232, 228)
MUTED: Final[Colour] = (160, 150, 142)
TOUCHING_HAND: Final[Colour] = (220, 190, 60)
HOST_HAND: Final[Colour] = (80, 170, 245)
OTHER_HAND: Final[Colour] = (175, 170, 165)
DOWN: Final[Colour] = (90, 220, 120)
HOVER: Final[Colour] = (235, 170, 110)

STATE_COLOUR: Final[dict[TipState, Colour]] = {TipState.DOWN: DOWN, TipState.HOVER: HOVER, TipState.AWAY: MUTED}


def blank(width_px: int, height_px: int, colour: Colour = BACKGROUND) -> Image:
    """A plain picture."""
    return np.full((height_px, width_px, 3), colour, np.uint8)


def put_text(canvas: Image, text: str, at: tuple[int, int], size: float = 0.5, colour: Colour = TEXT, bold: bool = False) -> None:
    """Write `text` with its baseline's left end at `at`; characters outside ASCII are left out (the font has none)."""
    plain = text.encode("ascii", "ignore").decode()
    cv2.putText(canvas, plain, at, cv2.FONT_HERSHEY_SIMPLEX, size, colour, 2 if bold else 1, cv2.LINE_AA)


def put_label(canvas: Image, text: str, at: tuple[int, int], colour: Colour, fill: Colour) -> None:
    """Write `text` on a small filled tag with its baseline's left end at `at`."""
    (width, height), base = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, 0.45, 1)
    cv2.rectangle(canvas, (at[0] - 4, at[1] - height - 4), (at[0] + width + 4, at[1] + base), fill, -1)
    put_text(canvas, text, at, 0.45, colour)


def put_text_right(canvas: Image, text: str, at: tuple[int, int], size: float = 0.5, colour: Colour = TEXT, bold: bool = False) -> None:
    """Write `text` with its baseline's right end at `at`."""
    (width, _), _ = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, size, 2 if bold else 1)
    put_text(canvas, text, (at[0] - width, at[1]), size, colour, bold)
