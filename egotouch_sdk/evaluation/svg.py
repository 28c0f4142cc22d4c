"""Small plots as SVG text; their colours are the page's (`report.css`)."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import ceil, floor, isnan

WIDTH = 360
_LEFT, _RIGHT, _TOP, _BOTTOM = 100, 24, 10, 26
_SQUARE_LEFT, _SQUARE_HEIGHT = 36, 240

Interval = tuple[float, float]


def interval_plot(rows: Sequence[tuple[str, float, Interval]], reference: float | None = None, unit: str = "%") -> str:
    """One dot with its interval per row (label, value, (low, high)); nan draws nothing. `reference` is a dashed line."""
    known = [value for _, value, bounds in rows for value in (value, *bounds) if not isnan(value)]
    known += [] if reference is None else [reference]
    low, high, step = _span(min(known, default=0.0), max(known, default=1.0))
    height = _TOP + 22 * len(rows) + _BOTTOM

    def x(value: float) -> float:
        return _LEFT + (value - low) / (high - low) * (WIDTH - _LEFT - _RIGHT)

    parts = [_upright(x(tick), height, f"{tick:g}{unit}") for tick in _ticks(low, high, step)]
    if reference is not None:
        parts.append(f'<path class="other" d="M{x(reference):.1f} {_TOP}V{height - _BOTTOM}"/>')
    for index, (label, value, bounds) in enumerate(rows):
        y = _TOP + 22 * index + 11
        parts.append(f'<text class="end" x="{_LEFT - 8}" y="{y + 4}">{escape(label)}</text>')
        if not any(map(isnan, bounds)):
            parts.append(f'<path class="bar" d="M{x(bounds[0]):.1f} {y}H{x(bounds[1]):.1f}"/>')
        if not isnan(value):
            parts.append(f'<circle class="ours" cx="{x(value):.1f}" cy="{y}" r="4"/>')
    return _svg(height, parts)


def column_plot(columns: Sequence[tuple[str, float]], top: float | None = None, unit: str = "%", digits: int = 1) -> str:
    """One column per (label, value) from 0 up to `top`, its value above it with so many `digits`; nan leaves a gap."""
    height, base = 200, 200 - _BOTTOM
    highest = top or max((value for _, value in columns if not isnan(value)), default=1.0) or 1.0
    step = (WIDTH - 2 * _RIGHT) / max(len(columns), 1)
    parts = [f'<path class="grid" d="M{_RIGHT} {base}H{WIDTH - _RIGHT}"/>']
    shows_value, every = step > 34, ceil(40 / step)
    for index, (label, value) in enumerate(columns):
        middle = _RIGHT + step * (index + 0.5)
        if index % every == 0:
            parts.append(f'<text class="middle soft" x="{middle:.1f}" y="{height - 9}">{escape(label)}</text>')
        if isnan(value):
            continue
        tall = value / highest * (base - 26)
        parts.append(
            f'<rect class="ours" x="{middle - step * 0.36:.1f}" y="{base - tall:.1f}" width="{step * 0.72:.1f}" height="{tall:.1f}"/>'
        )
        if shows_value:
            parts.append(f'<text class="middle" x="{middle:.1f}" y="{base - tall - 5:.1f}">{value:.{digits}f}{unit}</text>')
    return _svg(height, parts)


def curve_plot(points: Sequence[tuple[float, float]], across: str, up: str, *, diagonal: bool, is_falling: bool = False) -> str:
    """A curve through points in 0..1 x 0..1 with the names of both axes; `diagonal` adds the line of chance or of perfection."""
    left, right, top, base = _SQUARE_LEFT, WIDTH - _RIGHT, _TOP, _SQUARE_HEIGHT - 34

    def place(point: tuple[float, float]) -> str:
        return f"{left + point[0] * (right - left):.1f} {base - point[1] * (base - top):.1f}"

    parts = []
    for tick in (0, 0.25, 0.5, 0.75, 1):
        parts.append(f'<path class="grid" d="M{place((0, tick))}L{place((1, tick))}M{place((tick, 0))}L{place((tick, 1))}"/>')
        x, y = left + tick * (right - left), base - tick * (base - top)
        parts.append(f'<text class="soft middle" x="{x:.1f}" y="{base + 14}">{tick:g}</text>')
        parts.append(f'<text class="soft end" x="{left - 5}" y="{y + 4:.1f}">{tick:g}</text>')
    if diagonal:
        parts.append(f'<path class="other" d="M{place((0, float(is_falling)))}L{place((1, float(not is_falling)))}"/>')
    if points:
        parts.append(f'<path class="bar" d="M{"L".join(place(point) for point in points)}"/>')
    parts.append(f'<text class="middle" x="{(left + right) / 2}" y="{base + 29}">{escape(across)} →</text>')
    parts.append(f'<text class="end" x="{right - 6}" y="{base - 8}">↑ {escape(up)}</text>')
    return _svg(_SQUARE_HEIGHT, parts)


def _svg(height: float, parts: Sequence[str]) -> str:
    return f'<svg viewBox="0 0 {WIDTH} {height:g}" role="img" aria-hidden="true">{"".join(parts)}</svg>'


def _upright(x: float, height: float, label: str) -> str:
    line = f'<path class="grid" d="M{x:.1f} {_TOP}V{height - _BOTTOM}"/>'
    return line + f'<text class="middle soft" x="{x:.1f}" y="{height - 9}">{escape(label)}</text>'


def _span(low: float, high: float) -> tuple[float, float, float]:
    """Round bounds around two values, and the step between their ticks."""
    width = max(high - low, 1e-6)
    step = next((step for step in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 25.0) if width / step <= 4), 50.0)
    start, stop = floor(low / step) * step, ceil(high / step) * step
    return start, stop if stop > start else start + step, step


def _ticks(low: float, high: float, step: float) -> list[float]:
    return [round(low + step * index, 6) for index in range(round((high - low) / step) + 1)]
