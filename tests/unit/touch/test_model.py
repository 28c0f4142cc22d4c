from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper

from egotouch_sdk.errors import ModelError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch
from egotouch_sdk.touch import SHIPPED_MODEL, TouchModel
from egotouch_sdk.touch.manifest import check_signature
from tests.support.study import memory_model, signal_model, told_patch


def patch(seed: int, finger: Finger = Finger.INDEX) -> FingertipPatch:
    image = np.random.default_rng(seed).integers(0, 255, (100, 100, 3)).astype(np.uint8)
    return FingertipPatch(
        hand_id=1,
        handedness=Handedness.RIGHT,
        finger=finger,
        tip_px=(50.0, 50.0),
        px_per_mm=2.5,
        r_palms=1.0,
        theta_rad=0.2 * seed,
        image=image,
    )


@pytest.fixture(scope="module")
def model() -> TouchModel:
    return TouchModel()


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """The shipped model in a folder of its own."""
    for suffix in (".onnx", ".json"):
        shutil.copy(SHIPPED_MODEL.with_suffix(suffix), tmp_path / f"touch{suffix}")
    return tmp_path / "touch.onnx"


def test_answers_come_in_the_order_of_the_patches(model: TouchModel) -> None:
    estimates = model.estimate([patch(1, Finger.RING), patch(2, Finger.INDEX)])
    assert [(e.hand_id, e.finger) for e in estimates] == [(1, Finger.RING), (1, Finger.INDEX)]
    assert all(0 <= e.touch_probability <= 1 and 0 <= e.force_n <= 3.5 for e in estimates)


def test_a_batch_gives_what_its_patches_give_alone(model: TouchModel) -> None:
    patches = [patch(seed) for seed in range(4)]
    batch = model.estimate(patches)
    alone = [model.estimate([each])[0] for each in patches]
    np.testing.assert_allclose([e.touch_probability for e in batch], [e.touch_probability for e in alone], atol=1e-5)
    np.testing.assert_allclose([e.force_n for e in batch], [e.force_n for e in alone], atol=1e-4)


def test_no_patches_give_no_estimates(model: TouchModel) -> None:
    assert model.estimate([]) == ()


def test_what_is_remembered_goes_in_and_comes_out(tmp_path: Path) -> None:
    model = TouchModel(memory_model(tmp_path))
    assert model.memory_size == 2
    patches = [told_patch(2.0), told_patch(-1.0, hand_id=2)]
    estimates, memories = model.estimate_next(patches, np.array([[4.0, 2.0], [0.0, 0.0]], np.float32))
    assert memories.tolist() == [[6.0, 3.0], [-1.0, 1.0]]
    assert [each.force_n for each in estimates] == pytest.approx([0.3, 0.1])
    assert model.estimate(patches) == model.estimate_next(patches, np.zeros((2, 2), np.float32))[0]
    none, nothing = model.estimate_next([], np.zeros((0, 2), np.float32))
    assert none == () and nothing.shape == (0, 2)


def test_a_model_without_memory_remembers_nothing(tmp_path: Path) -> None:
    model = TouchModel(signal_model(tmp_path))
    estimates, memories = model.estimate_next([told_patch(2.0)], np.zeros((1, 0), np.float32))
    assert model.memory_size == 0 and memories.shape == (1, 0)
    assert estimates == model.estimate([told_patch(2.0)])


def test_memories_of_another_shape_are_refused(tmp_path: Path) -> None:
    model = TouchModel(memory_model(tmp_path))
    with pytest.raises(ModelError, match=r"memories have shape \(1, 3\), touch model memory 1 needs \(1, 2\)"):
        model.estimate_next([told_patch(2.0)], np.zeros((1, 3), np.float32))


def test_a_memory_that_is_no_number_is_refused(tmp_path: Path) -> None:
    file = memory_model(tmp_path)
    network = onnx.load(file)
    for node in network.graph.node:
        node.input[:] = ["kept" if name == "next_memory" else name for name in node.input]
        node.output[:] = ["kept" if name == "next_memory" else name for name in node.output]
    network.graph.initializer.append(onnx.numpy_helper.from_array(np.float32(0), "zero"))
    network.graph.node.append(helper.make_node("Div", ["kept", "zero"], ["next_memory"]))
    onnx.save(network, file)
    write_hash(file)
    with pytest.raises(ModelError, match="not finite"):
        TouchModel(file).estimate([told_patch(1.0)])


def test_thresholds_come_from_the_manifest(copied: Path) -> None:
    manifest = json.loads(copied.with_suffix(".json").read_text())
    manifest["threshold"] = {"down": 0.7, "up": 0.3}
    copied.with_suffix(".json").write_text(json.dumps(manifest))
    loaded = TouchModel(copied).manifest
    assert (loaded.down_probability, loaded.up_probability) == (0.7, 0.3)


def test_a_missing_model_is_named(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"no touch model at .*absent\.onnx"):
        TouchModel(tmp_path / "absent.onnx")


