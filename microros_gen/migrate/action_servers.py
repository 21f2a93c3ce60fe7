# SPDX-License-Identifier: Apache-2.0
"""The calls of action servers → the actions of each node, with their goals at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.c_values import TypeSupport, Unknown, Values, handle_of
from microros_gen.migrate.draft import DraftAction, Remark
from microros_gen.migrate.rclc_calls import FoundNode
from microros_gen.records import dataclass

_OPENS = "rclc_action_server_init_default"
_ADDS = "rclc_executor_add_action_server"


@dataclass(frozen=True)
class FoundAction:
    """An action server, and the variable with its node."""

    node: str
    draft: DraftAction


def find_actions(calls: Iterable[Call], values: Values) -> list[FoundAction]:
    """Return the servers in the order of the sources; one that is opened again is there once."""
    calls = list(calls)
    found: dict[tuple[str, str], FoundAction] = {}
    for call in calls:
        if call.name == _OPENS and len(call.arguments) == 5:
            action = _action(call, calls, values)
            found.setdefault((action.node, action.draft.name or str(call.span)), action)
    return list(found.values())


def actions_of(
    index: int, nodes: Sequence[FoundNode], actions: Iterable[FoundAction]
) -> tuple[DraftAction, ...]:
    """Return the actions of a node: those with its variable, and of the first one those with no other's."""
    handles = [node.handle for node in nodes]
    return tuple(
        action.draft
        for action in actions
        if (handles.index(action.node) if action.node in handles else 0) == index
    )


def _action(call: Call, calls: Iterable[Call], values: Values) -> FoundAction:
    remarks: list[Remark] = []
    if call.token.condition:
        remarks.append(Remark(f"only with `{call.token.condition}`", call.span, undecided=False))
    name = values.text(call.arguments[4], call)
    if isinstance(name, Unknown):
        remarks.append(Remark(f"the name of the action: {name.reason}", call.span))
    support = values.type_support(call.arguments[3], call)
    if isinstance(support, Unknown):
        remarks.append(Remark(f"the type of the action: {support.reason}", call.span))
    elif support.kind != "action":
        remarks.append(Remark(f"the type of the action is {support}", call.span))
        support = Unknown("")
    draft = DraftAction(
        name if isinstance(name, str) else "",
        str(support) if isinstance(support, TypeSupport) else "",
        _goals(handle_of(call.arguments[0]), calls, values, remarks),
        call.span,
        tuple(remarks),
    )
    return FoundAction(handle_of(call.arguments[1]), draft)


def _goals(handle: str, calls: Iterable[Call], values: Values, remarks: list[Remark]) -> int:
    """Return how many goals the executor runs at once for a server; 1, with a remark, where this is not known."""
    for call in calls:
        if call.name == _ADDS and len(call.arguments) > 2 and handle_of(call.arguments[1]) == handle:
            goals = values.number(call.arguments[2], call)
            if isinstance(goals, int):
                return goals
            remarks.append(Remark(f"how many goals there are at once: {goals.reason}", call.span))
    return 1
