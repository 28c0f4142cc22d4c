"""The 8-bit landmark network: portable weights, complete ranges, and the same hands as in float."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy

pytest.importorskip("onnx", reason="the converter's build requirements are not installed")
pytest.importorskip("tflite", reason="the converter's build requirements are not installed")

import onnx
from onnx import numpy_helper

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert.build import RANGES_FILE
from egotouch_sdk.hands.convert.quantise import quantise, quantised_tensors, weight_scales
from egotouch_sdk.model_store import hand_model


@given(st_numpy.arrays(np.float32, (3, 8, 1, 1), elements=st.floats(-4, 4, width=16)))
def test_neighbouring_weights_never_overflow_sixteen_bits(weights):
    scale = np.maximum(weight_scales(weights), 1e-6)
    rows = np.round(weights / scale[:, None, None, None]).reshape(3, 8).astype(int)
    assert np.abs(rows).max() <= 127
    worst = 255 * np.where(rows[:, :-1] * rows[:, 1:] > 0, np.abs(rows[:, :-1] + rows[:, 1:]), 0)
    assert worst.max() <= 32767


def test_depthwise_weights_use_all_eight_bits():
    weights = np.full((2, 1, 3, 3), 0.5, np.float32)
    assert np.round(weights[:, 0, 0, 0] / weight_scales(weights)).tolist() == [127, 127]


def test_ranges_cover_exactly_the_quantised_tensors():
    ranges = json.loads(RANGES_FILE.read_text())["hand_landmark_full"]
    assert sorted(ranges) == quantised_tensors(onnx.load(hand_model("hand_landmark_full")))
    with pytest.raises(ModelError, match="no calibrated range for t1"):
        quantise(onnx.load(hand_model("hand_landmark_full")), {})


def test_the_shipped_network_holds_integer_weights():
    model = onnx.load(hand_model("hand_landmark_full_int8"))
    integers = [numpy_helper.to_array(c) for c in model.graph.initializer if c.name.endswith("_weights_integers")]
    assert len(integers) == 35
    for weights in integers:
        assert weights.dtype == np.int8
        assert np.abs(weights.astype(int)).max() > 20
