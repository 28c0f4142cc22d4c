"""TFLite operators as ONNX: each against a plain numpy calculation."""

import itertools

import numpy as np
import onnxruntime
import pytest

from egotouch_sdk.errors import ModelError

pytest.importorskip("tflite", reason="the converter's build requirements are not installed")
pytest.importorskip("onnx", reason="the converter's build requirements are not installed")

from tflite import ActivationFunctionType as Activation
from tflite import Padding

from egotouch_sdk.hands.convert.build import FULL
from egotouch_sdk.hands.convert.tflite_graph import Operator, TfliteGraph
from egotouch_sdk.hands.convert.tflite_to_onnx import convert_graph
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_store import hand_model

RNG = np.random.default_rng(3)
CONV = {"StrideH": 1, "StrideW": 1, "DilationHFactor": 1, "DilationWFactor": 1, "FusedActivationFunction": Activation.NONE}


def run(image, operators, constants, shapes, output):
    """Output tensor of a small graph for uint8 BGR images; tensor 0 is the input."""
    graph = TfliteGraph(tuple(shapes), constants, tuple(operators), 0, (output,))
    data = convert_graph(graph, ["out"], "tiny").SerializeToString()
    session = onnxruntime.InferenceSession(data, providers=["CPUExecutionProvider"])
    return session.run(["out"], {"image": image})[0]


def images(side, count=2):
    return RNG.integers(0, 256, (count, side, side, 3), dtype=np.uint8)


def rgb(image):
    return image[..., ::-1].astype(np.float64) / 255


def identity_conv(side, channels=3):
    """A 1x1 convolution that passes RGB 0..1 on as tensor 1, for operators that are never first."""
    weights = np.eye(channels, 3, dtype=np.float32).reshape(channels, 1, 1, 3)
    shapes = [(1, side, side, 3), (1, side, side, channels)]
    return Operator("CONV_2D", (0, 10), 1, {**CONV, "Padding": Padding.VALID}), {10: weights}, shapes


def convolved(image, weights, stride):
    """SAME convolution with weights OHWI, the odd pixel of padding at the bottom and right."""
    count, side, _, _ = image.shape
    out, kernel = -(-side // stride), weights.shape[1]
    total = max((out - 1) * stride + kernel - side, 0)
    before = total // 2
    padded = np.pad(image, ((0, 0), (before, total - before), (before, total - before), (0, 0)))
    result = np.empty((count, out, out, len(weights)))
    for y, x in itertools.product(range(out), range(out)):
        window = padded[:, y * stride : y * stride + kernel, x * stride : x * stride + kernel]
        result[:, y, x] = np.tensordot(window, weights, ([1, 2, 3], [1, 2, 3]))
    return result


@pytest.mark.parametrize(("side", "kernel", "stride"), [(8, 3, 1), (8, 3, 2), (7, 3, 2), (8, 5, 2)])
def test_first_convolution_takes_camera_bytes(side, kernel, stride):
    weights, bias = RNG.normal(size=(4, kernel, kernel, 3)).astype(np.float32), RNG.normal(size=4).astype(np.float32)
    options = {**CONV, "StrideH": stride, "StrideW": stride, "Padding": Padding.SAME, "FusedActivationFunction": Activation.RELU6}
    out = -(-side // stride)
    image = images(side)
    got = run(image, [Operator("CONV_2D", (0, 1, 2), 3, options)], {1: weights, 2: bias}, [(1, side, side, 3), (), (), (1, out, out, 4)], 3)
    expected = np.clip(convolved(rgb(image), weights.astype(np.float64), stride) + bias, 0, 6)
    assert got == pytest.approx(expected, abs=1e-4)


def test_depthwise_convolution_keeps_channels_apart():
    first, constants, shapes = identity_conv(6)
    weights = RNG.normal(size=(1, 3, 3, 3)).astype(np.float32)
    options = {**CONV, "StrideH": 2, "StrideW": 2, "Padding": Padding.SAME, "DepthMultiplier": 1}
    image = images(6)
    got = run(image, [first, Operator("DEPTHWISE_CONV_2D", (1, 11), 2, options)], constants | {11: weights}, [*shapes, (1, 3, 3, 3)], 2)
    for channel in range(3):
        single = convolved(rgb(image)[..., channel : channel + 1], weights[..., channel : channel + 1].astype(np.float64), 2)
        assert got[..., channel] == pytest.approx(single[..., 0], abs=1e-5)


def test_prelu_is_exact_for_slopes_beyond_one_and_below_zero():
    side = 4
    weights = np.diag([1.0, -1.0, 1.0]).astype(np.float32).reshape(3, 1, 1, 3)
    bias = np.array([-0.5, 0.5, -2.0], np.float32)
    slopes = np.array([[[12.2, -4.5, 0.25]]], np.float32)
    operators = [Operator("CONV_2D", (0, 10, 11), 1, {**CONV, "Padding": Padding.VALID}), Operator("PRELU", (1, 12), 2)]
    image = images(side)
    got = run(image, operators, {10: weights, 11: bias, 12: slopes}, [(1, side, side, 3)] * 3, 2)
    value = rgb(image) * [1, -1, 1] + bias
    assert got == pytest.approx(np.where(value > 0, value, value * slopes[0, 0]), abs=1e-4)


def test_bilinear_resize_uses_half_pixel_centres():
    first, constants, shapes = identity_conv(2)
    resize = Operator("RESIZE_BILINEAR", (1, 11), 2, {"AlignCorners": 0, "HalfPixelCenters": 1})
    image = images(2, 1)
    got = run(image, [first, resize], constants | {11: np.array([4, 4], np.int32)}, [*shapes, (1, 4, 4, 3)], 2)
    a, b = rgb(image)[0, 0, 0], rgb(image)[0, 0, 1]
    assert got[0, 0] == pytest.approx(np.stack([a, 0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b, b]), abs=1e-5)


def test_reshape_and_mean_follow_tflites_axis_order():
    first, constants, shapes = identity_conv(2)
    image = images(2)
    flat = run(image, [first, Operator("RESHAPE", (1,), 2)], constants, [*shapes, (1, 4, 3)], 2)
    assert flat == pytest.approx(rgb(image).reshape(2, 4, 3), abs=1e-6)
    mean = Operator("MEAN", (1, 11), 2, {"KeepDims": 0})
    assert run(image, [first, mean], constants | {11: np.array([1, 2], np.int32)}, [*shapes, (1, 3)], 2) == pytest.approx(
        rgb(image).mean((1, 2)), abs=1e-6
    )


def test_an_unknown_operator_is_refused_by_name():
    with pytest.raises(ModelError, match="TRANSPOSE_CONV"):
        run(images(2), [Operator("TRANSPOSE_CONV", (0,), 1)], {}, [(1, 2, 2, 3), (1, 2, 2, 3)], 1)


@pytest.mark.parametrize("network", FULL, ids=lambda network: network.name)
def test_shipped_networks_take_any_batch(network):
    session = create_session(hand_model(network.name))
    (image,) = session.get_inputs()
    assert (image.name, image.type, image.shape[0], image.shape[3]) == ("image", "tensor(uint8)", "N", 3)
    batch = images(image.shape[1], 3)
    together = session.run(list(network.outputs), {"image": batch})
    for single, part in zip(session.run(list(network.outputs), {"image": batch[1:2]}), together, strict=True):
        assert part[1:2] == pytest.approx(single, rel=1e-4, abs=1e-3)
