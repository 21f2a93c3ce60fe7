# SPDX-License-Identifier: Apache-2.0
"""The parameters of one node: what is held, and how that and what the node has are brought together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from microros_gen.parameter_server.declared import Declared
from microros_gen.parameter_server.values import ParameterValue, value_of
from microros_gen.ros.endpoints import Value

UNCHANGED, DECLARED, CHANGED, DELETED = range(4)
"""`change` of microros_parameter_msgs/msg/HeldParameter."""
KEPT_ASIDE = 8
"""Values of one name that are kept aside."""


@dataclass
class Held:
    """A parameter. `written`: when its value was last set by anybody, in seconds since 1970.

    `pending`: the node does not have the value yet.
    """

    declared: Declared
    value: ParameterValue
    written: float
    pending: bool = False


@dataclass
class Merged:
    """What is to be done after a merge: values that the node gets, and an event for all others."""

    push: list[tuple[str, ParameterValue]] = field(default_factory=list)
    new: list[Value] = field(default_factory=list)
    changed: list[Value] = field(default_factory=list)
    deleted: list[Value] = field(default_factory=list)

    @property
    def has_event(self) -> bool:
        """Return whether others are to be told."""
        return bool(self.new or self.changed or self.deleted)


class HeldNode:
    """Not thread-safe. `log` gets a line about each value that is not used any longer."""

    def __init__(self, name: str, clock: Callable[[], float], log: Callable[[str], object]) -> None:
        """`name` is fully qualified; `clock` gives seconds since 1970."""
        self.name = name
        self.parameters: dict[str, Held] = {}
        self.aside: dict[str, list[ParameterValue]] = {}
        """Values that no declaration takes, the last one first: that of other firmware may take them again."""
        self._clock = clock
        self._log = log
        self._of_node: dict[str, ParameterValue] = {}

    def refusal(self, name: str, value: ParameterValue) -> str:
        """Return why a request may not set a parameter; empty: it may, as far as is known here."""
        if not name:
            return "parameter name must not be empty"
        held = self.parameters.get(name)
        if held is None:
            return f"parameter '{name}' cannot be set because it was not declared"
        return held.declared.refusal_of_request(value)

    def hold(self, name: str, value: ParameterValue, pending: bool) -> None:
        """Set a known parameter to a value that was not refused."""
        held = self.parameters[name]
        held.value, held.written, held.pending = value, self._clock(), pending

    def pending(self) -> list[tuple[str, ParameterValue]]:
        """Return what the node does not have yet."""
        return [(name, held.value) for name, held in self.parameters.items() if held.pending]

    def has(self, name: str, value: ParameterValue) -> None:
        """Note that the node has a value now."""
        held = self.parameters.get(name)
        if held is not None and held.value.same(value):
            held.pending = False

    def refused(self, name: str, value: ParameterValue, reason: str) -> Value | None:
        """Note that the node refused a value that was held for it; return the parameter if its value changes so."""
        held, own = self.parameters.get(name), self._of_node.get(name)
        if held is None or own is None or not held.value.same(value):
            return None
        self._log(f"{self.name}: {name}: the node refuses {value} ({reason}) and keeps {own}")
        held.value, held.pending = own, False
        return parameter(name, own)

    def merge(self, items: Iterable[Mapping[str, Any]], complete: bool) -> Merged:
        """Bring together what is held and what the node has, which is all of it where `complete`."""
        merged, seen = Merged(), set()
        for item in items:
            seen.add(item["descriptor"]["name"])
            self._merge(item, merged)
        for name in [name for name in self.parameters if complete and name not in seen]:
            held = self.parameters.pop(name)
            self._set_aside(name, held.value, "the node does not declare it any longer")
            merged.deleted.append(parameter(name, held.value))
        return merged

    def _merge(self, item: Mapping[str, Any], merged: Merged) -> None:
        declared, own, change = Declared.of(item), value_of(item["value"]), item["change"]
        name = declared.name
        held = self.parameters.get(name)
        if change == DELETED:
            if held is not None:
                merged.deleted.append(parameter(name, self.parameters.pop(name).value))
            return
        self._of_node[name] = own
        before = None if held is None else held.value
        if held is not None and (reason := declared.refusal(held.value)):
            self._set_aside(name, held.value, reason)
            held = None
        age_s = item["age"] / 1000 if change == CHANGED else None
        if held is None:
            held = self._new(declared, own, age_s)
        else:
            held.declared = declared
            self._decide(held, own, change, age_s)
        self.parameters[name] = held
        if held.pending:
            merged.push.append((name, held.value))
        if before is None:
            merged.new.append(parameter(name, held.value))
        elif not before.same(held.value):
            merged.changed.append(parameter(name, held.value))

    def _new(self, declared: Declared, own: ParameterValue, age_s: float | None) -> Held:
        """Return the parameter with the node's value, or with one of before that it takes again."""
        kept = self.aside.get(declared.name, [])
        written = self._clock() - (age_s or 0)
        old = next((value for value in kept if not declared.refusal(value)), None)
        if old is None or age_s is not None or declared.read_only:
            return Held(declared, own, written)
        kept.remove(old)
        self._log(f"{self.name}: {declared.name}: the value {old}, which was kept aside, is used again")
        return Held(declared, old, written, pending=not old.same(own))

    def _decide(self, held: Held, own: ParameterValue, change: int, age_s: float | None) -> None:
        """Let the last writer win; one that set the same value overrules nobody."""
        if held.value.same(own):
            held.pending = False
            return
        now = self._clock()
        held_age_s = max(0.0, now - held.written)
        if held.declared.read_only:
            wins = False
        elif age_s is None:
            wins = held.pending or change == DECLARED
        else:
            wins = held.pending and held_age_s < age_s
        if age_s is not None or not wins:
            texts = (f"the node's {own}{_ago(age_s)}", f"{held.value}{_ago(held_age_s)}")
            loser, winner = texts if wins else reversed(texts)
            self._log(f"{self.name}: {held.declared.name}: {loser} is overruled by {winner}")
        if wins:
            held.pending = True
            return
        held.value, held.pending = own, False
        held.written = now - (age_s or 0)

    def _set_aside(self, name: str, value: ParameterValue, reason: str) -> None:
        others = [kept for kept in self.aside.get(name, []) if not kept.same(value)]
        self.aside[name] = [value, *others][:KEPT_ASIDE]
        self._log(f"{self.name}: {name}: the value {value} is kept aside: {reason}")


def parameter(name: str, value: ParameterValue) -> Value:
    """Return an rcl_interfaces/msg/Parameter."""
    return {"name": name, "value": value.message()}


def _ago(age_s: float | None) -> str:
    return "" if age_s is None else f", set {age_s:.1f} s ago"
