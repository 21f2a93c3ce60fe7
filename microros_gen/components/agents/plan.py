# SPDX-License-Identifier: Apache-2.0
"""The agents of a client, and how long each is tried."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.records import dataclass

TRIED_ROUND_TRIPS = 3
"""How long an agent is tried, in `session: {round_trip}`, where `connect_timeout` is long enough for all of them."""


@dataclass(frozen=True)
class AgentPlan:
    """Address in digits, and port."""

    host: str
    port: int

    @property
    def place(self) -> str:
        """Return the address as the application file has it."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"


@dataclass(frozen=True, kw_only=True)
class AgentsPlan:
    """The agents in the order in which they are tried. `try_ms`: milliseconds until the next one is tried."""

    declared: tuple[AgentPlan, ...]
    try_ms: int

    @property
    def count(self) -> int:
        """Return the number of agents."""
        return len(self.declared)

    @property
    def shown(self) -> str:
        """Return what a report says."""
        return ", ".join(agent.place for agent in self.declared)


def plan(context: PlanContext, diagnostics: Diagnostics) -> AgentsPlan:
    """Return the list; a selection that cannot change its agent is an error."""
    transport = context.application.transport
    for message, hint, id in _refusals(context):
        diagnostics.error(message, _place(context), hint, id=id)
    times = context.runtime.times
    each = times.connect_timeout_ms // max(1, len(transport.agents))
    try_ms = max(times.retry_first_ms, min(TRIED_ROUND_TRIPS * times.retry_first_ms, each))
    return AgentsPlan(declared=tuple(AgentPlan(*agent) for agent in transport.agents), try_ms=try_ms)


def _place(context: PlanContext) -> Span | None:
    application = context.application
    return application.transport.agent_span or application.spans.get("components")


def _refusals(context: PlanContext) -> Iterator[tuple[str, str, str]]:
    """Yield message, hint and id of what contradicts several agents."""
    selection = context.selection
    if not context.application.transport.agents:
        message = "the component 'agents' is for several agents, and the application has one"
        yield message, 'Write `transport: {agents: ["192.168.1.10:8888", "192.168.1.11:8888"]}`', "MG-7180"
    elif selection.transport not in ("udp", "tcp"):
        message = f"transport: {selection.transport} has no agent addresses"
        yield message, "Remove `agents`, or use type: udp or tcp", "MG-7181"
    elif selection.liveliness == "none" and selection.transport == "udp":
        message = (
            "several agents contradict 'liveliness: none': the client does not notice that its agent is gone"
        )
        yield message, "Write `liveliness: ping`, or use type: tcp", "MG-7182"
    elif selection.has("sleep_cycles"):
        message = (
            "several agents contradict the component 'sleep_cycles': a session is resumed at its own agent"
        )
        yield message, "Write one `agent`, or drop it: `components: [-sleep_cycles]`", "MG-7183"


def record(part: AgentsPlan) -> object:
    """Return what the plan id is made of."""
    return [[agent.place for agent in part.declared], part.try_ms]
