# SPDX-License-Identifier: Apache-2.0
"""A client with a list of agents, which are scripted: which one it takes, when, and what it does at a change."""

from __future__ import annotations

import struct
import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.support.e2e.agent_list import agent_of, listed, wait_for_agent
from tests.support.e2e.images import POOLS, Images
from tests.support.e2e.live import Live
from tests.support.e2e.udp_agent import serving
from tests.support.free_ports import free_ports
from tests.support.patience import deadline
from tests.support.runtime.fake_agent import FakeAgent

ROUND_TRIP_MS = 50
TRY_MS = 3 * ROUND_TRIP_MS
SLOTS = 4
"""Messages of the reliable stream: the default of pure_sender."""
CONNECT_MS = 3000
QUICK = (
    f"round_trip: {ROUND_TRIP_MS} ms, liveliness_period: 200 ms, liveliness_timeout: 900 ms,"
    f" retry_max: 400 ms, connect_timeout: {CONNECT_MS} ms, create_timeout: {CONNECT_MS} ms"
)
"""Three pings of 300 ms: an agent is a thread of the test, which may stand still for a moment."""


class Agents:
    """Scripted agents at the ports of a list, each absent until it is started."""

    def __init__(self, ports: list[int]) -> None:
        self.ports = ports
        self.scripted = [FakeAgent() for _ in ports]
        self._running: dict[int, ExitStack] = {}

    def start(self, *indexes: int) -> None:
        for index in indexes:
            self.scripted[index].restart()
            self._running[index] = ExitStack()
            self._running[index].enter_context(serving(self.scripted[index], self.ports[index]))

    def stop(self, *indexes: int) -> None:
        for index in indexes:
            self._running.pop(index).close()

    def close(self) -> None:
        self.stop(*self._running)


@pytest.fixture(scope="module")
def three(images: Images) -> tuple[Agents, Images, str]:
    ports = free_ports(3)
    more = "components: [+time_sync, +session_state]\n"
    return Agents(ports), images, listed(ports, QUICK, POOLS + more)


@pytest.fixture
def agents(three: tuple[Agents, Images, str]) -> Iterator[Agents]:
    chosen = Agents(three[0].ports)
    yield chosen
    chosen.close()


@pytest.fixture
def live(three: tuple[Agents, Images, str]) -> Iterator[Live]:
    _, images, application = three
    with Live(images.live(images.build(0, application))) as running:
        yield running


