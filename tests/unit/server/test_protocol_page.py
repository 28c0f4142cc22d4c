"""The page for people who write clients says what the server does."""

from __future__ import annotations

import re
from pathlib import Path

from egotouch_sdk.listeners.merging import MAX_COALESCED
from egotouch_sdk.server.close_code import CloseCode
from egotouch_sdk.server.headset_source import HeadsetSource
from egotouch_sdk.server.headset_target import HeadsetTarget
from egotouch_sdk.server.limits import Limits
from egotouch_sdk.server.metrics import DROPS, Metrics
from egotouch_sdk.server.publication import Publication

PAGE = (Path(__file__).parents[3] / "proto" / "PROTOCOL.md").read_text(encoding="utf-8")


def test_every_close_code_is_in_the_table_with_its_answer() -> None:
    rows = {int(code): (name, answer) for code, name, answer in re.findall(r"^\| (\d+) \| `(\w+)` \| (yes|no) \|", PAGE, re.MULTILINE)}
    assert rows == {int(code): (code.name, "yes" if code.reconnect else "no") for code in CloseCode}


def test_its_numbers_are_the_servers() -> None:
    limits = Limits()
    assert f"Within {limits.hello_timeout_ns // 10**9} s it sends **Hello**" in PAGE
    assert f"{limits.commands_per_s} a second, {limits.command_burst} at once" in PAGE
    assert f"waited longer than {limits.input_ttl_ns // 10**6} ms" in PAGE
    assert f"({limits.journal_edges} edges, {limits.journal_ns // 10**9} s)" in PAGE
    assert f"at most {MAX_COALESCED} of them" in PAGE


def test_every_metric_is_in_the_table() -> None:
    metrics = Metrics()
    metrics.more += [HeadsetTarget(HeadsetSource()).lines, Publication("lab").lines]
    served = set(re.findall(r"^# TYPE (\w+) ", metrics.text(), re.MULTILINE))
    told = set(re.findall(r"`(egotouch_\w+)(?:\{\w+\})?`", PAGE.partition("## Watching a server")[2]))
    assert told == served
    assert all(f"`{name}`:" in PAGE for name in DROPS)
