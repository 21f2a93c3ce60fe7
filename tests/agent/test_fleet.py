# SPDX-License-Identifier: Apache-2.0
"""Many clients of one agent: memory and service are the same for each."""

from __future__ import annotations

import select
import socket
import statistics
import time
from collections import Counter
from collections.abc import Hashable
from pathlib import Path

import pytest

from microros_gen.agent.fairness import Account
from microros_gen.agent.limits import CLIENT_OBJECT_BYTES, Limits, limits_with
from microros_gen.agent.liveliness import Verdict, is_well, judge
from microros_gen.agent.memory import TIGHT_PART
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.agent.transport.udp import READY, Udp
from tests.support.agent import captured
from tests.support.agent.fakes import Bench
from tests.support.agent.fleet import Rates, fleet
from tests.support.agent.process import own_domain, running_agent
from tests.support.patience import deadline, seconds

SENDERS = 2 * READY + 40
MB = 1_000_000


class Watched:
    """An epoll descriptor that notes how many sockets it hands out at one time: those are ordered."""

    def __init__(self, epoll: select.epoll) -> None:
        self._epoll = epoll
        self.register, self.close = epoll.register, epoll.close
        self.sizes: list[int] = []

    def poll(self, timeout: float, most: int) -> list[tuple[int, int]]:
        found = self._epoll.poll(timeout, most)
        self.sizes.append(len(found))
        return found


def test_of_many_clients_with_input_some_are_ordered_at_a_time_and_all_are_read() -> None:
    udp = Udp(PROTOCOLS["udp4"], "127.0.0.1", 0)
    watched = Watched(udp._epoll)
    udp._epoll = watched  # type: ignore[assignment]
    senders = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(SENDERS)]
    read: Counter[Hashable] = Counter()

    def receive(data: bytes, address: Hashable, transport: Transport) -> None:
        read[address] += 1

    try:
        for sender in senders:
            sender.connect((udp.host, udp.port))
            udp.claim((udp, sender.getsockname()), Account())
        for _ in range(3):
            for sender in senders:
                sender.send(b"x")
        end = deadline(10)
        while read.total() < 3 * SENDERS and time.monotonic() < end:
            udp.pump(receive)  # which ends early where the system gives the processor to others
        assert len(read) == SENDERS
        assert set(read.values()) == {3}
        assert max(watched.sizes) == READY
    finally:
        udp.close()
        for sender in senders:
            sender.close()


@pytest.mark.parametrize("patience_s", [5.0, float("inf")])
def test_a_client_that_is_well_needs_nothing(patience_s: float) -> None:
    """For each age of its last message, and while a probe is not answered yet."""
    bench = Bench()
    bench.say(captured.CREATE_CLIENT)
    (client,) = bench.agent.clients
    seen = set()
    for probes in (0, 1):
        for silent in range(60):
            client.probes, client.probed = probes, client.last_received + 1
            well = is_well(client, client.last_received + silent, patience_s)
            verdict = judge(client, client.last_received + silent, patience_s)
            seen.add(well)
            assert not well or (verdict is Verdict.FINE and client.probes == 0)
    assert seen == {True, False}


def test_more_clients_have_more_memory_unless_the_user_has_chosen_it() -> None:
    more = limits_with({"clients": 1000})
    assert more.object_bytes == Limits().object_bytes + 744 * CLIENT_OBJECT_BYTES
    assert more.memory_bytes - more.object_bytes == Limits().memory_bytes - Limits().object_bytes
    assert CLIENT_OBJECT_BYTES * Limits().clients == Limits().object_bytes
    for chosen in ({}, {"clients": 8}, {"clients": 1000, "object_bytes": 1 << 20}, {"memory_bytes": 1 << 28}):
        assert limits_with(chosen) == Limits(**chosen)
    assert TIGHT_PART * more.memory_bytes > 220 * MB, "the memory of 1,000 clients leaves room for objects"


def resident_mb(process: int) -> float:
    status = Path(f"/proc/{process}/status").read_text()
    return int(status.partition("VmRSS:")[2].split()[0]) * 1024 / MB


def assert_fair(rates: Rates) -> None:
    """Of clients that all want more than the agent can, none is starved, and no group of them has precedence.

    One alone may get little in a short run on a busy machine: it pays for the time in which the agent served it, also
    that in which the system gave the processor to others.
    """
    assert min(rates.counts) > 0, rates
    size = len(rates.counts) // 10
    groups = [statistics.mean(rates.counts[at : at + size]) for at in range(0, 10 * size, size)]
    assert min(groups) > 0.6 * statistics.mean(groups), groups
    assert statistics.median(rates.counts) > 0.7 * statistics.mean(rates.counts), sorted(rates.counts)


@pytest.mark.ros
@pytest.mark.system
@pytest.mark.parametrize("count", [250, pytest.param(1000, marks=pytest.mark.long)])
def test_many_clients_are_served_alike_in_little_memory(count: int) -> None:
    domain = own_domain()
    # Those that wait until the others have joined answer no probes.
    options = ("--max-clients", str(count), "--client-timeout", "600")
    with running_agent(domain, *options) as agent, fleet() as clients:
        before = resident_mb(agent.process.pid)
        clients.join(agent.port, domain, count)
        clients.write(2, 4)  # the last clients have just been created, which their first messages pay for
        assert_fair(clients.write(seconds(1.5), 4))
        assert_fair(clients.exchange(seconds(1.5)))
        used = resident_mb(agent.process.pid)
        print(f"{before:.0f} MB without clients, {used:.0f} with {count}")
        assert used < 300 * count / 1000 + 75
        assert used < 300
