import json
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytest.importorskip("lightning")
pytest.importorskip("onnx")

from egotouch_sdk.errors import ConfigError, SourceError  # noqa: E402
from egotouch_sdk.touch import TouchModel  # noqa: E402
from egotouch_sdk.training.average import average, mean_state  # noqa: E402
from egotouch_sdk.training.checkpoints import averaged_state  # noqa: E402
from egotouch_sdk.training.dataset import fixed_views  # noqa: E402
from egotouch_sdk.training.finish import predict  # noqa: E402
from egotouch_sdk.training.folder import read_folder  # noqa: E402
from egotouch_sdk.training.force_fit import fit_force  # noqa: E402
from egotouch_sdk.training.network import TouchNetwork  # noqa: E402
from egotouch_sdk.training.recipe import Recipe  # noqa: E402
from egotouch_sdk.training.run import Machine, Split, train  # noqa: E402
from egotouch_sdk.training.score import score_model  # noqa: E402

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings(
        "ignore::DeprecationWarning", "ignore::UserWarning", "ignore::FutureWarning", "ignore::torch.jit.TracerWarning"
    ),
]
TINY = Recipe(epochs=1, batch=8, held_out_views=1, held_out_share=0.2)


def test_train_export_and_resume(shard_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    machine = Machine(threads=1, workers=0)
    model = train(shard_folder, tmp_path, TINY, machine)
    manifest = json.loads(model.with_suffix(".json").read_text())
    assert manifest["training"]["steps_done"] == 4 and manifest["training"]["participants"] == 3
    assert 0 <= manifest["measured"]["held_out_renders"]["auroc"] <= 1
    TouchModel(model)

    longer = Recipe(epochs=2, batch=8, held_out_views=1, held_out_share=0.2)
    resumed = json.loads(train(shard_folder, tmp_path, longer, machine, resume=True).with_suffix(".json").read_text())
    assert resumed["training"]["steps_done"] == 8

    fresh = tmp_path / "fresh"
    train(shard_folder, fresh, TINY, machine, start_from=tmp_path / "last.ckpt")
    assert (fresh / "touch.onnx").is_file()

    runs = [tmp_path / "last.ckpt", fresh / "last.ckpt"]
    mean = json.loads(average([*runs, runs[0]], shard_folder, tmp_path / "mean", 1, shard_folder).with_suffix(".json").read_text())
    assert mean["training"]["averaged_runs"] == 2 and mean["training"]["weights"] == [2, 1]
    assert mean["training"]["run_1"]["steps_done"] == 8 and mean["training"]["force_fitted_on"]["patches"] == len(read_folder(shard_folder))
    first, second = (averaged_state(run)["outputs.weight"] for run in runs)
    torch.testing.assert_close(mean_state([averaged_state(run) for run in runs])["outputs.weight"], (first + second) / 2)
    with pytest.raises(ConfigError, match="different networks"):
        mean_state([{"a": torch.zeros(2)}, {"a": torch.zeros(3)}])


def test_nothing_to_resume(shard_folder: Path, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no checkpoint"):
        train(shard_folder, tmp_path, TINY, Machine(1, 0), resume=True)


def test_a_side_without_touches_is_refused(shard_folder: Path) -> None:
    hovers = [patch for patch in read_folder(shard_folder) if not patch.label.touch]
    with pytest.raises(SourceError, match="lack touches"):
        Split.of(hovers, TINY)


@pytest.mark.parametrize("remembers", [False, True])
def test_films_train_a_network_with_and_without_a_memory(film_folder: Path, tmp_path: Path, remembers: bool) -> None:
    recipe = Recipe(epochs=1, batch=2, held_out_views=1, held_out_share=0.2, remembers=remembers)
    model = train(film_folder, tmp_path, recipe, Machine(threads=1, workers=0))
    manifest = json.loads(model.with_suffix(".json").read_text())
    assert manifest["training"]["patches"] == 3 * 2 * 4 and manifest["training"]["steps_done"] == 3
    assert TouchModel(model).memory_size == (128 if remembers else 0)
    assert ("memory" in manifest["inputs"]) == remembers
    scores = score_model(model, read_folder(film_folder), views=1, seed=0)
    assert scores["pictures"] == 4 * 2 * 4 and 0 <= scores["auroc"] <= 1


def test_single_patches_give_nothing_to_remember(shard_folder: Path, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="nothing to remember"):
        train(shard_folder, tmp_path, Recipe(epochs=1, batch=8, remembers=True), Machine(1, 0))


def test_fitting_the_force_lessens_its_error_and_leaves_the_touch_alone(shard_folder: Path) -> None:
    torch.manual_seed(0)
    network, rendered = TouchNetwork(), read_folder(shard_folder)
    _, seen = fixed_views(rendered, views=1, seed=3)
    touching = seen.touch.numpy() > 0.5

    def told() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        logit, force_n, sigma_n = predict(network, seen)
        return logit, np.abs(force_n - seen.force_n.numpy())[touching], sigma_n[touching]

    logit, before, _ = told()
    assert fit_force(network, rendered, seed=1) is network
    same, after, sigma_n = told()
    np.testing.assert_array_equal(same, logit)
    assert after.mean() < 0.8 * before.mean()
    assert 0.3 < np.median(sigma_n) / after.mean() < 3
