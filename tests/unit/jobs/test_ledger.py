"""Any order of success, failure and death: every name ends exactly once."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.jobs.ledger import Failure, Ledger


def test_a_name_is_handed_out_once_and_then_done() -> None:
    ledger = Ledger(["a"], attempts=3)
    assert not ledger.is_over
    assert ledger.next() == "a"
    assert ledger.next() is None
    assert ledger.running == {"a"}
    ledger.finish("a")
    assert ledger.is_over and ledger.done == ["a"] and ledger.failures == []


def test_a_failed_name_waits_behind_the_others_until_it_is_given_up() -> None:
    ledger = Ledger(["a", "b"], attempts=2)
    assert ledger.next() == "a"
    assert ledger.fail("a", "first")
    assert ledger.next() == "b"
    assert ledger.next() == "a"
    assert not ledger.fail("a", "second")
    ledger.finish("b")
    assert ledger.is_over and ledger.done == ["b"] and ledger.failures == [Failure("a", "second", 2)]


def test_what_was_refused_is_not_tried_again() -> None:
    ledger = Ledger(["a"], attempts=9)
    ledger.next()
    assert not ledger.fail("a", "no data", retry=False)
    assert ledger.failures == [Failure("a", "no data", 1)]


def test_a_second_report_is_a_defect() -> None:
    ledger = Ledger(["a"], attempts=1)
    ledger.next()
    ledger.finish("a")
    with pytest.raises(KeyError):
        ledger.finish("a")


@given(st.integers(0, 12), st.integers(1, 4), st.integers(1, 5), st.randoms(use_true_random=False))
def test_every_name_ends_exactly_once(count: int, attempts: int, slots: int, dice: object) -> None:
    names = [str(number) for number in range(count)]
    ledger, tried = Ledger(names, attempts), dict.fromkeys(names, 0)
    while not ledger.is_over:
        while len(ledger.running) < slots and (name := ledger.next()) is not None:
            tried[name] += 1
        assert ledger.running
        name = dice.choice(sorted(ledger.running))  # type: ignore[attr-defined]
        if dice.random() < 0.5:  # type: ignore[attr-defined]
            ledger.finish(name)
        else:
            ledger.fail(name, "broken")
    assert sorted([*ledger.done, *(failure.name for failure in ledger.failures)]) == sorted(names)
    assert all(1 <= tries <= attempts for tries in tried.values())
    assert all(failure.attempts == attempts == tried[failure.name] for failure in ledger.failures)
