from __future__ import annotations

import pytest

from tests.support.finger import ScriptedFinger
from tests.support.gestures import new_finger


@pytest.fixture
def finger() -> ScriptedFinger:
    return new_finger()
