"""Enum values of the SDK and their numbers in the schema; a schema name is the enum's name in front of the member's."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, Generic, TypeVar

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import GateReason
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

E = TypeVar("E", bound=StrEnum)


class EnumTable(Generic[E]):
    """One enum in both directions. Number 0 stands for "not given" and is nobody's."""

    def __init__(self, kind: type[E], prefix: str) -> None:
        numbers = pb.DESCRIPTOR.enum_types_by_name[kind.__name__].values_by_name
        self._name = kind.__name__
        self._numbers: dict[E, int] = {member: numbers[f"{prefix}_{member.name}"].number for member in kind}
        self._members: dict[int, E] = {number: member for member, number in self._numbers.items()}

    def number(self, member: E) -> Any:
        """The number on the wire, an int; generated type hints want a type of their own for each enum."""
        return self._numbers[member]

    def get(self, number: int) -> E | None:
        """The member with this number; None for 0 and for what a newer schema may have added."""
        return self._members.get(number)

    def member(self, number: int) -> E:
        """The member with this number; `ProtocolError` when there is none."""
        found = self._members.get(number)
        if found is None:
            raise ProtocolError(f"there is no {self._name} {number}", hint="Both sides need the same schema version")
        return found


EVENT_TYPES = EnumTable(EventType, "EVENT_TYPE")
FINGERS = EnumTable(Finger, "FINGER")
HANDEDNESS = EnumTable(Handedness, "HANDEDNESS")
SURFACES = EnumTable(Surface, "SURFACE")
CANCEL_REASONS = EnumTable(CancelReason, "CANCEL_REASON")
GATE_REASONS = EnumTable(GateReason, "GATE_REASON")
