# SPDX-License-Identifier: Apache-2.0
"""Limits of the messages of a life cycle, whose texts are constants, and the size of a part of a reply."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule, TimerDecl
from microros_gen.client.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER
from microros_gen.client.plan.declared import declarations, full_name
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.client.plan.transport_sizes import most_in_buffer
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

STATES = 11
LONGEST_STATE = len("errorprocessing")
LONGEST_TRANSITION = len("transition_success")
MOST_TRANSITIONS = 3
"""How many leave one state."""
MOST_PART = 64
"""Bytes of a part: it is on the stack while it is sent."""
_SERVICES = 3
"""How many the executor of the application runs, for each node."""
_FRAGMENT_HEADERS = MESSAGE_HEADER + SUBMESSAGE_HEADER
_PACKAGE = "lifecycle_msgs"


@dataclass(frozen=True)
class ManagedPublisher:
    """A publisher of the plan, in its order; `managed` as C writes it."""

    name: str
    managed: str


@dataclass(frozen=True)
class ManagedTimer:
    """A managed timer and the index of its node."""

    name: str
    period_ns: int
    node: int


@dataclass(frozen=True, kw_only=True)
class LifecyclePlan:
    """`part_size`: bytes of ~/get_transition_graph's response that are sent at a time; `handles` of the executor.

    `publishers` has all of the plan; `manages`: one of them is managed. `timers` are those that are managed.
    """

    part_size: int = MOST_PART
    handles: int = _SERVICES
    publishers: tuple[ManagedPublisher, ...] = ()
    manages: bool = False
    timers: tuple[ManagedTimer, ...] = ()
    shown: str = ""


def plan(context: PlanContext, diagnostics: Diagnostics) -> LifecyclePlan:
    """Return the sizes: a part fits the largest message that the transport takes at once."""
    refuse_own_limits(context, "lifecycle", diagnostics)
    runtime = context.runtime
    largest = runtime.streams.mtu
    if runtime.transport.kind == "serial":
        largest = min(largest, most_in_buffer(runtime.transport.send_buffer, context.application))
    application = context.application
    _check_timers(application, diagnostics)
    publishers = declarations(application, "publisher")
    names = [full_name(node, endpoint) for _, node, endpoint in publishers if endpoint.managed]
    timers = tuple(
        ManagedTimer(timer.name, timer.period_us * 1000, index)
        for index, node in enumerate(application.nodes)
        for timer in node.timers
        if timer.managed
    )
    return LifecyclePlan(
        part_size=min(MOST_PART, largest - _FRAGMENT_HEADERS),
        handles=_SERVICES * len(application.nodes),
        publishers=tuple(
            ManagedPublisher(full_name(node, endpoint), "true" if endpoint.managed else "false")
            for _, node, endpoint in publishers
        ),
        manages=bool(names),
        timers=timers,
        shown=", ".join((*names, *(f"timer {timer.name}" for timer in timers))),
    )


def _check_timers(application: Application, diagnostics: Diagnostics) -> None:
    """Report a managed timer whose period another timer has: a timer of the program is recognized by its period."""
    managed: dict[int, tuple[int, TimerDecl]] = {}
    every = [(index, timer) for index, node in enumerate(application.nodes) for timer in node.timers]
    for index, timer in sorted(every, key=lambda item: not item[1].managed):
        first, other = managed.setdefault(timer.period_us, (index, timer))
        if other.managed and (not timer.managed or first != index):
            diagnostics.error(
                f"the timer '{timer.name}' has the period of the managed timer '{other.name}'",
                timer.span,
                "Give them different periods: a timer of the program is recognized by its period",
                id="MG-7051",
            )


def record(part: LifecyclePlan) -> object:
    """Return what the plan id is made of."""
    return {
        "part": part.part_size,
        "managed": [
            part.manages and [p.managed for p in part.publishers],
            [[t.period_ns, t.node] for t in part.timers],
        ],
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged. The whole graph is longer, and goes in fragments."""
    rules = (
        _rule("msg/State", "label", LONGEST_STATE),
        _rule("msg/Transition", "label", LONGEST_TRANSITION),
        _rule("srv/GetAvailableStates_Response", "available_states", None, STATES),
        _rule("srv/GetAvailableTransitions_Response", "available_transitions", None, MOST_TRANSITIONS),
    )
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)


def _rule(name: str, member: str, string: int | None, sequence: int | None = None) -> LimitRule:
    return LimitRule((f"{_PACKAGE}/{name}", member), string, sequence)
