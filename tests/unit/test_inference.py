"""Sessions: loading, and one clear error for what is not a network."""

import numpy as np
import pytest

from egotouch_sdk.errors import ModelError
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_store import hand_model


@pytest.mark.parametrize("threads", [1, 2])
def test_a_network_loads_and_runs(threads):
    session = create_session(hand_model("palm_detection_full"), threads)
    boxes, scores = session.run(["boxes", "scores"], {"image": np.zeros((1, 192, 192, 3), np.uint8)})
    assert boxes.shape == (1, 2016, 18)
    assert scores.shape == (1, 2016, 1)


@pytest.mark.parametrize("content", [b"", b"a text file", None])
def test_what_is_not_a_network_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "net.onnx"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ModelError, match=r"net\.onnx could not be loaded") as caught:
        create_session(path)
    assert "\n" not in str(caught.value)


def test_a_session_needs_a_thread():
    with pytest.raises(ModelError, match="at least 1 thread"):
        create_session(hand_model("palm_detection_full"), 0)