def talk(live: Live, address: str = "-") -> None:
    for command in (f"open 0x77 {address}", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        live.ok(command)


# With scripted agents: who is tried, and how long


def test_the_first_that_answers_is_taken(live: Live, agents: Agents) -> None:
    agents.start(2)
    answer = live.ok("open 0x77 -")
    assert 2 * TRY_MS * 1000 <= answer.took_us < CONNECT_MS * 1000
    assert agent_of(live) == (agents.ports[2], 2, 0)
    live.ok("close")
    agents.start(0)
    assert live.ok("open 0x77 -").code == 0
    assert agent_of(live) == (agents.ports[0], 0, 0), "each session begins with the first"
    live.ok("close")
    assert live.call("agent").code != 0


def test_no_agent_at_all(live: Live, agents: Agents) -> None:
    answer = live.call("open 0x77 -")
    assert answer.code == 2
    places = [f"no agent answers at 127.0.0.1:{port} within {CONNECT_MS} ms" for port in agents.ports]
    assert answer.text in places
    assert answer.took_us >= CONNECT_MS * 990
    agents.start(1)
    live.ok("open 0x77 -")
    live.ok("close")


def test_an_agent_that_refuses_is_left_at_once(live: Live, agents: Agents) -> None:
    agents.start(0, 1, 2)
    agents.scripted[0].session_status = 0x87
    live.ok("open 0x77 -")
    assert agent_of(live)[1] == 1
    assert len(agents.scripted[0].log) < 3, "it is not tried until its time is over"
    live.ok("close")
    for agent in agents.scripted:
        agent.session_status = 0x83
    answer = live.call("open 0x77 -")
    refused = f"the agent at 127.0.0.1:{agents.ports[2]} refuses the session: DENIED"
    assert (answer.code, answer.text) == (1, refused)


def test_an_address_of_the_application(live: Live, agents: Agents) -> None:
    """One of the list is tried first, another one alone."""
    agents.start(0, 1)
    talk(live, str(agents.ports[1]))
    assert agent_of(live)[1] == 1
    agents.stop(1)
    wait_for_agent(live, 0)
    live.ok("close")
    with serving(FakeAgent(), free_ports(1)[0]) as port:
        talk(live, str(port))
        assert agent_of(live) == (port, 3, 0)
    time.sleep(2.0)
    assert live.call("connected").code == 0
    assert agent_of(live) == (port, 3, 0)
    live.ok("close")


def test_unacknowledged_samples_go_to_the_next_agent(live: Live, agents: Agents) -> None:
    """Round robin: from the second to the third, and from there to the first, which was started again."""
    agents.start(1, 2)
    talk(live)
    assert agent_of(live)[1] == 1
    live.burst(0, 3, 2)
    live.ok("flush 2000")
    agents.stop(1)
    taken = [s.value for s in live.burst(100, 8, 1) if s.code == 0]
    assert len(taken) == SLOTS
    agents.start(0)
    wait_for_agent(live, 2)
    live.ok("flush 2000")
    assert agents.scripted[2].values() == taken
    assert set(agents.scripted[2].objects) == set(agents.scripted[1].objects)
    agents.stop(2)
    wait_for_agent(live, 0)
    assert agent_of(live) == (agents.ports[0], 0, 2)
    live.ok("publish 0 7")
    live.ok("flush 2000")
    assert agents.scripted[0].values() == [7]
    assert live.statistics()["reconnects"] == 2
    live.ok("close")
    assert not agents.scripted[0].connected


def test_an_agent_that_says_that_it_ends_is_left_at_once(live: Live, agents: Agents) -> None:
    """What it has not acknowledged goes to the next one. It answers all that it gets, so no ping fails."""
    agents.start(0, 1)
    talk(live)
    live.ok("flush 2000")
    agents.scripted[0].leaving = True
    taken = [s.value for s in live.burst(0, 3, 1) if s.code == 0]
    wait_for_agent(live, 1)
    live.ok("flush 2000")
    assert agents.scripted[1].values() == taken
    assert agent_of(live) == (agents.ports[1], 1, 1)
    agents.scripted[0].leaving = False
    live.ok("close")


def test_an_agent_that_has_restarted_is_kept(live: Live, agents: Agents) -> None:
    agents.start(0, 1)
    talk(live)
    agents.scripted[0].restart()
    end = deadline(10)
    while live.statistics()["reconnects"] == 0:
        assert time.monotonic() < end
        live.call("publish 0 1")
    wait_for_agent(live, 0)
    assert agent_of(live) == (agents.ports[0], 0, 0)
    live.ok("close")


def test_a_ping_without_a_session_asks_all(live: Live, agents: Agents) -> None:
    agents.start(2)
    assert live.call("ping 300 1").code == 0
    agents.stop(2)
    answer = live.call("ping 90 1")
    assert answer.code != 0
    assert answer.text == f"no agent answers at 127.0.0.1:{agents.ports[2]} within 90 ms"
    assert answer.took_us >= 85_000


class Clock(FakeAgent):
    """An agent whose clock says another time."""

    def __init__(self, seconds: int) -> None:
        super().__init__()
        self.seconds = seconds
        self.requests = 0

    def receive(self, datagram: bytes) -> list[bytes]:
        if len(datagram) >= 16 and datagram[4] == 0x0E and self.connected and not self.silent:
            self.requests += 1
            stamp = struct.pack("<II", self.seconds, 0)
            return [bytes.fromhex("81000000 0f011800") + stamp + stamp + datagram[8:16]]
        return super().receive(datagram)


def test_the_time_is_that_of_the_new_agent(live: Live, agents: Agents) -> None:
    first, second = Clock(1_000_000), Clock(2_000_000)
    agents.scripted[:2] = [first, second]
    agents.start(0, 1)
    talk(live)
    agents.stop(0)
    wait_for_agent(live, 1)
    assert second.requests == 0, "a client that never asked for the time gets none"
    agents.start(0)
    agents.stop(1)
    wait_for_agent(live, 0)
    live.ok("sync 2000")
    assert live.ok("epoch").lines[0].startswith("epoch 10000")
    agents.start(1)
    agents.stop(0)
    wait_for_agent(live, 1)
    end = deadline(10)
    while not live.ok("epoch").lines[0].startswith("epoch 20000"):
        assert time.monotonic() < end
    assert live.ok("epoch").lines[0].endswith(" 1")
    requests = second.requests
    time.sleep(0.5)
    assert second.requests == requests, "once answered, no further request follows"
    live.ok("close")
