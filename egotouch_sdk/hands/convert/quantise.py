"""8-bit weights and activations for the middle of the landmark network: 36 % less time for 0.5 % of a palm (our measurement).

The first layers, whose few channels have very unequal ranges, and the last ones, which feed all outputs, stay in float.
Values are stored as ONNX's QuantizeLinear and DequantizeLinear pairs, which ONNX Runtime fuses into integer convolutions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import onnx
from onnx import helper, numpy_helper

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert.tflite_graph import Array

#: Convolutions that stay in float at either end (chosen by the landmark error each one causes alone).
FIRST_IN_FLOAT, LAST_IN_FLOAT = 9, 3
#: Ranges grow by this much over what calibration saw (our choice).
_MARGIN = 1.15
#: Processors without VNNI add two neighbouring products of an 8-bit activation and a weight in 16 bits:
#: 255 * (a + b) <= 32767 as long as two neighbouring weights of one sign sum to at most this.
_MAX_WEIGHT_PAIR = 128
_MAX_WEIGHT = 127

Ranges = Mapping[str, tuple[float, float]]


@dataclass(slots=True)
class _Plan:
    """Which nodes become integer ones, the tensors that carry integers, and those among them that ReLU6 bounds."""

    nodes: set[str] = field(default_factory=set)
    tensors: set[str] = field(default_factory=set)
    relu6: set[str] = field(default_factory=set)


def quantised_tensors(model: onnx.ModelProto) -> list[str]:
    """Names of the tensors whose range `quantise` needs to know."""
    return sorted(_plan(model).tensors)


def quantise(model: onnx.ModelProto, ranges: Ranges) -> onnx.ModelProto:
    """A copy of a network from `convert_graph` with integer convolutions; `ranges` gives (low, high) of each quantised tensor.

    Raises `ModelError` when a range is missing.
    """
    plan = _plan(model)
    missing = sorted(plan.tensors - ranges.keys())
    if missing:
        raise ModelError(f"no calibrated range for {', '.join(missing)}", hint="Run egotouch_sdk.hands.convert.calibrate again")
    writer = _Writer(model, plan, ranges)
    for node in model.graph.node:
        writer.add(node)
    return writer.finish()


def _plan(model: onnx.ModelProto) -> _Plan:
    nodes = list(model.graph.node)
    readers = {name: node for node in reversed(nodes) for name in node.input}
    convolutions = [node.name for node in nodes if node.op_type == "Conv"]
    chosen = set(convolutions[FIRST_IN_FLOAT : len(convolutions) - LAST_IN_FLOAT])
    plan = _Plan()
    made: set[str] = set()
    for node in nodes:
        if node.name in chosen:
            reader = readers[node.output[0]]
            made.add(reader.output[0] if reader.op_type == "Clip" else node.output[0])
            if reader.op_type == "Clip":
                plan.relu6.add(reader.output[0])
        elif node.op_type == "Add" and made.issuperset(node.input):
            made.add(node.output[0])
        else:
            continue
        plan.nodes.add(node.name)
        plan.tensors.update(node.input[:1] if node.op_type == "Conv" else node.input)
    plan.tensors |= made
    return plan


class _Writer:
    def __init__(self, model: onnx.ModelProto, plan: _Plan, ranges: Ranges) -> None:
        self._model, self._plan, self._ranges = model, plan, ranges
        self._constants = {c.name: c for c in model.graph.initializer}
        casts = [node for node in model.graph.node if node.op_type == "Cast" and node.input[0] in self._constants]
        self._casts = {node.output[0]: node.input[0] for node in casts}
        self._scales: dict[str, np.float32] = {}
        self._nodes: list[onnx.NodeProto] = []
        self._new_constants: list[onnx.TensorProto] = []

    def add(self, original: onnx.NodeProto) -> None:
        node = onnx.NodeProto()
        node.CopyFrom(original)
        if node.name in self._plan.nodes and node.op_type == "Conv":
            self._integer_weights(node)
        for index, name in enumerate(node.input):
            if name in self._scales:
                node.input[index] = f"{name}_dequantised"
        self._nodes.append(node)
        for name in node.output:
            if name in self._plan.tensors:
                self._integer_tensor(name)

    def finish(self) -> onnx.ModelProto:
        graph = self._model.graph
        used = {name for node in self._nodes for name in node.input}
        nodes = [node for node in self._nodes if node.op_type != "Cast" or node.output[0] in used]
        used = {name for node in nodes for name in node.input}
        constants = [c for c in self._constants.values() if c.name in used] + self._new_constants
        model = helper.make_model(
            helper.make_graph(nodes, f"{graph.name}_int8", graph.input, graph.output, constants),
            opset_imports=self._model.opset_import,
            producer_name=self._model.producer_name,
        )
        model.ir_version = self._model.ir_version
        onnx.checker.check_model(model, full_check=True)
        return model

    def _integer_tensor(self, name: str) -> None:
        low, high = min(self._ranges[name][0] * _MARGIN, 0.0), max(self._ranges[name][1] * _MARGIN, 0.0)
        if name in self._plan.relu6:  # then the range itself clips, and ONNX Runtime drops the Clip
            low, high = 0.0, min(high, 6.0)
        scale = np.float32(max(high - low, 1e-6) / 255)
        self._scales[name] = scale
        parameters = [
            self._constant(f"{name}_scale", np.array(scale)),
            self._constant(f"{name}_zero", np.array(round(-low / float(scale)), np.uint8)),
        ]
        self._nodes.append(helper.make_node("QuantizeLinear", [name, *parameters], [f"{name}_quantised"]))
        self._nodes.append(helper.make_node("DequantizeLinear", [f"{name}_quantised", *parameters], [f"{name}_dequantised"]))

    def _integer_weights(self, node: onnx.NodeProto) -> None:
        """Replace weights by int8 with a scale per output channel, and the bias by int32 in the product's scale."""
        weights, bias = self._value(node.input[1]), self._value(node.input[2])
        input_scale = float(self._scales[node.input[0]])
        scale = np.maximum(weight_scales(weights), np.abs(bias) / input_scale / 2**30 + 1e-12).astype(np.float32)
        integers = np.clip(np.round(weights / scale[:, None, None, None]), -_MAX_WEIGHT, _MAX_WEIGHT).astype(np.int8)
        bias_scale = (scale * input_scale).astype(np.float32)
        node.input[1] = self._channels(f"{node.name}_weights", integers, scale)
        node.input[2] = self._channels(f"{node.name}_bias", np.round(bias / bias_scale).astype(np.int32), bias_scale)

    def _channels(self, name: str, integers: Array, scale: Array) -> str:
        parts = [
            self._constant(f"{name}_integers", integers),
            self._constant(f"{name}_scale", scale),
            self._constant(f"{name}_zero", np.zeros(len(scale), integers.dtype)),
        ]
        self._nodes.append(helper.make_node("DequantizeLinear", parts, [name], axis=0))
        return name

    def _constant(self, name: str, value: Array) -> str:
        self._new_constants.append(numpy_helper.from_array(value, name))
        return name

    def _value(self, name: str) -> Array:
        array: Array = numpy_helper.to_array(self._constants[self._casts.get(name, name)])
        return array.astype(np.float32)


def weight_scales(weights: Array) -> Array:
    """Scale (out,) of 8-bit weights (out, in, height, width), small enough for every processor's arithmetic.

    A depthwise convolution adds in 32 bits everywhere, so only its largest weight counts.
    """
    rows = weights.reshape(len(weights), -1)
    scale = np.abs(rows).max(1) / _MAX_WEIGHT
    if weights.shape[1] == 1:
        return np.asarray(scale)
    same_sign = rows[:, :-1] * rows[:, 1:] > 0
    pairs = np.where(same_sign, np.abs(rows[:, :-1]) + np.abs(rows[:, 1:]), 0).max(1)
    return np.asarray(np.maximum(scale, pairs / (_MAX_WEIGHT_PAIR - 1)))  # - 1: rounding may add half a step to each
