import pytest

torch = pytest.importorskip("torch")

from egotouch_sdk.training.fastvit import FoldableConv, RepMixer  # noqa: E402
from egotouch_sdk.training.network import TouchNetwork, count_parameters, reparameterise  # noqa: E402


def lived_in(network: torch.nn.Module) -> torch.nn.Module:
    """Weights and running statistics as after training, so that folding has something to get wrong."""
    torch.manual_seed(0)
    for module in network.modules():
        if isinstance(module, torch.nn.BatchNorm2d):
            module.running_mean.normal_(0, 0.3)
            module.running_var.uniform_(0.3, 2.0)
            torch.nn.init.uniform_(module.weight, 0.7, 1.5)
            torch.nn.init.normal_(module.bias, 0, 0.3)
    return network.eval()


def inputs(count: int = 3) -> tuple[torch.Tensor, torch.Tensor]:
    torch.manual_seed(1)
    return torch.randn(count, 3, 100, 100), torch.rand(count, 2)


@pytest.mark.parametrize(
    "block",
    [
        FoldableConv(6, 6, (3, 1), groups=6, skip=True),
        FoldableConv(6, 12, (7, 3), stride=2, groups=6),
        FoldableConv(6, 6, (1,), skip=True),
        RepMixer(6),
    ],
    ids=["depthwise", "downsample", "pointwise", "mixer"],
)
def test_a_folded_block_gives_the_same_output(block: torch.nn.Module) -> None:
    lived_in(block)
    x = torch.randn(2, 6, 13, 13)
    with torch.no_grad():
        before = block(x)
        block.fold()
        after = block(x)
    assert before.std() > 0.1
    torch.testing.assert_close(after, before, atol=1e-4, rtol=1e-4)


def test_folding_the_network_keeps_its_outputs_and_drops_every_batch_norm() -> None:
    network = lived_in(TouchNetwork())
    shipped = reparameterise(network)
    with torch.no_grad():
        for expected, got in zip(network(*inputs()), shipped(*inputs()), strict=True):
            torch.testing.assert_close(got, expected, atol=1e-4, rtol=1e-4)
    assert not [m for m in shipped.modules() if isinstance(m, torch.nn.BatchNorm2d)]


def test_parameter_counts() -> None:
    network = TouchNetwork()
    assert count_parameters(network) == 3_371_025
    assert count_parameters(reparameterise(network)) == 3_339_009
    assert count_parameters(TouchNetwork(remembers=True)) == 3_470_097


def test_the_patch_and_the_place_both_reach_both_outputs() -> None:
    network = lived_in(TouchNetwork())
    patch, polar = inputs()
    with torch.no_grad():
        base = network.embed(patch, polar)
        assert not torch.allclose(base, network.embed(patch + torch.randn_like(patch), polar))
        assert not torch.allclose(base, network.embed(patch, polar + 1))


def test_force_is_in_range_only_once_training_is_over() -> None:
    network = lived_in(TouchNetwork())
    torch.nn.init.constant_(network.outputs.bias, 7.0)
    with torch.no_grad():
        assert network(*inputs())[1].max() <= 3.5
        assert network.train()(*inputs())[1].max() > 3.5


def test_the_standard_error_is_bounded_and_never_shapes_the_network() -> None:
    network = lived_in(TouchNetwork())
    *_, sigma_n = network.train()(*inputs())
    assert sigma_n.min() > 0.02 and sigma_n.max() <= 3.5
    sigma_n.sum().backward()
    assert [name for name, p in network.named_parameters() if p.grad is not None and p.grad.any()] == ["spread.weight", "spread.bias"]


def test_a_network_without_memory_judges_every_frame_of_a_film_alone() -> None:
    network = lived_in(TouchNetwork())
    hidden = torch.rand(2, 5, 128)
    assert torch.equal(network.film(hidden), network.stills(hidden))
    assert len(network(*inputs())) == 3


def test_a_network_that_remembers_steps_through_a_film_as_it_was_trained() -> None:
    network = lived_in(TouchNetwork(remembers=True))
    patch, polar = inputs(4)
    with torch.no_grad():
        hidden = network.embed(patch, polar)[None]
        trained = torch.stack(network.decide(network.film(hidden)), -1)[0]
        memory, stepped = torch.zeros(1, 128), []
        for k in range(4):
            *told, memory = network(patch[k : k + 1], polar[k : k + 1], memory)
            stepped.append(torch.stack(told, -1)[0])
        alone = torch.stack(network(patch, polar), -1)
    torch.testing.assert_close(torch.stack(stepped), trained, atol=1e-5, rtol=1e-4)
    torch.testing.assert_close(alone[0], trained[0], atol=1e-5, rtol=1e-4)
    assert (alone[1:, 0] - trained[1:, 0]).abs().min() > 1e-4


def test_the_fast_layout_trains_without_changing_the_outputs() -> None:
    network = lived_in(TouchNetwork())
    with torch.no_grad():
        expected = network(*inputs())
        got = network.use_fast_layout()(*inputs())
    for e, g in zip(expected, got, strict=True):
        torch.testing.assert_close(g, e, atol=1e-4, rtol=1e-4)
    sum(output.sum() for output in network.train()(*inputs())).backward()
    assert all(p.grad is not None and torch.isfinite(p.grad).all() for p in network.parameters())
