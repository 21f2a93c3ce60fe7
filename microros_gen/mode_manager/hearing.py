# SPDX-License-Identifier: Apache-2.0
"""What answers, events and silence say of a leaf."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.mode_manager.calls import (
    ACTIVATE,
    CLEANUP,
    COMMANDS,
    CONFIGURE,
    DEACTIVATE,
    Call,
    Kind,
    Link,
    Values,
)
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import ACTIVE, INACTIVE, UNCONFIGURED, UNKNOWN, Scalar

_GOALS = {CONFIGURE: INACTIVE, CLEANUP: UNCONFIGURED, ACTIVATE: ACTIVE, DEACTIVATE: INACTIVE}
_PASSING = {
    CONFIGURE: {"configuring", INACTIVE, UNCONFIGURED},
    CLEANUP: {"cleaningup", UNCONFIGURED, INACTIVE},
    ACTIVATE: {"activating", ACTIVE, INACTIVE},
    DEACTIVATE: {"deactivating", INACTIVE, ACTIVE},
}
SILENT = "it does not answer"


def hear_link(leaf: Leaf, link: Link, serves_parameters: bool = False) -> None:
    """Note how the part is reached from now on; ABSENT: it has left."""
    leaf.link, leaf.call, leaf.mode = link, None, ""
    leaf.serves_parameters, leaf.has_known_values = serves_parameters, False
    leaf.is_mode_late = False
    leaf.state = ACTIVE if link is Link.PLAIN else UNKNOWN
    leaf.values.clear()
    leaf.expected.clear()
    leaf.doubts.clear()
    leaf.unanswered = 0
    leaf.settle_until = 0.0
    leaf.stale = set() if link is Link.ABSENT else leaf.queries


def hear_state(leaf: Leaf, state: str, now: float, settings: Settings, by_event: bool) -> None:
    """Note a state. Events of own commands may be late: what they contradict is asked."""
    if by_event and _is_own(leaf, now, settings):
        if state not in leaf.expected:
            leaf.doubts.add(Kind.GET_STATE)
        return
    if state == ACTIVE and leaf.state != ACTIVE and leaf.link in (Link.MODES, Link.SYSTEM):
        leaf.mode = ""
        leaf.stale.add(Kind.GET_MODE)
    if leaf.state == ACTIVE and state != ACTIVE:
        leaf.mode = ""
    leaf.state = state
    if not by_event:
        leaf.stale.discard(Kind.GET_STATE)


def hear_mode(leaf: Leaf, mode: str, now: float, settings: Settings, by_event: bool) -> None:
    """Note the mode that a part with mode services reports."""
    if by_event and _is_own(leaf, now, settings) and mode != leaf.mode:
        leaf.doubts.add(Kind.GET_MODE)
        return
    if mode != leaf.mode and leaf.reports_values:
        leaf.has_known_values = False
        leaf.stale.add(Kind.GET_PARAMETERS)
    leaf.mode = mode
    leaf.stale.discard(Kind.GET_MODE)


def hear_parameters(
    leaf: Leaf,
    values: Mapping[str, Scalar | tuple[Scalar, ...] | None],
    now: float,
    settings: Settings,
    by_event: bool,
) -> None:
    """Note values of parameters of the modes; None: the parameter does not exist."""
    own = {name: value for name, value in values.items() if name in leaf.parameters}
    if by_event and own and _is_own(leaf, now, settings):
        if any(leaf.values.get(name) != value for name, value in own.items()):
            leaf.doubts.add(Kind.GET_PARAMETERS)
        return
    if by_event and leaf.reports_values:
        _doubt_values(leaf, own)
        return
    for name, value in own.items():
        if value is None:
            leaf.values.pop(name, None)
        else:
            leaf.values[name] = value
    if not by_event:
        leaf.stale.discard(Kind.GET_PARAMETERS)
        leaf.has_known_values = True


def _doubt_values(leaf: Leaf, values: Values) -> None:
    """Ask one that reports its mode for both: a device may set values because it changes its mode."""
    if any(leaf.values.get(name) != value for name, value in values.items()):
        leaf.stale |= {Kind.GET_MODE, Kind.GET_PARAMETERS}


def hear_success(leaf: Leaf, call: Call, now: float, settings: Settings) -> None:
    """Note that a command was carried out; one to a system was accepted."""
    if leaf.link is Link.SYSTEM and call.kind is not Kind.SET_PARAMETERS:
        leaf.settle_until = now + settings.system_s
        return
    if call.kind is Kind.CHANGE_STATE:
        _hear_transition(leaf, call.transition)
        return
    if call.kind is Kind.CHANGE_MODE:
        leaf.mode = call.mode
    leaf.values.update({name: value for name, value in call.values.items() if value is not None})
    if leaf.reports_values:
        leaf.doubts.add(Kind.GET_PARAMETERS)


def _hear_transition(leaf: Leaf, transition: int) -> None:
    """Note a transition that was carried out. `mode` of an inactive node is the one that it got while inactive."""
    leaf.state = _GOALS[transition]
    if transition != ACTIVATE:
        leaf.mode = ""
        return
    leaf.reconfigures = False
    if leaf.link is Link.MODES and leaf.mode:
        leaf.doubts.add(Kind.GET_MODE)  # a node may forget it when it is activated
    elif leaf.link is Link.MODES and leaf.restores:
        leaf.stale.add(Kind.GET_MODE)


def hear_refusal(leaf: Leaf, call: Call, reason: str, now: float, settings: Settings) -> None:
    """Note that a command was refused; what the part is now has to be asked."""
    is_inactive = leaf.state == INACTIVE
    leaf.stale |= leaf.queries
    if call.kind in (Kind.SET_PARAMETERS, Kind.CHANGE_MODE) and leaf.reconfigures and is_inactive:
        leaf.restores = True
        return
    if call.kind is Kind.CHANGE_MODE and is_inactive and leaf.name not in settings.reconfigured:
        leaf.is_mode_late = True
        return
    text = f"it refuses {call}"
    _count(leaf, f"{text}: {reason}" if reason else text, now, settings)


def hear_silence(leaf: Leaf, call: Call, now: float, settings: Settings) -> None:
    """Note that a response is late. What was commanded may happen nevertheless."""
    leaf.stale |= leaf.queries
    leaf.unanswered += 1
    if call.kind in COMMANDS:
        _count(leaf, f"it answers {call} late", now, settings)
    elif leaf.unanswered >= settings.attempts:
        leaf.state = ACTIVE if leaf.link is Link.PLAIN else UNKNOWN
        leaf.failure = SILENT
        leaf.wait_until = now + settings.poll_s
    else:
        leaf.wait_until = now + settings.pause_s
    leaf.retries += 1


def expect(leaf: Leaf, call: Call) -> None:
    """Note the states that a command leads through."""
    leaf.expected |= _PASSING.get(call.transition, set())


def _count(leaf: Leaf, failure: str, now: float, settings: Settings) -> None:
    leaf.attempts += 1
    leaf.retries += 1
    leaf.wait_until = now + settings.pause_s
    if leaf.attempts >= settings.attempts:
        leaf.failure = failure


def _is_own(leaf: Leaf, now: float, settings: Settings) -> bool:
    """Return whether an event may be one of an own command."""
    return leaf.link is not Link.SYSTEM and (leaf.is_commanded or now - leaf.commanded < settings.grace_s)
