# SPDX-License-Identifier: Apache-2.0
"""A client that tells the agent how long it may be silent, and is not; checked with this project's agent, too."""

from __future__ import annotations

import pytest

from tests.support.agent.fakes import Bench as AgentBench
from tests.support.plans import POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client

PLAN = changed(POOL, session__hard_liveliness_ms=2000)
CAPTURED = bytes.fromhex(
    "58524345 0100 010f a1b2c3d4 81 01 0000 01000000 07000000 7578725f686c00 00 07000000 30303230303000"
)
"""What the public client says for 2,000 ms, with another key; after it a byte of padding and the MTU."""


def connected(bench: Bench, liveliness: str) -> Client:
    client = bench.start(PLAN, liveliness)
    for call in ("init", "node 0 n -", "publisher 0 0 Int32 out reliable", "publish 0 1"):
        client.ok(call)
    client.spin(3)
    return client


@pytest.mark.parametrize("liveliness", ["ping", "acknack"])
def test_the_agent_gets_the_time_out_and_a_sign_of_life_in_time(bench: Bench, liveliness: str) -> None:
    client = connected(bench, liveliness)
    login = next(d for d in client.sent if d[4] == 0)
    assert login[8:51] == CAPTURED
    assert login[6:8] == (46).to_bytes(2, "little")
    assert (len(login), login[52:]) == (54, (64).to_bytes(2, "little"))
    agent = AgentBench()
    assert agent.say(login.hex(" "))
    (known,) = agent.agent.clients
    assert (known.timeout_s, known.session.link.mtu) == (2.0, 64)
    client.sent.clear()
    silent = 0
    for _ in range(100):
        before = len(client.sent)
        client.spin(1, 50)
        silent = 0 if len(client.sent) > before else silent + 50
        assert silent <= 2000 / 3 + 100
    assert client.statistics()["reconnects"] == 0
    if liveliness == "acknack":
        assert 6 <= len(client.sent) <= 8, "no more than it takes"


def test_who_writes_sends_nothing_more(bench: Bench) -> None:
    client = connected(bench, "acknack")
    client.sent.clear()
    for value in range(20):
        client.ok(f"publish 0 {value}")
        client.spin(1, 200)
    assert {datagram[4] for datagram in client.sent} == {0x07}


def test_an_agent_that_asks_is_answered(bench: Bench) -> None:
    client = connected(bench, "acknack")
    client.sent.clear()
    client.queued.append(bytes.fromhex("81000000 02010800 0000fffe 00000000"))
    client.spin(2)
    assert [datagram[4] for datagram in client.sent] == [0x02]
