# SPDX-License-Identifier: Apache-2.0
"""The agent's view of its clients as diagnostic_msgs/msg/DiagnosticArray: a status for each client."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace

from microros_gen.agent.states import ClientState, Presence
from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value
from microros_gen.ros.peer import Peer

TOPIC = "/diagnostics"
TYPE = "diagnostic_msgs/msg/DiagnosticArray"
PREFIX = "agent: client "
PERIOD_S = 1.0
"""Seconds between two messages without a change of a level."""
RECENT_S = 10.0
"""Seconds for which a lost message, a reconnection or a warning is a warning."""
ERROR_TIMEOUTS = 3
"""Client time-outs of silence after which a client is an error."""
OK, WARN, ERROR, STALE = range(4)
"""Levels of diagnostic_msgs/msg/DiagnosticStatus."""
_NS = 1_000_000_000


@dataclass(frozen=True)
class Level:
    """A level and its message."""

    level: int
    message: str


@dataclass(frozen=True)
class _Change:
    """The last change of a client's counts: its message, and when; `state` has the known ones."""

    state: ClientState
    what: str = ""
    at: float = 0.0


def _events(known: ClientState | None, state: ClientState) -> str:
    """Return what has happened to a client between two looks; empty: nothing.

    What a client that is new had before is not known, so that only its losses are reported.
    """
    events = []
    if state.lost != (known.lost if known else 0):
        events.append(f"messages lost: {state.lost}")
    if known is None:
        return ", ".join(events)
    if state.reconnects != known.reconnects:
        events.append("reconnected")
    if state.silences != known.silences:
        events.append("was silent")
    if state.denied != known.denied:
        events.append(f"denied by the policy: {state.denied}")
    if state.last_error != known.last_error:
        events.append(f"new warning: {state.last_error}")
    return ", ".join(events)


class ClientDiagnostics:
    """Levels of clients; remembers when their counts have changed."""

    def __init__(self, timeout_s: float) -> None:
        """`timeout_s`: seconds of silence after which the agent removes a client's entities."""
        self._timeout_s = timeout_s
        self._changes: dict[str, _Change] = {}

    def levels(self, states: Iterable[ClientState], now: float) -> dict[str, Level]:
        """Return the level of each client by its key; `now`: seconds of a clock that never goes back."""
        changes = {state.key: self._change(state, now) for state in states}
        self._changes = changes
        return {state.key: self._level(state, changes[state.key], now) for state in states}

    def _change(self, state: ClientState, now: float) -> _Change:
        known = self._changes.get(state.key)
        events = _events(known.state if known else None, state)
        return replace(known, state=state) if known and not events else _Change(state, events, now)

    def _level(self, state: ClientState, change: _Change, now: float) -> Level:
        if state.presence is Presence.GONE:
            return Level(STALE, "it has closed its session")
        if state.presence is Presence.REFUSED:
            return Level(ERROR, f"refused by the policy: {state.last_error}")
        if state.presence is Presence.SILENT:
            if state.silent_s >= ERROR_TIMEOUTS * self._timeout_s:
                return Level(ERROR, "lost: no message for a long time")
            return Level(STALE, "silent: its entities have left the ROS graph")
        if state.silent_s >= self._timeout_s / 2:
            return Level(WARN, "no message for half of the client time-out")
        if change.what and now - change.at < RECENT_S:
            return Level(WARN, change.what)
        return Level(OK, "connected")


class DiagnosticsPublisher:
    """Publishes the levels on the node of a peer."""

    def __init__(self, peer: Peer, timeout_s: float) -> None:
        """Create the publisher; `timeout_s` as for ClientDiagnostics. Raises RosError if the node cannot have it."""
        self._diagnostics = ClientDiagnostics(timeout_s)
        self._topic = peer.publisher(TOPIC, TYPE)
        self._published: dict[str, Level] = {}
        self._due_at = 0.0

    def __call__(self, states: tuple[ClientState, ...], now: float) -> None:
        """Publish the states, once a second and when a level changes; nothing without clients."""
        levels = self._diagnostics.levels(states, now)
        if not levels or (now < self._due_at and levels == self._published):
            return
        self._published, self._due_at = levels, now + PERIOD_S
        self._topic.publish(message_of(states, levels, time.time_ns()))


def message_of(states: Iterable[ClientState], levels: dict[str, Level], time_ns: int) -> Value:
    """Return the message; `time_ns`: nanoseconds since 1970."""
    seconds, nanoseconds = divmod(time_ns, _NS)
    return {
        "header": {"stamp": {"sec": seconds, "nanosec": nanoseconds}},
        "status": [
            {
                "level": levels[state.key].level,
                "name": f"{PREFIX}{state.key}",
                "message": levels[state.key].message,
                "hardware_id": state.key,
                "values": [{"key": key, "value": value} for key, value in _values(state)],
            }
            for state in states
        ],
    }


def _values(state: ClientState) -> tuple[tuple[str, str], ...]:
    round_trip = "" if state.round_trip_s is None else f"{state.round_trip_s * 1000:.1f}"
    return (
        ("presence", state.presence.name.lower()),
        ("transport", state.transport),
        ("address", state.address),
        ("nodes", " ".join(state.nodes)),
        ("silent_s", f"{state.silent_s:.1f}"),
        ("sessions", str(state.sessions)),
        ("reconnects", str(state.reconnects)),
        ("silences", str(state.silences)),
        ("round_trip_ms", round_trip),
        ("lost", str(state.lost)),
        ("resent", str(state.resent)),
        ("last_error", state.last_error),
        ("denied", str(state.denied)),
    )
