"""Which of Mitsuba's variants renders."""

import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.synthetic import render

choose = render.mitsuba.__wrapped__


def test_an_unknown_renderer_is_refused_with_those_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(render.RENDERER_VARIABLE, "cuda")
    with pytest.raises(ConfigError, match="cuda") as refused:
        choose()
    assert "gpu, llvm, scalar" in str(refused.value.hint)


def test_a_gpu_that_is_not_there_is_refused_and_not_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("mitsuba")
    if render._sees_gpu():
        pytest.skip("there is an NVIDIA GPU here")
    monkeypatch.setenv(render.RENDERER_VARIABLE, "gpu")
    with pytest.raises(ConfigError, match="does not run here"):
        choose()


def test_the_chosen_renderer_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    mi = pytest.importorskip("mitsuba")
    before = mi.variant()
    monkeypatch.setenv(render.RENDERER_VARIABLE, "scalar")
    try:
        assert choose().variant() == "scalar_rgb"
    finally:
        if before:
            mi.set_variant(before)
