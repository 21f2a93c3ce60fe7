# SPDX-License-Identifier: Apache-2.0
"""The declared types of actions, and what a goal's handle has room for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from microros_gen.application.action_decl import ActionClientDecl, ActionDecl
from microros_gen.application.kinds import NAMES
from microros_gen.application.limit_rule import LimitRule
from microros_gen.client.plan.declared import declarations, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.derived import ACTION_PARTS, derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name, include_path, type_files


@dataclass(frozen=True)
class ActionType:
    """A type: `name` begins its C names, the others are DDS names of itself and of its services."""

    name: str
    header: str
    dds_type: str
    send_goal: str
    get_result: str


class ActionEnd(Protocol):
    """A server or client of an action."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def goals(self) -> int: ...  # noqa: D102


class ActionEnds:
    """What is counted of the servers, or of the clients, of a plan."""

    @property
    def ends(self) -> Sequence[ActionEnd]:
        """Return them in the order of the file."""
        raise NotImplementedError

    @property
    def count(self) -> int:
        """Return their number."""
        return len(self.ends)

    @property
    def goals(self) -> int:
        """Return the number of goals of all of them."""
        return sum(end.goals for end in self.ends)

    @property
    def shown(self) -> str:
        """Return each action with its goals."""
        return ", ".join(f"{end.name} ({end.goals} at once)" for end in self.ends)


@dataclass(frozen=True, kw_only=True)
class ActionsPlan:
    """`types` by name; `result_requests` for one goal wait for its end."""

    types: tuple[ActionType, ...]
    result_requests: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> ActionsPlan:
    """Return the types that nodes declare; without servers one request has room, since a C array has an element."""
    del diagnostics
    nodes = context.application.nodes
    declared = [action for node in nodes for action in node.actions]
    every = {type_name(action.type) for action in declared}
    every |= {type_name(action.type) for node in nodes for action in node.action_clients}
    return ActionsPlan(
        types=tuple(_type(name) for name in sorted(every)),
        result_requests=max((action.waiting for action in declared), default=1),
    )


def own_limits(declared: Iterable[ActionDecl | ActionClientDecl]) -> tuple[LimitRule, ...]:
    """Return the limits that servers or clients declare, for the messages of their types; of two ends the larger."""
    found: dict[tuple[str, ...], LimitRule] = {}
    for action in declared:
        for rule in action.limits:
            for part in ACTION_PARTS:
                path = (f"{action.type}_{part}",)
                before = found.get(path, LimitRule(path))
                found[path] = LimitRule(
                    path,
                    max((n for n in (before.string, rule.string) if n is not None), default=None),
                    max((n for n in (before.sequence, rule.sequence) if n is not None), default=None),
                    rule.span,
                )
    return tuple(found.values())


def _type(name: TypeName) -> ActionType:
    return ActionType(
        c_name(name),
        include_path(type_files(name).header),
        dds_type(name),
        dds_type(derived_name(name, "SendGoal")),
        dds_type(derived_name(name, "GetResult")),
    )


def record(part: ActionsPlan) -> object:
    """Return what the plan id is made of."""
    return {"types": [kind.name for kind in part.types], "result_requests": part.result_requests}


def place_of(context: PlanContext, node: int, kind: str, name: str) -> int:
    """Return the position of an endpoint of an action in the table of declared endpoints.

    A kind has at least one place there, even where nothing of it is declared.
    """
    before = [context.runtime.entities.places(other).max for other in NAMES[: NAMES.index(kind)]]
    for index, (owner, _, endpoint) in enumerate(declarations(context.application, kind)):
        if (owner, endpoint.topic) == (node, name) and endpoint.of_the_library:
            return sum(before) + index
    raise KeyError(name)
