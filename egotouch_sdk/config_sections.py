"""The settings of each stage: unit in the name, meaning and source of each default in its description."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator

from egotouch_sdk.config_section import Section, require_order

_THREADS = (
    "Threads that share one inference. Two take 0.6 of the time of one on an idle machine and the same time when another program "
    "uses the second core, since they never spin while idle (our measurement)."
)


class HandsConfig(Section):
    """Hand tracking."""

    model: Literal["int8", "full", "lite"] = Field(
        default="int8",
        description="Landmark network: int8 (36 % faster, 0.5 % of a palm from full, our measurement), full (MediaPipe's floats) or lite "
        "(built with EGOTOUCH_LITE=1; loses touched hands).",
    )

    max_hands: int = Field(default=2, ge=1, le=2, description="Hands to follow; a touch needs two (one touching, one touched).")
    mirrored: bool = Field(default=False, description="The picture is a mirror image, as from a selfie camera; egocentric cameras are not.")
    threads: int = Field(
        default=2,
        ge=1,
        le=64,
        description="Threads that run whole hand networks side by side, one per hand; they never spin while idle (our measurement: 9.7 ms "
        "for two hands, against 15.2 ms for threads that share each inference).",
    )
    palm_every: int = Field(
        default=1,
        ge=1,
        le=60,
        description="While a hand is tracked but another is missing, look for it every so many frames (1 as in MediaPipe).",
    )


class GateConfig(Section):
    """Which fingers are worth looking at. Lengths in palms: the host's own palm as seen in the image."""

    min_touching_score: float = Field(
        default=0.5, ge=0, le=1, description="The touching hand must be seen; a hidden hand that the tracker carries on scores below 0.5."
    )
    near_enter_palms: float = Field(
        default=3.0, gt=0, description="Hands closer than this count as near (EgoTouch, UIST'24, section 4: 3 palms)."
    )
    near_exit_palms: float = Field(
        default=3.3, gt=0, description="Hands that were near stay so up to this distance (our choice, 10 % slack)."
    )
    over_enter_palms: float = Field(
        default=0.3, ge=0, description="A fingertip may appear this far beside the host limb: 3 cm above it at 45 degrees (our choice)."
    )
    over_exit_palms: float = Field(
        default=0.5, ge=0, description="A fingertip that was over the limb may go this far before it leaves (our choice)."
    )
    forearm_palms: float = Field(
        default=3.0, ge=0, description="Length of forearm behind the host wrist that can be touched; a forearm is 2.5 to 3 palms long."
    )
    forearm_half_angle_rad: float = Field(
        default=0.8,
        gt=0,
        le=1.57,
        description="How far the forearm may bend from the line middle MCP to wrist: 45 degrees of wrist motion.",
    )
    reach_enter: float = Field(
        default=1.02,
        gt=0,
        description="A finger points away from the wrist when its tip is this many times as far from it as its PIP. Rendered pointing "
        "hands, as tracked: index 1.15 to 1.28, curled fingers 0.8 to 1.1, median 0.93 (our measurement).",
    )
    reach_exit: float = Field(default=0.97, gt=0, description="A finger that was active stays so down to this reach (our choice).")
    extended_enter: float = Field(
        default=0.7,
        gt=0,
        lt=1,
        description="A finger is not tucked in when MCP to tip is this share of its length; a fist has 0.3, a bent pressing finger 0.8.",
    )
    extended_exit: float = Field(default=0.55, gt=0, lt=1, description="A finger that was active stays so down to this share (our choice).")
    swap_margin_palms: float = Field(
        default=0.3, ge=0, description="The two hands change roles only when the other role fits better by this much (our choice)."
    )
    host_memory_ms: float = Field(
        default=500.0,
        ge=0,
        description="A host hand that the touching hand hides is taken to stay where it was for this long (our choice).",
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        require_order(self, "near_enter_palms", "near_exit_palms")
        require_order(self, "over_enter_palms", "over_exit_palms")
        require_order(self, "reach_exit", "reach_enter")
        require_order(self, "extended_exit", "extended_enter")
        return self


class PatchesConfig(Section):
    """Finger-up patches."""

    min_px_per_mm: float = Field(
        default=0.4, gt=0, description="Fingertips seen smaller than this are left out: 40 mm of skin would be under 16 px (our choice)."
    )


class TouchModelConfig(Section):
    """The touch and force network."""

    model_path: Path | None = Field(
        default=None, description="A touch model (.onnx with its .json manifest beside it); None is the shipped one."
    )
    threads: int = Field(default=2, ge=1, le=64, description=_THREADS)
    memory_ms: float = Field(
        default=150.0,
        ge=0,
        description="What a model with memory remembers of a finger lasts for so long while the finger is not seen: three missed frames "
        "at 30 per second (our choice). Models without memory ignore it.",
    )


class StateConfig(Section):
    """From touch probabilities to touch events. All times are capture time."""

    down_probability: float | None = Field(
        default=None, gt=0, lt=1, description="A touch begins at this probability; None takes the model's own."
    )
    up_probability: float | None = Field(
        default=None, gt=0, lt=1, description="A touch ends below this probability; None takes the model's own."
    )
    coast_frames: int = Field(
        default=2, ge=0, le=30, description="A fingertip may be unseen for so many frames; then its touch is cancelled."
    )
    stall_ms: float = Field(default=250.0, gt=0, description="A longer gap between two frames cancels every touch.")
    max_speed_mm_s: float = Field(
        default=3000.0,
        gt=0,
        description="No touch moves faster across the host limb, and no hovering finger across limb and image; "
        "fast reaches peak at about 3 m/s.",
    )
    jump_slack_mm: float = Field(default=20.0, ge=0, description="Landmark noise that is allowed on top of the speed limit (our choice).")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.down_probability is not None and self.up_probability is not None:
            require_order(self, "up_probability", "down_probability")
        return self


class GestureConfig(Section):
    """From touches to clicks, long clicks, drags, force events and flings. All times are capture time, all lengths on the skin."""

    touch_slop_mm: float = Field(
        default=5.0,
        gt=0,
        description="A touch that moves farther is a drag. Fingers that press in place seem to move by up to 4 mm (our measurement on the "
        "demo clip); Android's 8 dp are 1.27 mm.",
    )
    double_click_slop_mm: float = Field(
        default=16.0, gt=0, description="The second click of a double click lies this close to the first (Android: 100 dp = 15.9 mm)."
    )
    long_press_timeout_ms: float = Field(
        default=400.0, gt=0, description="A touch held this long is a long click (Android, DEFAULT_LONG_PRESS_TIMEOUT)."
    )
    double_tap_timeout_ms: float = Field(
        default=300.0, gt=0, description="The second touch of a double click begins within this time (Android, DOUBLE_TAP_TIMEOUT)."
    )
    double_tap_min_ms: float = Field(
        default=40.0, ge=0, description="A second touch sooner than this is a bounce, not a double click (Android, DOUBLE_TAP_MIN_TIME)."
    )
    tap_timeout_ms: float = Field(
        default=100.0,
        ge=0,
        description="A deep press must last this long to bring the long click forward; a finger that was lost while touching must hover "
        "so long to click again (Android, TAP_TIMEOUT).",
    )
    deep_press_n: float = Field(
        default=2.5, gt=0, description="A press at least this hard brings the long click forward, like Android's CLASSIFICATION_DEEP_PRESS."
    )
    force_enter_n: float = Field(default=1.5, gt=0, description="A press at least this hard is a force press (our choice).")
    force_exit_n: float = Field(default=1.2, gt=0, description="A force press ends below this force (our choice, 20 % below enter).")
    force_step_n: float = Field(default=0.1, ge=0, description="A force press reports a change of at least this much (our choice).")
    fling_min_mm_s: float = Field(
        default=50.0, gt=0, description="A drag that lifts at least this fast is a fling. Android's 7.9 mm/s are within landmark noise."
    )
    fling_max_mm_s: float = Field(
        default=1270.0, gt=0, description="Fling velocities are limited to this (Android: 8000 dp/s = 1270 mm/s)."
    )
    velocity_horizon_ms: float = Field(
        default=100.0, gt=0, description="Velocity is measured over this much time (Android's VelocityTracker: 100 ms)."
    )
    stopped_ms: float = Field(
        default=40.0,
        gt=0,
        description="A finger that has not moved for this long has stopped (Android's VelocityTracker: 40 ms); never less than two frames.",
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        require_order(self, "force_exit_n", "force_enter_n")
        require_order(self, "double_tap_min_ms", "double_tap_timeout_ms")
        require_order(self, "fling_min_mm_s", "fling_max_mm_s")
        return self


class HostConfig(Section):
    """The touch point on the host limb."""

    palm_mm: float | None = Field(
        default=None,
        gt=40,
        lt=140,
        description="The wearer's own length wrist to middle MCP in millimetres; None takes the usual one. It scales x_mm and y_mm.",
    )
    position_min_cutoff_hz: float = Field(
        default=3.0,
        gt=0,
        description="Cutoff at rest of the 1 euro filter (Casiez et al. 2012) on x_mm and y_mm. Our choice; with it jitter of resting "
        "touches in the demo clip is 0.49 mm instead of 0.95, the lag about 30 ms more (our measurement).",
    )
    position_beta_hz_s_mm: float = Field(
        default=0.1, ge=0, description="Hertz of cutoff gained per mm/s of speed; more lags less and jitters more (our choice)."
    )
    angle_min_cutoff_hz: float = Field(default=1.5, gt=0, description="The same cutoff for pitch_rad and yaw_rad (our choice).")
    angle_beta_hz_s_rad: float = Field(default=0.5, ge=0, description="Hertz of cutoff gained per rad/s (our choice).")
    gap_ms: float = Field(default=120.0, gt=0, description="A finger unseen for longer is not smoothed with its past (our choice).")
    jump_mm: float = Field(
        default=40.0, gt=0, description="A finger that moves this far in one frame is not smoothed with its past: jumps stay visible."
    )
