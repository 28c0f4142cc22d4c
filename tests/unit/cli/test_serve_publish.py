"""`egotouch serve --publish`: what is refused before anything is served."""

from __future__ import annotations

import pytest

from egotouch_sdk.cli.main import main


@pytest.mark.parametrize("arguments", [["--session", "booth"], ["--publish-json"]])
def test_options_about_publishing_need_a_server(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "simulator", "--port", "0", *arguments]) == 1
    assert "Add --publish nats://host:4222" in capsys.readouterr().err


def test_an_address_that_is_none_is_refused_without_showing_its_password(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "simulator", "--port", "0", "--publish", "http://me:hush@hub"]) == 1
    said = capsys.readouterr()
    assert "Write nats://host:4222" in said.err and "hush" not in said.err + said.out


def test_the_help_names_subjects_and_credentials(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["serve", "--help"])
    said = capsys.readouterr().out
    assert "egotouch.v1.SESSION.SURFACE.TYPE" in said and "EGOTOUCH_NATS_CREDENTIALS" in said and "ClientFrame" in said
