"""Read a TFLite file into plain Python data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
import tflite

from egotouch_sdk.errors import ModelError

Array = npt.NDArray[Any]

#: TFLite tensor types that MediaPipe's hand networks hold (all weights are float16).
_DTYPES = {tflite.TensorType.FLOAT32: np.float32, tflite.TensorType.FLOAT16: np.float16, tflite.TensorType.INT32: np.int32}

_OPERATOR_NAMES = {value: name for name, value in vars(tflite.BuiltinOperator).items() if isinstance(value, int)}

#: For each operator that carries options: their flatbuffers class and the fields we use.
_OPTIONS: Mapping[str, tuple[type[Any], tuple[str, ...]]] = {
    "CONV_2D": (tflite.Conv2DOptions, ("StrideH", "StrideW", "DilationHFactor", "DilationWFactor", "Padding", "FusedActivationFunction")),
    "DEPTHWISE_CONV_2D": (
        tflite.DepthwiseConv2DOptions,
        ("StrideH", "StrideW", "DilationHFactor", "DilationWFactor", "Padding", "FusedActivationFunction", "DepthMultiplier"),
    ),
    "MAX_POOL_2D": (tflite.Pool2DOptions, ("FilterHeight", "FilterWidth", "StrideH", "StrideW", "Padding", "FusedActivationFunction")),
    "ADD": (tflite.AddOptions, ("FusedActivationFunction",)),
    "FULLY_CONNECTED": (tflite.FullyConnectedOptions, ("FusedActivationFunction",)),
    "MEAN": (tflite.ReducerOptions, ("KeepDims",)),
    "RESIZE_BILINEAR": (tflite.ResizeBilinearOptions, ("AlignCorners", "HalfPixelCenters")),
    "CONCATENATION": (tflite.ConcatenationOptions, ("Axis", "FusedActivationFunction")),
}


@dataclass(frozen=True, slots=True)
class Operator:
    """One node: TFLite's operator name, tensor numbers in and out, and its options by TFLite field name."""

    name: str
    inputs: tuple[int, ...]
    output: int
    options: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class TfliteGraph:
    """A single-subgraph network; tensors are numbered, constants hold float32 or int32 values."""

    shapes: tuple[tuple[int, ...], ...]
    constants: Mapping[int, Array]
    operators: tuple[Operator, ...]
    input: int
    outputs: tuple[int, ...]


def read_tflite(data: bytes) -> TfliteGraph:
    """Parse the bytes of a .tflite file; float16 weights behind DEQUANTIZE become float32 constants.

    Raises `ModelError` for a file with several subgraphs, several inputs, or an operator with several outputs.
    """
    model = tflite.Model.GetRootAsModel(data, 0)
    if model.SubgraphsLength() != 1 or model.Subgraphs(0).InputsLength() != 1:
        raise ModelError("the TFLite file must have one subgraph with one input", hint="Only MediaPipe's hand networks are supported")
    graph = model.Subgraphs(0)
    tensors = [graph.Tensors(i) for i in range(graph.TensorsLength())]
    shapes = tuple(tuple(int(n) for n in t.ShapeAsNumpy()) if t.ShapeLength() else () for t in tensors)
    constants: dict[int, Array] = {}
    for number, tensor in enumerate(tensors):
        buffer = model.Buffers(tensor.Buffer())
        if buffer.DataLength():
            constants[number] = np.frombuffer(buffer.DataAsNumpy().tobytes(), _DTYPES[tensor.Type()]).reshape(shapes[number])
    operators = []
    for index in range(graph.OperatorsLength()):
        operator = _read_operator(model, graph.Operators(index))
        if operator.name == "DEQUANTIZE":
            constants[operator.output] = constants[operator.inputs[0]].astype(np.float32)
        else:
            operators.append(operator)
    return TfliteGraph(shapes, constants, tuple(operators), int(graph.Inputs(0)), tuple(int(n) for n in graph.OutputsAsNumpy()))


def _read_operator(model: Any, raw: Any) -> Operator:
    code = model.OperatorCodes(raw.OpcodeIndex())
    name = _OPERATOR_NAMES[max(code.BuiltinCode(), code.DeprecatedBuiltinCode())]
    if raw.OutputsLength() != 1:
        raise ModelError(f"TFLite operator {name} has {raw.OutputsLength()} outputs, need 1")
    options: dict[str, int] = {}
    if name in _OPTIONS:
        options_class, names = _OPTIONS[name]
        reader, table = options_class(), raw.BuiltinOptions()
        reader.Init(table.Bytes, table.Pos)
        options = {field_name: int(getattr(reader, field_name)()) for field_name in names}
    return Operator(name, tuple(int(n) for n in raw.InputsAsNumpy()), int(raw.Outputs(0)), options)