def test_a_model_without_manifest_is_refused(copied: Path) -> None:
    copied.with_suffix(".json").unlink()
    with pytest.raises(ModelError, match="manifest"):
        TouchModel(copied)


def test_an_altered_model_is_refused(copied: Path) -> None:
    copied.write_bytes(copied.read_bytes() + b"\0")
    with pytest.raises(ModelError, match="sha256"):
        TouchModel(copied)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"threshold": {"down": 0.5}}, "not the manifest of a touch model"),
        ({"threshold": {"down": 0.4, "up": 0.6}}, "thresholds"),
        ({"threshold": None}, "not the manifest of a touch model"),
    ],
)
def test_a_wrong_manifest_is_refused(copied: Path, change: dict[str, object], message: str) -> None:
    manifest = json.loads(copied.with_suffix(".json").read_text()) | change
    copied.with_suffix(".json").write_text(json.dumps(manifest))
    with pytest.raises(ModelError, match=message):
        TouchModel(copied)


def write_network(path: Path, inputs: dict[str, list[object]], outputs: dict[str, list[object]]) -> None:
    """A network of the given signature whose outputs are sums of its first input, with a manifest that fits the file."""
    first = next(iter(inputs))
    nodes = [helper.make_node("ReduceSum", [first], [name], keepdims=0 if len(shape) < 2 else 1) for name, shape in outputs.items()]
    graph = helper.make_graph(
        nodes,
        "other",
        [helper.make_tensor_value_info(name, TensorProto.FLOAT, shape) for name, shape in inputs.items()],
        [helper.make_tensor_value_info(name, TensorProto.FLOAT, shape) for name, shape in outputs.items()],
    )
    onnx.save(helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8), path)
    write_hash(path)


def write_hash(path: Path) -> None:
    import hashlib

    manifest = json.loads(path.with_suffix(".json").read_text())
    manifest["sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    path.with_suffix(".json").write_text(json.dumps(manifest))


def test_a_network_of_another_kind_is_refused(copied: Path) -> None:
    write_network(copied, {"image": ["N", 3, 224, 224]}, {"landmarks": ["N", 63]})
    with pytest.raises(ModelError, match=r"inputs \['image'\], a touch model has"):
        TouchModel(copied)


def test_a_network_of_another_shape_is_refused(copied: Path) -> None:
    write_network(copied, {"patch": ["N", 3, 64, 64], "polar": ["N", 2]}, {"touch_logit": ["N"], "force_n": ["N"]})
    with pytest.raises(ModelError, match="input patch of shape"):
        TouchModel(copied)


def test_a_network_of_fixed_batch_is_refused(copied: Path) -> None:
    write_network(copied, {"patch": [1, 3, 100, 100], "polar": [1, 2]}, {"touch_logit": [1], "force_n": [1]})
    with pytest.raises(ModelError, match="input patch of shape"):
        TouchModel(copied)


def test_a_file_that_is_no_network_is_refused(copied: Path) -> None:
    copied.write_text("not a network")
    write_hash(copied)
    with pytest.raises(ModelError, match="could not be loaded"):
        TouchModel(copied)


SIGNATURE: tuple[dict[str, tuple[object, ...]], dict[str, tuple[object, ...]]] = (
    {"patch": ("N", 3, 100, 100), "polar": ("N", 2)},
    {"touch_logit": ("N",), "force_n": ("N",)},
)


@pytest.mark.parametrize(
    ("memory", "next_memory", "message"),
    [
        (("N", 8), None, "has an input memory but no output next_memory"),
        (None, ("N", 8), "has an output next_memory but no input memory"),
        (("N", 8), ("N", 9), "takes memory of 8 numbers and gives next_memory of 9"),
        (("N", "M"), ("N", "M"), r"input memory of shape \['N', 'M'\]"),
        ((1, 8), (1, 8), r"input memory of shape \[1, 8\]"),
        (("N", 0), ("N", 0), r"input memory of shape \['N', 0\]"),
        (("N", 8), ("N", 8, 1), r"output next_memory of shape \['N', 8, 1\]"),
        (("N", 8), ("N", "M"), r"output next_memory of shape \['N', 'M'\]"),
    ],
)
def test_half_a_memory_is_refused(memory: tuple[object, ...] | None, next_memory: tuple[object, ...] | None, message: str) -> None:
    inputs = SIGNATURE[0] | ({} if memory is None else {"memory": memory})
    outputs = SIGNATURE[1] | ({} if next_memory is None else {"next_memory": next_memory})
    with pytest.raises(ModelError, match=message):
        check_signature(Path("touch.onnx"), inputs, outputs)


@pytest.mark.parametrize("extra", ["force_sigma_n", "next_memory"])
def test_an_output_is_no_input(extra: str) -> None:
    with pytest.raises(ModelError, match=r"touch\.onnx has inputs .* a touch model has"):
        check_signature(Path("touch.onnx"), SIGNATURE[0] | {extra: ("N", 8)}, SIGNATURE[1])
