"""What holds for the recogniser and its tables as a whole."""

from __future__ import annotations

import pytest

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.errors import GrammarError
from egotouch_sdk.gestures import GestureRecognizer
from egotouch_sdk.gestures.table import DRAG, FORCE, PRESS, DragInput, DragState, ForceInput, ForceState, PressInput, PressState
from tests.support.events import make_event
from tests.support.gestures import MOVE


def test_a_move_without_a_down_is_refused() -> None:
    with pytest.raises(GrammarError, match="move of pointer 1 comes without a down"):
        GestureRecognizer(GestureConfig()).feed([make_event(MOVE)])


def test_the_tables_know_every_input_of_every_state() -> None:
    for table, states, inputs in ((DRAG, DragState, DragInput), (FORCE, ForceState, ForceInput), (PRESS, PressState, PressInput)):
        for state in states:
            known = {cause for where, cause in table if where is state}
            missing = set(inputs) - known
            if state is PressState.NONE:
                assert known == {PressInput.LANDED, PressInput.FOUND}
            elif states is PressState:
                assert missing == {PressInput.LANDED, PressInput.FOUND}
            else:
                assert missing == ({ForceInput.STEADY} if state is ForceState.SOFT else set())
