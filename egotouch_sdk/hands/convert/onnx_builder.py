"""Collects ONNX nodes and constants while a TFLite graph is walked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper
from tflite import ActivationFunctionType, Padding

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert.tflite_graph import Array, TfliteGraph

#: ONNX operator set and file format that ONNX Runtime has read since 1.15.
OPSET, IR_VERSION = 17, 8

#: Constants with fewer values than this stay float32: halving them saves nothing.
_MIN_HALF_SIZE = 64


class OnnxBuilder:
    """An ONNX graph in the making; 4-D tensors are NCHW inside although TFLite stores NHWC.

    `spatial` holds the TFLite tensors whose ONNX twin is an NCHW image; all others keep TFLite's axis order.
    """

    def __init__(self, graph: TfliteGraph) -> None:
        self.graph = graph
        self.spatial: set[int] = set()
        self._nodes: list[onnx.NodeProto] = []
        self._constants: dict[str, onnx.TensorProto] = {}

    @staticmethod
    def name(tensor: int) -> str:
        """ONNX name of a TFLite tensor."""
        return f"t{tensor}"

    def node(self, op_type: str, inputs: Sequence[str], output: str, **attributes: Any) -> str:
        """Append one node and return its output's name."""
        self._nodes.append(helper.make_node(op_type, list(inputs), [output], name=f"{op_type}_{len(self._nodes)}", **attributes))
        return output

    def constant(self, name: str, value: Array) -> str:
        """Store a constant once; float16 weights of the source stay float16 on disk behind a Cast (same values, half the file)."""
        if name in self._constants or f"{name}_half" in self._constants:
            return name
        value = np.ascontiguousarray(value)
        half = value.astype(np.float16) if value.dtype == np.float32 and value.size >= _MIN_HALF_SIZE else None
        if half is not None and np.array_equal(half.astype(np.float32), value):
            self._constants[f"{name}_half"] = numpy_helper.from_array(half, f"{name}_half")
            return self.node("Cast", [f"{name}_half"], name, to=TensorProto.FLOAT)
        self._constants[name] = numpy_helper.from_array(value, name)
        return name

    def activated(self, op_type: str, inputs: Sequence[str], tensor: int, activation: int, **attributes: Any) -> None:
        """Append a node followed by TFLite's fused activation (none, ReLU or ReLU6)."""
        kinds = ActivationFunctionType
        if activation == kinds.NONE:
            self.node(op_type, inputs, self.name(tensor), **attributes)
            return
        raw = self.node(op_type, inputs, f"{self.name(tensor)}_raw", **attributes)
        if activation == kinds.RELU:
            self.node("Relu", [raw], self.name(tensor))
        elif activation == kinds.RELU6:
            limits = [self.constant("zero", np.array(0, np.float32)), self.constant("six", np.array(6, np.float32))]
            self.node("Clip", [raw, *limits], self.name(tensor))
        else:
            raise ModelError(f"TFLite activation {activation} is not supported")

    def channels_last(self, tensor: int) -> str:
        """Name of the tensor in TFLite's own axis order."""
        if tensor not in self.spatial:
            return self.name(tensor)
        return self.node("Transpose", [self.name(tensor)], f"{self.name(tensor)}_nhwc", perm=[0, 2, 3, 1])

    def window_pads(
        self, tensor: int, kernel: tuple[int, int], stride: tuple[int, int], dilation: tuple[int, int], padding: int
    ) -> list[int]:
        """ONNX pads [top, left, bottom, right] of a TFLite window; with SAME the odd pixel goes to the bottom and right."""
        if padding == Padding.VALID:
            return [0, 0, 0, 0]
        before, after = [], []
        for size, k, s, d in zip(self.graph.shapes[tensor][1:3], kernel, stride, dilation, strict=True):
            total = max((-(-size // s) - 1) * s + (k - 1) * d + 1 - size, 0)
            before.append(total // 2)
            after.append(total - total // 2)
        return before + after

    def model(self, inputs: Sequence[onnx.ValueInfoProto], outputs: Sequence[onnx.ValueInfoProto], name: str) -> onnx.ModelProto:
        """The checked ONNX model."""
        graph = helper.make_graph(self._nodes, name, list(inputs), list(outputs), list(self._constants.values()))
        model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", OPSET)], producer_name="egotouch_sdk")
        model.ir_version = IR_VERSION
        onnx.checker.check_model(model, full_check=True)
        return model
