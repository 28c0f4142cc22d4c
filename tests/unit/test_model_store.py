"""Manifests and altered files: one clear error each, with the next step."""

import json

import pytest

from egotouch_sdk.errors import ModelError
from egotouch_sdk.model_store import HANDS_DIR, checked_file, hand_model, read_manifest


def test_every_hand_network_of_the_manifest_is_intact():
    manifest = read_manifest(HANDS_DIR / "manifest.json")
    assert manifest["licence"] == "Apache-2.0"
    assert {"palm_detection_full", "hand_landmark_full", "hand_landmark_full_int8"} <= set(manifest["models"])
    for name in manifest["models"]:
        assert hand_model(name).is_file()


@pytest.mark.parametrize(
    ("content", "message"), [(None, "is missing"), ("{", "not readable JSON"), ("[]", "not a JSON object"), ("\xff\xfe", "not readable")]
)
def test_a_wrong_manifest_is_refused(tmp_path, content, message):
    path = tmp_path / "manifest.json"
    if content is not None:
        path.write_bytes(content.encode("latin-1"))
    with pytest.raises(ModelError, match=message) as caught:
        read_manifest(path)
    assert "pip install" in caught.value.hint


def test_an_altered_file_is_refused(tmp_path):
    path = tmp_path / "net.onnx"
    path.write_bytes(b"altered")
    with pytest.raises(ModelError, match="its manifest says 00"):
        checked_file(path, "00")
    with pytest.raises(ModelError, match="cannot be read"):
        checked_file(tmp_path / "absent.onnx", "00")


@pytest.mark.parametrize("models", [{}, {"other": {"file": "a", "sha256": "b"}}, {"palm_detection_full": {}}, None])
def test_a_network_that_the_manifest_lacks_is_named(tmp_path, models):
    (tmp_path / "manifest.json").write_text(json.dumps({"models": models}))
    with pytest.raises(ModelError, match="'palm_detection_full'"):
        hand_model("palm_detection_full", tmp_path)
