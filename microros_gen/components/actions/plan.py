# SPDX-License-Identifier: Apache-2.0
"""What a goal's handle has room for."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True, kw_only=True)
class ActionsPlan:
    """`result_requests` for one goal wait for its end."""

    result_requests: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> ActionsPlan:
    """Return the largest number of a server; without servers 1, since a C array has an element."""
    del diagnostics
    waiting = (action.waiting for node in context.application.nodes for action in node.actions)
    return ActionsPlan(result_requests=max(waiting, default=1))


def record(part: ActionsPlan) -> object:
    """Return what the plan id is made of."""
    return {"result_requests": part.result_requests}
