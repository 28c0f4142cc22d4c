"""Small studies made by code, and touch models that answer what their `polar` says.

In these studies `polar` does not hold a place but the answer that `signal_model` gives: the logit and the force in newtons.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import onnx
from onnx import TensorProto, helper

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch
from egotouch_sdk.study_data import Hair, RoundMeta, StudyRecipe, StudyRound, TouchType, write_recipe, write_round
from egotouch_sdk.surface import Surface

FPS = 30.0
#: A logit that is as good as certain.
SURE = 4.0

META = RoundMeta(
    participant=0,
    round=0,
    fitzpatrick=3,
    hair=Hair.SPARSE,
    place=Surface.PALM,
    finger=Finger.INDEX,
    touch_type=TouchType.LIGHT_PRESS,
    light="lamp",
    outdoors=False,
    walking=False,
    touching_hand=Handedness.RIGHT,
    seed=1,
    fps=FPS,
)


def study_round(
    touch: str,
    told: str | Sequence[float] | None = None,
    *,
    force_n: float = 1.5,
    told_force_n: float | None = None,
    hover_mm: float = 6.0,
    **meta: Any,
) -> StudyRound:
    """A round whose truth and model answers are written frame by frame.

    In `touch`, `#` touches, `.` hovers and `x` hovers behind a closed gate. `told` is what the model says: the same letters, or logits;
    None for the truth itself. Forces are those given wherever the truth, or the model, touches.
    """
    truth = np.array([letter == "#" for letter in touch])
    gate = np.array([letter != "x" for letter in touch])
    answers = touch if told is None else told
    assert len(answers) == len(touch)
    logits = np.array([SURE if a == "#" else -SURE if isinstance(a, str) else a for a in answers], np.float32)
    told_n = np.where(logits > 0, force_n if told_force_n is None else told_force_n, 0.0)
    return StudyRound(
        meta=replace(META, **meta),
        patches=np.full((len(truth), 100, 100, 3), 128, np.uint8),
        polar=np.stack([logits, told_n], 1).astype(np.float32),
        timestamp_ns=np.round(np.arange(len(truth)) * 1e9 / FPS).astype(np.int64),
        touch=truth,
        force_n=np.where(truth, force_n, 0.0).astype(np.float32),
        hover_mm=np.where(truth, 0.0, hover_mm).astype(np.float32),
        gate=gate,
    )


def write_study(folder: Path, rounds: Sequence[StudyRound]) -> Path:
    """Write a study of these rounds and return its folder."""
    participants = {each.meta.participant for each in rounds}
    counts = len(rounds) // len(participants)
    seconds = len(rounds[0].timestamp_ns) / FPS
    write_recipe(
        folder,
        StudyRecipe(
            seed=1, fps=FPS, participants=len(participants), rounds=counts, seconds_per_round=seconds, sizes={"frame_px": [960, 720]}
        ),
    )
    for each in rounds:
        write_round(folder, each)
    return folder


def signal_model(folder: Path, name: str = "signal", down: float = 0.6, up: float = 0.4, gain: float = 1.0) -> Path:
    """Write a real ONNX touch model with its manifest: logit = `gain` x first, force = second number of `polar`."""
    constants = {"gain": np.float32(gain), "zero": np.float32(0), "axes": np.array([1, 2, 3]), "at0": np.array(0), "at1": np.array(1)}
    nodes = [
        helper.make_node("ReduceMean", ["patch", "axes"], ["mean"], keepdims=0),
        helper.make_node("Mul", ["mean", "zero"], ["nothing"]),
        helper.make_node("Gather", ["polar", "at0"], ["first"], axis=1),
        helper.make_node("Mul", ["first", "gain"], ["scaled"]),
        helper.make_node("Add", ["scaled", "nothing"], ["touch_logit"]),
        helper.make_node("Gather", ["polar", "at1"], ["force_n"], axis=1),
    ]
    return _write_model(folder, name, down, up, nodes, constants)


def colour_model(folder: Path, name: str = "colour", force_n: float = 1.5) -> Path:
    """Write a real ONNX touch model that takes red skin for touched and blue for not; the force is always `force_n`."""
    constants = {
        "axes": np.array([2, 3]),
        "weights": np.array([[4.0], [0.0], [-4.0]], np.float32),
        "axis": np.array([1]),
        "zeros": np.array([[0.0], [0.0]], np.float32),
        "force": np.float32(force_n),
    }
    nodes = [
        helper.make_node("ReduceMean", ["patch", "axes"], ["colour"], keepdims=0),
        helper.make_node("MatMul", ["colour", "weights"], ["column"]),
        helper.make_node("Squeeze", ["column", "axis"], ["touch_logit"]),
        helper.make_node("MatMul", ["polar", "zeros"], ["nothing"]),
        helper.make_node("Squeeze", ["nothing", "axis"], ["flat"]),
        helper.make_node("Add", ["flat", "force"], ["force_n"]),
    ]
    return _write_model(folder, name, 0.6, 0.4, nodes, constants)


def memory_model(folder: Path, name: str = "memory") -> Path:
    """Write a real ONNX touch model with memory: red skin or a positive first number of `polar` look like a touch, blue or negative do not.

    The logit is the mean of that over all frames that it remembers, the force 0.1 N for each of them, this one included.
    """
    constants = {
        "axes": np.array([2, 3]),
        "weights": np.array([[4.0], [0.0], [-4.0]], np.float32),
        "first": np.array([[1.0], [0.0]], np.float32),
        "second": np.array([[0.0], [1.0]], np.float32),
        "as_first": np.array([[1.0, 0.0]], np.float32),
        "one_frame": np.array([0.0, 1.0], np.float32),
        "axis": np.array([1]),
        "step": np.float32(0.1),
    }
    nodes = [
        helper.make_node("ReduceMean", ["patch", "axes"], ["colour"], keepdims=0),
        helper.make_node("MatMul", ["colour", "weights"], ["redness"]),
        helper.make_node("MatMul", ["polar", "first"], ["told"]),
        helper.make_node("Add", ["redness", "told"], ["look"]),
        helper.make_node("MatMul", ["look", "as_first"], ["look_alone"]),
        helper.make_node("Add", ["look_alone", "one_frame"], ["look_and_count"]),
        helper.make_node("Add", ["memory", "look_and_count"], ["next_memory"]),
        helper.make_node("MatMul", ["next_memory", "first"], ["sum"]),
        helper.make_node("MatMul", ["next_memory", "second"], ["count"]),
        helper.make_node("Div", ["sum", "count"], ["mean"]),
        helper.make_node("Squeeze", ["mean", "axis"], ["touch_logit"]),
        helper.make_node("Mul", ["count", "step"], ["steps"]),
        helper.make_node("Squeeze", ["steps", "axis"], ["force_n"]),
    ]
    return _write_model(folder, name, 0.6, 0.4, nodes, constants, memory_size=2)


def told_patch(told: float, hand_id: int = 1, finger: Finger = Finger.INDEX) -> FingertipPatch:
    """A patch of plain grey skin of which `signal_model` and `memory_model` are told by `polar` how much it looks like a touch."""
    grey = np.full((100, 100, 3), 128, np.uint8)
    side = Handedness.RIGHT
    return FingertipPatch(hand_id=hand_id, handedness=side, finger=finger, tip_px=(0.0, 0.0), px_per_mm=1.0, r_palms=told, image=grey)


def _write_model(
    folder: Path,
    name: str,
    down: float,
    up: float,
    nodes: Sequence[onnx.NodeProto],
    constants: dict[str, Any],
    memory_size: int = 0,
) -> Path:
    inputs = [
        helper.make_tensor_value_info("patch", TensorProto.FLOAT, ["N", 3, 100, 100]),
        helper.make_tensor_value_info("polar", TensorProto.FLOAT, ["N", 2]),
    ]
    outputs = [helper.make_tensor_value_info(each, TensorProto.FLOAT, ["N"]) for each in ("touch_logit", "force_n")]
    if memory_size:
        inputs.append(helper.make_tensor_value_info("memory", TensorProto.FLOAT, ["N", memory_size]))
        outputs.append(helper.make_tensor_value_info("next_memory", TensorProto.FLOAT, ["N", memory_size]))
    values = [onnx.numpy_helper.from_array(np.asarray(value), each) for each, value in constants.items()]
    graph = helper.make_graph(nodes, name, inputs, outputs, values)
    network = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    file = folder / f"{name}.onnx"
    onnx.save(network, file)
    manifest = {
        "name": name,
        "version": "1",
        "file": file.name,
        "sha256": hashlib.sha256(file.read_bytes()).hexdigest(),
        "threshold": {"down": down, "up": up},
    }
    file.with_suffix(".json").write_text(json.dumps(manifest))
    return file
