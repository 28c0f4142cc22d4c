"""Small studies made by code, and a touch model that answers what their `polar` says.

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


def _write_model(folder: Path, name: str, down: float, up: float, nodes: Sequence[onnx.NodeProto], constants: dict[str, Any]) -> Path:
    patch = helper.make_tensor_value_info("patch", TensorProto.FLOAT, ["N", 3, 100, 100])
    polar = helper.make_tensor_value_info("polar", TensorProto.FLOAT, ["N", 2])
    outputs = [helper.make_tensor_value_info(each, TensorProto.FLOAT, ["N"]) for each in ("touch_logit", "force_n")]
    values = [onnx.numpy_helper.from_array(np.asarray(value), each) for each, value in constants.items()]
    graph = helper.make_graph(nodes, name, [patch, polar], outputs, values)
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
