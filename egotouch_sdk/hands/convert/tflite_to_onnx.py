"""A TFLite hand network as an ONNX model that takes camera bytes."""

from __future__ import annotations

from collections.abc import Sequence

import onnx
from onnx import TensorProto, helper

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert.onnx_builder import OnnxBuilder
from egotouch_sdk.hands.convert.onnx_ops import TRANSLATIONS
from egotouch_sdk.hands.convert.tflite_graph import TfliteGraph, read_tflite

#: Name of the single ONNX input.
INPUT_NAME = "image"


def convert(data: bytes, output_names: Sequence[str], name: str) -> onnx.ModelProto:
    """Convert the bytes of a .tflite file; see `convert_graph`."""
    return convert_graph(read_tflite(data), output_names, name)


def convert_graph(graph: TfliteGraph, output_names: Sequence[str], name: str) -> onnx.ModelProto:
    """Convert a network that takes an RGB image, floats 0..1.

    Input `image`: uint8 BGR (N, H, W, 3), any batch N, exactly as OpenCV gives it; TFLite's scaling to 0..1 and its RGB order are
    folded into the first convolution. Outputs keep TFLite's shapes after the batch axis and are called `output_names`.
    Raises `ModelError` for an operator that MediaPipe's hand networks do not use.
    """
    if len(output_names) != len(graph.outputs):
        raise ModelError(f"the network has {len(graph.outputs)} outputs, {len(output_names)} names were given")
    builder = OnnxBuilder(graph)
    _, height, width, channels = graph.shapes[graph.input]
    image = helper.make_tensor_value_info(INPUT_NAME, TensorProto.UINT8, ["N", height, width, channels])
    planes = builder.node("Transpose", [INPUT_NAME], "planes", perm=[0, 3, 1, 2])
    builder.node("Cast", [planes], builder.name(graph.input), to=TensorProto.FLOAT)
    builder.spatial.add(graph.input)
    for op in graph.operators:
        if op.name not in TRANSLATIONS:
            raise ModelError(f"TFLite operator {op.name} is not supported", hint="Only MediaPipe's hand networks are supported")
        TRANSLATIONS[op.name](builder, op)
    outputs = []
    for tensor, output in zip(graph.outputs, output_names, strict=True):
        builder.node("Identity", [builder.channels_last(tensor)], output)
        outputs.append(helper.make_tensor_value_info(output, TensorProto.FLOAT, ["N", *graph.shapes[tensor][1:]]))
    return builder.model([image], outputs, name)
