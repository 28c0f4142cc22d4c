from collections.abc import Callable
from pathlib import Path

import pytest

torch = pytest.importorskip("torch")
safetensors = pytest.importorskip("safetensors.torch")

from egotouch_sdk.errors import ConfigError  # noqa: E402
from egotouch_sdk.training.network import TouchNetwork  # noqa: E402
from egotouch_sdk.training.pretrained import authors_name, start_trunk, timm_name  # noqa: E402


def weights(naming: Callable[[str], str | None] = timm_name) -> dict[str, "torch.Tensor"]:
    """FastViT-T8 weights by chance, under another project's names, with its classifier."""
    torch.manual_seed(1)
    named = {naming(own): torch.rand_like(value) for own, value in TouchNetwork().state_dict().items() if naming(own)}
    return {**named, "head.fc.weight": torch.zeros(10, 768)}


@pytest.mark.parametrize(("naming", "file"), [(timm_name, "a.safetensors"), (timm_name, "a.bin"), (authors_name, "a.pth.tar")])
def test_every_tensor_of_the_trunk_is_taken_and_the_head_stays(naming: Callable[[str], str | None], file: str, tmp_path: Path) -> None:
    theirs, path = weights(naming), tmp_path / file
    if path.suffix == ".safetensors":
        safetensors.save_file(theirs, path)
    else:
        torch.save({"state_dict": theirs} if path.suffix == ".tar" else theirs, path)
    network = TouchNetwork()
    before = {name: value.clone() for name, value in network.state_dict().items()}
    start = start_trunk(network, path)
    assert (start.file, start.taken, start.kept, start.unused) == (file, 390, (), ("head.fc.weight",))
    for own, value in network.state_dict().items():
        name = naming(own)
        assert torch.equal(value, before[own] if name is None else theirs[name]), own


def test_names_as_both_projects_write_them() -> None:
    own = "trunk.4.mixer.mix.branches.1.1.running_var"
    assert timm_name(own) == "stages.1.blocks.0.token_mixer.mixer.conv_scale.bn.running_var"
    assert authors_name(own) == "network.2.0.token_mixer.mixer.rbr_scale.bn.running_var"
    assert timm_name("trunk.13.scale") == "stages.3.blocks.1.layer_scale.gamma"
    assert authors_name("trunk.11.0.branches.0.0.weight") == "network.5.proj.0.lkb_origin.conv.weight"
    assert timm_name("features.weight") is None


def test_an_expansion_that_the_file_lacks_stays_from_scratch(tmp_path: Path) -> None:
    torch.save({name: value for name, value in weights().items() if not name.startswith("final_conv.")}, tmp_path / "a.bin")
    start = start_trunk(TouchNetwork(), tmp_path / "a.bin")
    assert start.taken == 376 and len(start.kept) == 14 and all(name.startswith(("expand.", "excite.")) for name in start.kept)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda w: w.pop("stem.1.conv_scale.bn.bias"), r"a\.bin is not a FastViT-T8: tensor stem\.1\.conv_scale\.bn\.bias is missing"),
        (lambda w: w.update({"stem.0.conv_kxk.0.conv.weight": torch.zeros(64, 3, 3, 3)}), r"shape \(64, 3, 3, 3\), need \(48, 3, 3, 3\)"),
        (lambda w: w.update({"stem.0.reparam_conv.weight": torch.zeros(1)}), "folded"),
        (lambda w: w.update({"epoch": 3}), "no table of tensors"),
    ],
)
def test_other_weights_are_refused_and_nothing_changes(change: Callable[[object], object], message: str, tmp_path: Path) -> None:
    theirs = weights()
    change(theirs)
    torch.save(theirs, tmp_path / "a.bin")
    network = TouchNetwork()
    before = network.trunk[13].scale.clone()
    with pytest.raises(ConfigError, match=message):
        start_trunk(network, tmp_path / "a.bin")
    assert torch.equal(network.trunk[13].scale, before)


@pytest.mark.parametrize("name", ["a.bin", "a.safetensors"])
def test_a_file_of_something_else_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="there is no file"):
        start_trunk(TouchNetwork(), tmp_path / name)
    (tmp_path / name).write_text("not weights")
    with pytest.raises(ConfigError, match="not a readable file"):
        start_trunk(TouchNetwork(), tmp_path / name)


def test_the_trunk_computes_what_timm_computes(tmp_path: Path) -> None:
    fastvit = pytest.importorskip("timm.models.fastvit", exc_type=ImportError)
    theirs = fastvit.fastvit_t8().eval()
    torch.manual_seed(1)
    with torch.no_grad():
        for name, value in theirs.state_dict().items():
            if name.endswith(("running_var", "gamma")):
                value.uniform_(0.5, 1.0)
    torch.save(theirs.state_dict(), tmp_path / "a.bin")
    ours = TouchNetwork().eval()
    start_trunk(ours, tmp_path / "a.bin")
    patch = torch.randn(2, 3, 100, 100)
    with torch.no_grad():
        difference = theirs.forward_features(patch) - ours.excite(ours.expand(ours.trunk(patch)))
    assert difference.abs().max() < 1e-4
