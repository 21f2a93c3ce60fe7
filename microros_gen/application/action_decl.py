# SPDX-License-Identifier: Apache-2.0
"""Actions in the application file, as data."""

from __future__ import annotations

from microros_gen.application.limit_rule import LimitRule
from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class ActionDecl:
    """An action server of a node; `type` is `pkg/action/Type`. `limits`: of goals, results and feedback of the type.

    `goals` are kept at once, ended ones included: their results stay for `result_timeout_ms`. `waiting`: how many
    requests for the result of a goal wait for its end.
    """

    name: str
    type: str
    goals: int = 1
    result_timeout_ms: int = 10_000
    waiting: int = 1
    span: Span | None = None
    type_span: Span | None = None
    limits: tuple[LimitRule, ...] = ()


@dataclass(frozen=True)
class ActionClientDecl:
    """An action client of a node; `type` as above. `limits`: of what this client sends and receives.

    `goals` are under way at once. `response_timeout_ms`: for the response to a goal or a cancel request.
    `result_timeout_ms`: from the acceptance of a goal to its result; 0: as long as it takes.
    """

    name: str
    type: str
    goals: int = 1
    response_timeout_ms: int = 10_000
    result_timeout_ms: int = 0
    span: Span | None = None
    type_span: Span | None = None
    limits: tuple[LimitRule, ...] = ()
