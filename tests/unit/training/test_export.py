import json
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytest.importorskip("onnx")

from egotouch_sdk.errors import ModelError  # noqa: E402
from egotouch_sdk.inference import create_session  # noqa: E402
from egotouch_sdk.model_store import MODELS_DIR  # noqa: E402
from egotouch_sdk.touch import TouchModel  # noqa: E402
from egotouch_sdk.training.export import ModelFacts, check_parity, run_torch, write_model  # noqa: E402
from egotouch_sdk.training.model_card import add_measurements  # noqa: E402
from egotouch_sdk.training.network import TouchNetwork  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore:.*legacy.*:UserWarning", "ignore::torch.jit.TracerWarning")


@pytest.fixture(scope="module")
def network() -> TouchNetwork:
    torch.manual_seed(0)
    network = TouchNetwork()
    with torch.no_grad():
        for _ in range(3):
            network.train()(torch.randn(8, 3, 100, 100), torch.rand(8, 2))
    return network.eval()


@pytest.fixture(scope="module")
def model_file(network: TouchNetwork, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_model(
        network, ModelFacts("test", 0.5, 0.4, {"data": "noise"}, {"held_out": {"auroc": 0.5}}), tmp_path_factory.mktemp("model")
    )


def golden_pair(folder: Path) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    golden = dict(np.load(folder / "touch_golden.npz"))
    names = ("patch", "polar", "memory")
    return {name: golden[name] for name in names if name in golden}, {name: golden[name] for name in golden if name not in names}


@pytest.mark.parametrize("count", [1, 3, 7])
def test_the_file_answers_like_the_network_for_every_batch_size(network: TouchNetwork, model_file: Path, count: int) -> None:
    patch = np.random.default_rng(count).standard_normal((count, 3, 100, 100), np.float32)
    polar = np.random.default_rng(count).random((count, 2), np.float32)
    got = create_session(model_file).run(["touch_logit", "force_n", "force_sigma_n"], {"patch": patch, "polar": polar})
    for g, e in zip(got, run_torch(network, {"patch": patch, "polar": polar}).values(), strict=True):
        assert g.shape == (count,)
        np.testing.assert_allclose(g, e, atol=1e-4)


def test_the_written_folder_loads_as_a_touch_model(model_file: Path) -> None:
    manifest = TouchModel(model_file).manifest
    assert (manifest.version, manifest.down_probability, manifest.up_probability) == ("test", 0.5, 0.4)
    card = (model_file.parent / "MODEL_CARD.md").read_text()
    assert "3,371,025" in card and "4.1 M" in card and "noise" in card


def test_another_networks_file_is_refused(model_file: Path) -> None:
    inputs, outputs = golden_pair(model_file.parent)
    with pytest.raises(ModelError, match="differs"):
        check_parity(model_file, inputs, {**outputs, "touch_logit": outputs["touch_logit"] + 1})


def test_a_network_that_remembers_is_written_with_its_memory(tmp_path: Path) -> None:
    torch.manual_seed(2)
    model_file = write_model(TouchNetwork(remembers=True).eval(), ModelFacts("test", 0.5, 0.4, {"data": "noise"}), tmp_path)
    assert TouchModel(model_file).memory_size == 128
    inputs, outputs = golden_pair(tmp_path)
    assert set(inputs) == {"patch", "polar", "memory"} and outputs["next_memory"].shape == (4, 128)
    with pytest.raises(ModelError, match="differs"):
        check_parity(model_file, {**inputs, "memory": inputs["memory"] + 1}, outputs)
    assert "remembers" in (tmp_path / "MODEL_CARD.md").read_text()


@pytest.mark.parametrize(("down", "up"), [(0.5, 0.6), (1.0, 0.5), (0.5, 0.0)])
def test_impossible_thresholds_are_refused(down: float, up: float) -> None:
    with pytest.raises(ModelError, match="up <= down"):
        ModelFacts("x", down, up)


def test_the_shipped_file_still_gives_its_golden_outputs() -> None:
    check_parity(MODELS_DIR / "touch.onnx", *golden_pair(MODELS_DIR))
    parameters = json.loads((MODELS_DIR / "touch.json").read_text())["parameters"]
    assert (parameters["trained"], parameters["shipped"]) == (3_371_025, 3_339_009)


def test_later_figures_join_manifest_and_card(model_file: Path) -> None:
    add_measurements(model_file.parent, {"real": {"auroc": 0.875}}, ["first try | too blurry"])
    manifest = json.loads(model_file.with_suffix(".json").read_text())
    assert manifest["measured"] == {"held_out": {"auroc": 0.5}, "real": {"auroc": 0.875}}
    card = (model_file.parent / "MODEL_CARD.md").read_text()
    assert "0.875" in card and "- first try | too blurry" in card
    TouchModel(model_file)


def test_figures_need_a_manifest(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"no touch\.json"):
        add_measurements(tmp_path, {})
