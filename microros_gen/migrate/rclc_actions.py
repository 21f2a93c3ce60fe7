# SPDX-License-Identifier: Apache-2.0
"""The calls of action servers and clients → the actions of each node, with their goals at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.c_values import TypeSupport, Unknown, Values, handle_of
from microros_gen.migrate.draft import DraftAction, Remark
from microros_gen.migrate.rclc_calls import FoundNode
from microros_gen.records import dataclass


@dataclass(frozen=True)
class _Calls:
    """The functions of servers, or of clients; `opens` has so many arguments, the last two are type and name."""

    opens: str
    arguments: int
    adds: str
    is_client: bool


_CALLS = (
    _Calls("rclc_action_server_init_default", 5, "rclc_executor_add_action_server", is_client=False),
    _Calls("rclc_action_client_init_default", 4, "rclc_executor_add_action_client", is_client=True),
)


@dataclass(frozen=True)
class FoundAction:
    """An action server or client, and the variable with its node."""

    node: str
    draft: DraftAction


def find_actions(calls: Iterable[Call], values: Values) -> list[FoundAction]:
    """Return servers and clients in the order of the sources; one that is opened again is there once."""
    calls = list(calls)
    found: dict[tuple[str, str, bool], FoundAction] = {}
    for call in calls:
        for kind in _CALLS:
            if call.name == kind.opens and len(call.arguments) == kind.arguments:
                action = _action(call, kind, calls, values)
                key = (action.node, action.draft.name or str(call.span), kind.is_client)
                found.setdefault(key, action)
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


def _action(call: Call, kind: _Calls, calls: Iterable[Call], values: Values) -> FoundAction:
    remarks: list[Remark] = []
    if call.token.condition:
        remarks.append(Remark(f"only with `{call.token.condition}`", call.span, undecided=False))
    name = values.text(call.arguments[-1], call)
    if isinstance(name, Unknown):
        remarks.append(Remark(f"the name of the action: {name.reason}", call.span))
    support = values.type_support(call.arguments[-2], call)
    if isinstance(support, Unknown):
        remarks.append(Remark(f"the type of the action: {support.reason}", call.span))
    elif support.kind != "action":
        remarks.append(Remark(f"the type of the action is {support}", call.span))
        support = Unknown("")
    draft = DraftAction(
        name if isinstance(name, str) else "",
        str(support) if isinstance(support, TypeSupport) else "",
        _goals(handle_of(call.arguments[0]), kind, calls, values, remarks),
        kind.is_client,
        call.span,
        tuple(remarks),
    )
    return FoundAction(handle_of(call.arguments[1]), draft)


def _goals(handle: str, kind: _Calls, calls: Iterable[Call], values: Values, remarks: list[Remark]) -> int:
    """Return how many goals the executor runs at once; 1, with a remark, where this is not known."""
    for call in calls:
        if call.name == kind.adds and len(call.arguments) > 2 and handle_of(call.arguments[1]) == handle:
            goals = values.number(call.arguments[2], call)
            if isinstance(goals, int):
                return goals
            remarks.append(Remark(f"how many goals there are at once: {goals.reason}", call.span))
    return 1
