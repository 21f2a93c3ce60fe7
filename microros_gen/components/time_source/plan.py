# SPDX-License-Identifier: Apache-2.0
"""Where the time of day is from, and how fast it is corrected."""

from __future__ import annotations

from microros_gen.application.time_source import TimeSourceDecl
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

NEVER_US = 9_000_000_000_000_000
"""An error that no time has, 285 years: it is never set. As nanoseconds it has 63 bits."""


@dataclass(frozen=True, kw_only=True)
class TimeSourcePlan:
    """`period_ms` between two questions to the agent; 0: the application has the source."""

    period_ms: int
    slew_ppm: int
    step_us: int
    holdover_ms: int

    @property
    def asks(self) -> bool:
        """Return whether the agent is the source."""
        return self.period_ms > 0

    @property
    def shown(self) -> str:
        """Return what a report says."""
        source = f"the agent, every {_time(self.period_ms)}" if self.asks else "the application"
        return f"{source}, corrected by {self.slew_ppm} ppm at most"


def _time(time_ms: int) -> str:
    return f"{time_ms // 1000} s" if time_ms % 1000 == 0 else f"{time_ms} ms"


def plan(context: PlanContext, diagnostics: Diagnostics) -> TimeSourcePlan:
    """Return the numbers of the application file, whose own checks have reported its faults.

    An agent as the source of an image that has none is an error here: who has one follows from all endpoints.
    """
    declared = context.application.time_source or TimeSourceDecl()
    if declared.asks_agent and _has_no_agent(context):
        spans = context.application.spans
        diagnostics.error(
            "the agent as the source of the time contradicts an image without an agent: nobody would be asked",
            declared.span or spans.get("components") or spans.get("profiles"),
            "Write time_source: {source: application}, or drop the component time_source",
            id="MG-3215",
        )
    return TimeSourcePlan(
        period_ms=declared.period_ms if declared.asks_agent else 0,
        slew_ppm=declared.slew_ppm,
        step_us=declared.step_us or NEVER_US,
        holdover_ms=declared.holdover_ms,
    )


def _has_no_agent(context: PlanContext) -> bool:
    """Return whether the image never has a session: nodes without any endpoint alone do not say that."""
    endpoints = (endpoint for node in context.application.nodes for endpoint in node.endpoints)
    is_alone = bool(context.application.nodes) and not any(e.exists_at_agent for e in endpoints)
    return is_alone and context.selection.has("agentless")


def record(part: TimeSourcePlan) -> object:
    """Return what the plan id is made of."""
    return [part.period_ms, part.slew_ppm, part.step_us, part.holdover_ms]
