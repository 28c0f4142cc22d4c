"""`egotouch simulate` as a server: the options that fit together, and the ones that do not."""

from __future__ import annotations

from typing import Any

import pytest

from egotouch_sdk.cli import serve
from egotouch_sdk.cli.main import main


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The options that reach `egotouch serve` in place of a server that would run until Ctrl-C."""
    taken: list[Any] = []
    monkeypatch.setattr(serve, "run", lambda options: taken.append(options) or 0)
    return taken


def test_without_a_script_the_page_is_served_and_opened(served: list[Any]) -> None:
    assert main(["simulate", "--port", "0", "--fps", "90"]) == 0
    (options,) = served
    assert (options.source, options.port, options.fps, options.browser, options.once) == (serve.SIMULATOR, 0, 90.0, True, False)


def test_a_script_is_served_over_and_over(served: list[Any]) -> None:
    assert main(["simulate", "taps", "--serve", "--no-browser"]) == 0
    (options,) = served
    assert options.source.endswith("taps.yaml")
    assert (options.browser, options.once) == (False, False)


@pytest.mark.parametrize("arguments", [["--json"], ["--fast"], ["taps", "--serve", "--json"]])
def test_what_prints_does_not_serve(arguments: list[str], served: list[Any], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", *arguments]) == 1
    assert "Give a script, without --serve" in capsys.readouterr().err
    assert served == []


def test_the_keypad_is_a_page(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", "--keypad", "--no-page", "--port", "0"]) == 1
    assert "Give one of them" in capsys.readouterr().err
