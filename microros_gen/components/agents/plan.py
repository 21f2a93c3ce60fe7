# SPDX-License-Identifier: Apache-2.0
"""The agents of a client, and how long each is tried."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.typesupport.views.text import string

_NETWORK, _LINES = ("udp", "tcp"), ("serial",)
_HINTS = {
    **dict.fromkeys(_NETWORK, 'Write addresses such as "192.168.1.10:8888", or use type: serial'),
    **dict.fromkeys(_LINES, "Write devices such as /dev/ttyUSB0, or use type: udp or tcp"),
}
TRIED_ROUND_TRIPS = 3
"""How long an agent is tried, in `session: {round_trip}`, where `connect_timeout` is long enough for all of them."""


@dataclass(frozen=True)
class AgentPlan:
    """Address in digits, and port; or a serial device, and 0."""

    host: str
    port: int

    @property
    def place(self) -> str:
        """Return the address or the device as the application file has it."""
        if not self.port:
            return self.host
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

    @property
    def literal(self) -> str:
        """Return the address or the device as a C string."""
        return string(self.host)


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
    _check_list(context, diagnostics)
    _check_selection(context, diagnostics)
    times = context.runtime.times
    places = (*transport.agents, *((device, 0) for device in transport.devices))
    each = times.connect_timeout_ms // max(1, len(places))
    try_ms = max(times.retry_first_ms, min(TRIED_ROUND_TRIPS * times.retry_first_ms, each))
    return AgentsPlan(declared=tuple(AgentPlan(*place) for place in places), try_ms=try_ms)


def _check_list(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report a component without a list, and a list that the transport or the target cannot use."""
    transport, kind = context.application.transport, context.selection.transport
    if not transport.agents and not transport.devices:
        diagnostics.error(
            "the component 'agents' is for several agents, and the application has one",
            context.application.spans.get("components"),
            'Write `transport: {agents: ["192.168.1.10:8888", "192.168.1.11:8888"]}`',
            id="MG-7180",
        )
    elif kind not in (_NETWORK if transport.agents else _LINES):
        what = "agent addresses" if transport.agents else "serial devices"
        hint = _HINTS.get(kind, "Remove `agents`, or use type: udp or tcp")
        diagnostics.error(f"transport: {kind} has no {what}", transport.agent_span, hint, id="MG-7181")
    elif transport.devices and not context.target.names_lines:
        message = f"the target '{context.target.name}' has one serial line, which leads to one agent"
        diagnostics.error(message, transport.agent_span, "Remove `agents`", id="MG-7257")


def _check_selection(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report a client that does not notice a loss, or that resumes its session."""
    place, selection = context.application.transport.agent_span, context.selection
    if selection.liveliness == "none" and selection.transport != "tcp":
        diagnostics.error(
            "several agents contradict 'liveliness: none': the client does not notice that its agent is gone",
            place,
            "Write `liveliness: ping`",
            id="MG-7182",
        )
    if selection.has("sleep_cycles"):
        diagnostics.error(
            "several agents contradict the component 'sleep_cycles': a session is resumed at its own agent",
            place,
            "Write one `agent`, or drop it: `components: [-sleep_cycles]`",
            id="MG-7183",
        )


def record(part: AgentsPlan) -> object:
    """Return what the plan id is made of."""
    return [[agent.place for agent in part.declared], part.try_ms]
