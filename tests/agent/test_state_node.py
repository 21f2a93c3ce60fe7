# SPDX-License-Identifier: Apache-2.0
"""The view of clients in ROS 2: what is published and listed, and an agent whose clients come and go."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import pytest

from microros_gen.agent.state_node import LIST_TYPE, SERVICE, STATE_TYPE, TOPIC, changes, list_clients
from microros_gen.agent.states import ClientState, Presence
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from tests.support.agent.client import XrceClient
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.patience import deadline

STATE = ClientState(
    "A1B2C3D4", Presence.CONNECTED, "udp4", "127.0.0.1:1", ("/a",), 0.5, 1, 0, 0, None, 2, 3, "late"
)


def test_a_state_is_published_once_and_times_alone_are_no_change() -> None:
    published: dict[str, dict[str, Any]] = {}
    (first,) = changes((STATE,), published)
    assert (first["key"], first["presence"], first["nodes"], first["round_trip"]) == (
        "A1B2C3D4",
        0,
        ["/a"],
        -1,
    )
    assert changes((replace(STATE, silent_s=9.0, round_trip_s=0.1),), published) == []
    (lost,) = changes((replace(STATE, lost=7),), published)
    assert lost["lost"] == 7
    assert changes((), published) == []
    assert published == {}


def test_pages_of_100_clients() -> None:
    states = tuple(replace(STATE, key=f"{number:08X}") for number in range(100))
    found, first = [], 0
    while True:
        page = list_clients(states, {"first": first, "clients_max": 7})
        found += [client["key"] for client in page["clients"]]
        first = page["next"]
        if first == page["total"]:
            break
    assert found == [state.key for state in states]
    assert len(list_clients(states, {"first": 0, "clients_max": 0})["clients"]) == 100
    assert list_clients(states, {"first": 200, "clients_max": 1}) == {
        "total": 100,
        "next": 100,
        "clients": [],
    }


@pytest.mark.ros
def test_connecting_and_leaving_clients_are_seen_from_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    domain = own_domain()
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    states: list[dict[str, Any]] = []
    with ExitStack() as stack:
        agent = stack.enter_context(running_agent(domain, "--client-state"))
        peer = stack.enter_context(Peer(f"watcher_{os.getpid()}", domain=domain))

        def see(seen: Callable[[], object]) -> None:
            end = deadline(15)
            while not seen():
                assert time.monotonic() < end, states
                peer.spin_once(0.1)

        def last() -> tuple[int, int, list[str]]:
            found: dict[str, Any] = states[-1] if states else {"presence": -1, "sessions": 0, "nodes": []}
            return found["presence"], found["sessions"], found["nodes"]

        with XrceClient(agent.port) as client:
            assert client.connect() == 0
            client.publisher("seen", "seen", INT32, domain)
            peer.subscribe(TOPIC, STATE_TYPE, states.append, Qos(transient_local=True, depth=100))
            see(lambda: last() == (Presence.CONNECTED, 1, ["/seen"]))
            assert client.connect() == 0
            see(lambda: last()[1] == 2)
            lister = peer.client(SERVICE, LIST_TYPE)
            answer = lister.call({"first": 0, "clients_max": 0}, timeout_s=30)
            assert answer is not None
            assert [(c["key"], c["reconnects"]) for c in answer["clients"]] == [(states[-1]["key"], 1)]
            client.leave()
        see(lambda: last()[0] == Presence.GONE)
        assert agent.stop() == 0
