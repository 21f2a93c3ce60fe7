# SPDX-License-Identifier: Apache-2.0
"""The agent's view of its clients in ROS 2: a topic with each change, and a service that lists all of them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from microros_gen.agent.states import ClientState
from microros_gen.ros.endpoints import Value
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

NODE = "microros_agent"
TOPIC = f"/{NODE}/client_states"
SERVICE = f"/{NODE}/list_clients"
STATE_TYPE = "microros_agent_msgs/msg/ClientState"
LIST_TYPE = "microros_agent_msgs/srv/ListClients"
LOOK_S = 0.2
"""Seconds between two checks for changes: several changes of a state in between are published once."""


States = tuple[ClientState, ...]


class StateNode(Serving):
    """The node of a peer on which the view is published; served in the thread that calls `turn`."""

    def __init__(
        self,
        peer: Peer,
        states: Callable[[], States],
        publishers: Iterable[Callable[[States, float], object]],
        report: Callable[[str], object],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`states` returns the latest view, in any thread; `publishers` get it, with the time, when it is looked at.

        `report` gets a line about each request or message that could not be served.
        """
        super().__init__(peer, report)
        self._states = states
        self._publishers = tuple(publishers)
        self._clock = clock
        self._look_at = clock()

    def turn(self, wait_s: float = LOOK_S) -> None:
        """Wait for requests, at most `wait_s` seconds, and publish what has changed."""
        self._spin(min(wait_s, self._look_at - self._clock()))
        if self._clock() >= self._look_at:
            now = self._clock()
            self._look_at = now + LOOK_S
            states = self._states()
            for publish in self._publishers:
                publish(states, now)


class StatePublisher:
    """The topic with each change, and the service."""

    def __init__(self, peer: Peer, states: Callable[[], States], depth: int) -> None:
        """Create both. `depth`: samples for late readers. Raises RosError if the node cannot have them."""
        self._published: dict[str, Value] = {}
        peer.serve(SERVICE, LIST_TYPE, lambda request: list_clients(states(), request))
        self._topic = peer.publisher(TOPIC, STATE_TYPE, Qos(transient_local=True, depth=depth))

    def __call__(self, states: States, _now: float) -> None:
        """Publish what has changed."""
        for value in changes(states, self._published):
            self._topic.publish(value)


def changes(states: tuple[ClientState, ...], published: dict[str, Value]) -> list[Value]:
    """Return the states that differ from those in `published`, and remember them there.

    Times alone are no change: `silent` grows always, and the round trip is never twice the same.
    """
    changed = []
    for state in states:
        value = message_of(state)
        known = {key: part for key, part in value.items() if key not in ("silent", "round_trip")}
        if published.get(state.key) != known:
            published[state.key] = known
            changed.append(value)
    for key in published.keys() - {state.key for state in states}:
        del published[key]
    return changed


def list_clients(states: tuple[ClientState, ...], request: Value) -> Value:
    """Return the response of ListClients."""
    first = min(int(request["first"]), len(states))
    most = int(request["clients_max"]) or len(states)
    page = states[first : first + most]
    return {
        "total": len(states),
        "next": first + len(page),
        "clients": [message_of(state) for state in page],
    }


def message_of(state: ClientState) -> Value:
    """Return a state as microros_agent_msgs/msg/ClientState."""
    return {
        "key": state.key,
        "presence": int(state.presence),
        "transport": state.transport,
        "address": state.address,
        "nodes": list(state.nodes),
        "silent": state.silent_s,
        "sessions": state.sessions,
        "reconnects": state.reconnects,
        "silences": state.silences,
        "round_trip": -1.0 if state.round_trip_s is None else state.round_trip_s,
        "lost": state.lost,
        "resent": state.resent,
        "last_error": state.last_error,
        "denied": state.denied,
    }
