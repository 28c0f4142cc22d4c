"""Named sets of settings, as data: section, setting, value and where the value comes from."""

from __future__ import annotations

from typing import Literal, get_args

PresetName = Literal["android", "precise", "forgiving"]
PRESET_NAMES: tuple[PresetName, ...] = get_args(PresetName)

#: Section and setting -> (value, source). What a preset does not name keeps its default.
PRESETS: dict[PresetName, dict[str, dict[str, tuple[float, str]]]] = {
    "android": {
        "gestures": {
            "touch_slop_mm": (1.27, "ViewConfiguration.TOUCH_SLOP: 8 dp"),
            "double_click_slop_mm": (15.9, "ViewConfiguration.DOUBLE_TAP_SLOP: 100 dp"),
            "long_press_timeout_ms": (400.0, "ViewConfiguration.DEFAULT_LONG_PRESS_TIMEOUT"),
            "double_tap_timeout_ms": (300.0, "ViewConfiguration.DOUBLE_TAP_TIMEOUT"),
            "double_tap_min_ms": (40.0, "ViewConfiguration.DOUBLE_TAP_MIN_TIME"),
            "tap_timeout_ms": (100.0, "ViewConfiguration.TAP_TIMEOUT"),
            "fling_min_mm_s": (7.9, "ViewConfiguration.MINIMUM_FLING_VELOCITY: 50 dp/s"),
            "fling_max_mm_s": (1270.0, "ViewConfiguration.MAXIMUM_FLING_VELOCITY: 8000 dp/s"),
            "velocity_horizon_ms": (100.0, "VelocityTracker, HORIZON"),
            "stopped_ms": (40.0, "VelocityTracker, ASSUME_POINTER_STOPPED_TIME"),
        },
    },
    "precise": {
        "state": {
            "coast_frames": (1.0, "our choice: a fingertip that is gone is not guessed for long"),
            "jump_slack_mm": (10.0, "our choice: half the default, for a steady camera"),
        },
        "gestures": {
            "force_step_n": (0.05, "our choice: half the default"),
        },
    },
    "forgiving": {
        "state": {
            "coast_frames": (4.0, "our choice: twice the default, for a moving head and poor light"),
            "stall_ms": (400.0, "our choice: for cameras over a network"),
        },
        "gestures": {
            "touch_slop_mm": (8.0, "our choice: 1.6 times the default, for an unsteady hand"),
            "double_click_slop_mm": (25.0, "our choice: 1.5 times Android's"),
            "long_press_timeout_ms": (600.0, "our choice: 1.5 times Android's"),
            "double_tap_timeout_ms": (450.0, "our choice: 1.5 times Android's"),
            "fling_min_mm_s": (100.0, "our choice: twice the default"),
        },
    },
}


def preset_settings(name: PresetName) -> dict[str, dict[str, float]]:
    """The values of a preset by section and setting."""
    return {section: {key: value for key, (value, _) in values.items()} for section, values in PRESETS[name].items()}
