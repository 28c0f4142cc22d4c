"""Touching hands without a camera: fingertips on an imaginary limb, by code or by script, give the observations of a camera.

`observe(SimulatedScene(...), index, timestamp_ns)` makes one observation; `ScriptSource("taps.yaml")` plays a whole script,
`LiveSource()` whatever pages play over the network.
"""

from __future__ import annotations

from egotouch_sdk.simulator.live import LiveSimulation
from egotouch_sdk.simulator.live_source import LiveSource, fingers_from_proto
from egotouch_sdk.simulator.observe import observe
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedScene, SimulatedView, place_at
from egotouch_sdk.simulator.script_source import ScriptSource, shipped_script, shipped_scripts

__all__ = [
    "LiveSimulation",
    "LiveSource",
    "ScriptSource",
    "SimulatedFinger",
    "SimulatedScene",
    "SimulatedView",
    "fingers_from_proto",
    "observe",
    "place_at",
    "shipped_script",
    "shipped_scripts",
]
