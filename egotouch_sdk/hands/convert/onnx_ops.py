"""One translation per TFLite operator that MediaPipe's hand networks use (13 kinds), as a table."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert.onnx_builder import OnnxBuilder
from egotouch_sdk.hands.convert.tflite_graph import Operator


def _convolution(builder: OnnxBuilder, op: Operator) -> None:
    graph, options, source = builder.graph, op.options, op.inputs[0]
    depthwise = op.name == "DEPTHWISE_CONV_2D"
    if depthwise and options["DepthMultiplier"] != 1:
        raise ModelError("a depthwise convolution with a channel multiplier is not supported")
    weights = graph.constants[op.inputs[1]]
    weights = weights.transpose((3, 0, 1, 2) if depthwise else (0, 3, 1, 2))  # 1HWO or OHWI -> OIHW
    if source == graph.input:
        weights = weights[:, ::-1] / np.float32(255)  # the input is BGR 0..255, TFLite's was RGB 0..1
    kernel = (int(weights.shape[2]), int(weights.shape[3]))
    stride = options["StrideH"], options["StrideW"]
    dilation = options["DilationHFactor"], options["DilationWFactor"]
    inputs = [builder.name(source), builder.constant(f"weights{op.output}", weights)]
    if len(op.inputs) > 2 and op.inputs[2] >= 0:
        inputs.append(builder.constant(f"bias{op.output}", graph.constants[op.inputs[2]]))
    builder.activated(
        "Conv",
        inputs,
        op.output,
        options["FusedActivationFunction"],
        kernel_shape=kernel,
        strides=stride,
        dilations=dilation,
        pads=builder.window_pads(source, kernel, stride, dilation, options["Padding"]),
        group=graph.shapes[source][3] if depthwise else 1,
    )
    builder.spatial.add(op.output)


def _max_pool(builder: OnnxBuilder, op: Operator) -> None:
    options = op.options
    kernel, stride = (options["FilterHeight"], options["FilterWidth"]), (options["StrideH"], options["StrideW"])
    pads = builder.window_pads(op.inputs[0], kernel, stride, (1, 1), options["Padding"])
    activation = options["FusedActivationFunction"]
    builder.activated("MaxPool", [builder.name(op.inputs[0])], op.output, activation, kernel_shape=kernel, strides=stride, pads=pads)
    builder.spatial.add(op.output)


def _add(builder: OnnxBuilder, op: Operator) -> None:
    builder.activated("Add", [builder.name(n) for n in op.inputs], op.output, op.options["FusedActivationFunction"])
    _keep_layout(builder, op)


def _prelu(builder: OnnxBuilder, op: Operator) -> None:
    """slope*x + (1-slope)*relu(x) as two 1x1 depthwise convolutions.

    ONNX Runtime's own PRelu runs on one scalar at a time and breaks the blocked NCHWc layout: palm detection takes 15.0 ms with
    it and 8.2 ms without (our measurement). max(x, slope*x) would be wrong, for slopes lie between -4.5 and 12.2.
    """
    source, target = builder.name(op.inputs[0]), builder.name(op.output)
    slope = builder.graph.constants[op.inputs[1]]
    if slope.shape[:2] != (1, 1):
        raise ModelError(f"PReLU with slopes of shape {slope.shape} is not supported")
    channels = slope.shape[2]
    slope = slope.reshape(channels, 1, 1, 1)
    positive = builder.node("Relu", [source], f"{target}_positive")
    scale, rest = builder.constant(f"slope{op.output}", slope), builder.constant(f"rest{op.output}", np.float32(1) - slope)
    parts = [
        builder.node("Conv", [source, scale], f"{target}_scaled", group=channels, kernel_shape=[1, 1]),
        builder.node("Conv", [positive, rest], f"{target}_kept", group=channels, kernel_shape=[1, 1]),
    ]
    builder.node("Add", parts, target)
    _keep_layout(builder, op)


def _pad(builder: OnnxBuilder, op: Operator) -> None:
    pads = builder.graph.constants[op.inputs[1]][[0, 3, 1, 2]]
    amounts = builder.constant(f"pads{op.output}", pads.T.reshape(-1).astype(np.int64))
    builder.node("Pad", [builder.name(op.inputs[0]), amounts], builder.name(op.output), mode="constant")
    builder.spatial.add(op.output)


def _resize(builder: OnnxBuilder, op: Operator) -> None:
    height, width = builder.graph.shapes[op.inputs[0]][1:3]
    target_height, target_width = (int(n) for n in builder.graph.constants[op.inputs[1]])
    scales = builder.constant(f"scales{op.output}", np.array([1, 1, target_height / height, target_width / width], np.float32))
    mode = "align_corners" if op.options["AlignCorners"] else "half_pixel" if op.options["HalfPixelCenters"] else "asymmetric"
    inputs = [builder.name(op.inputs[0]), "", scales]
    builder.node("Resize", inputs, builder.name(op.output), mode="linear", coordinate_transformation_mode=mode)
    builder.spatial.add(op.output)


def _mean(builder: OnnxBuilder, op: Operator) -> None:
    axes = sorted(int(n) for n in builder.graph.constants[op.inputs[1]].reshape(-1))
    if axes != [1, 2] or op.inputs[0] not in builder.spatial:
        raise ModelError(f"a mean over axes {axes} is not supported, only over height and width")
    source, target = builder.name(op.inputs[0]), builder.name(op.output)
    if op.options["KeepDims"]:
        builder.node("GlobalAveragePool", [source], target)
        builder.spatial.add(op.output)
    else:
        builder.node("Flatten", [builder.node("GlobalAveragePool", [source], f"{target}_pooled")], target, axis=1)


def _fully_connected(builder: OnnxBuilder, op: Operator) -> None:
    source = builder.name(op.inputs[0])
    if op.inputs[0] in builder.spatial:
        if builder.graph.shapes[op.inputs[0]][1:3] != (1, 1):
            raise ModelError("a fully connected layer over an image larger than 1x1 is not supported")
        source = builder.node("Flatten", [source], f"flat{op.output}", axis=1)
    weights = builder.constant(f"weights{op.output}", builder.graph.constants[op.inputs[1]])
    bias = builder.constant(f"bias{op.output}", builder.graph.constants[op.inputs[2]])
    builder.activated("Gemm", [source, weights, bias], op.output, op.options["FusedActivationFunction"], transB=1)


def _logistic(builder: OnnxBuilder, op: Operator) -> None:
    builder.node("Sigmoid", [builder.name(op.inputs[0])], builder.name(op.output))
    _keep_layout(builder, op)


def _reshape(builder: OnnxBuilder, op: Operator) -> None:
    shape = builder.graph.shapes[op.output]
    if len(shape) == 4:
        raise ModelError("a reshape to an image is not supported")
    target = builder.constant(f"shape{op.output}", np.array([0, *shape[1:]], np.int64))  # 0 keeps the batch
    builder.node("Reshape", [builder.channels_last(op.inputs[0]), target], builder.name(op.output))


def _concatenate(builder: OnnxBuilder, op: Operator) -> None:
    axis = op.options["Axis"] % len(builder.graph.shapes[op.output])
    if op.inputs[0] in builder.spatial:
        axis = (0, 2, 3, 1)[axis]
    builder.node("Concat", [builder.name(n) for n in op.inputs], builder.name(op.output), axis=axis)
    _keep_layout(builder, op)


def _keep_layout(builder: OnnxBuilder, op: Operator) -> None:
    if op.inputs[0] in builder.spatial:
        builder.spatial.add(op.output)


TRANSLATIONS: Mapping[str, Callable[[OnnxBuilder, Operator], None]] = {
    "CONV_2D": _convolution,
    "DEPTHWISE_CONV_2D": _convolution,
    "MAX_POOL_2D": _max_pool,
    "ADD": _add,
    "PRELU": _prelu,
    "PAD": _pad,
    "RESIZE_BILINEAR": _resize,
    "MEAN": _mean,
    "FULLY_CONNECTED": _fully_connected,
    "LOGISTIC": _logistic,
    "RESHAPE": _reshape,
    "CONCATENATION": _concatenate,
}
