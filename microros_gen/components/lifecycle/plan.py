# SPDX-License-Identifier: Apache-2.0
"""Limits of the messages of a life cycle, whose texts are constants, and the size of a piece of a reply."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.creation import MESSAGE_HEADER, SUBMESSAGE_HEADER
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

STATES = 11
LONGEST_STATE = len("errorprocessing")
LONGEST_TRANSITION = len("transition_success")
MOST_TRANSITIONS = 3
"""How many leave one state."""
MOST_PIECE = 128
"""Bytes of a piece: it is on the stack while it is sent."""
_SERVICES = 3
"""How many the executor of the application runs, for each node."""
_FRAGMENT_HEADERS = MESSAGE_HEADER + SUBMESSAGE_HEADER
_FRAME = 7
"""Bytes of a serial frame around its message: flag, addresses, length, CRC."""
_PACKAGE = "lifecycle_msgs"


@dataclass(frozen=True, kw_only=True)
class LifecyclePlan:
    """`piece_size`: bytes of ~/get_transition_graph's response that are sent at a time; `handles` of the executor."""

    piece_size: int = MOST_PIECE
    handles: int = _SERVICES


def plan(context: PlanContext, diagnostics: Diagnostics) -> LifecyclePlan:
    """Return the sizes: a piece fits the largest message that the transport takes at once."""
    refuse_own_limits(context, "lifecycle", diagnostics)
    runtime = context.runtime
    largest = runtime.streams.mtu
    if runtime.transport.kind == "serial":
        # Each byte but the flag may be stuffed, and one byte of the buffer is never used.
        largest = min(largest, (runtime.transport.send_buffer - 2) // 2 - (_FRAME - 1))
    return LifecyclePlan(
        piece_size=min(MOST_PIECE, largest - _FRAGMENT_HEADERS),
        handles=_SERVICES * len(context.application.nodes),
    )


def record(part: LifecyclePlan) -> object:
    """Return what the plan id is made of."""
    return [part.piece_size]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged. The whole graph is longer, and goes in pieces."""
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
