"""Touching hands without a camera: place fingertips on an imaginary limb and get the observations that a camera would give."""

from __future__ import annotations

from egotouch_sdk.simulator.observe import observe
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedScene, SimulatedView, place_at, surface_at

__all__ = ["SimulatedFinger", "SimulatedScene", "SimulatedView", "observe", "place_at", "surface_at"]
