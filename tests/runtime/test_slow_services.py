# SPDX-License-Identifier: Apache-2.0
"""Services over slow links, polled: three seconds of round trip, and 2,400 baud.

Time is made; tests/e2e/test_slow.py has rclpy.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

import pytest

from microros_gen.application.model import SessionTimes
from tests.support.plans import SERVER
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.serving_agent import ServingAgent, identity
from tests.support.runtime.times import with_times

REPLIER = bytes.fromhex("0018")
TAKE_FAILED, REPLY_FAILED = 601, 501
STEP_MS = 20
CALLS = 6
SLOTS = SERVER.streams.reliable_slots


@dataclass(frozen=True)
class Link:
    """How long an answer takes, what a byte takes, and the application's words on it."""

    round_trip_ms: int
    byte_ms: float
    times: SessionTimes
    baud: int | None


LINKS = {
    "3 s": Link(3000, 0, SessionTimes(round_trip=3750), None),
    "2400 baud": Link(0, 10_000 / 2400, SessionTimes(), 2400),
}


def opened(bench: Bench, link: Link) -> tuple[Client, ServingAgent]:
    """Return a client with a publisher, a service and a client, and its agent after the link."""
    agent = ServingAgent()
    client = bench.start(with_times(SERVER, link.times, link.baud), agent=agent)
    client.round_trip_ms, client.byte_ms = link.round_trip_ms, link.byte_ms
    for call in (
        "init",
        "node 0 server -",
        "publisher 0 0 Int32 chatter reliable",
        "serve_init 0 0 set",
        "serve_client 0 0 /far/ask",
    ):
        client.ok(call)
    client.spin(400, STEP_MS)
    return client, agent


def request(client: Client, agent: ServingAgent, number: int) -> None:
    body = identity(number) + struct.pack("<i", number)
    client.bring(agent.give(REPLIER, body), client.now_ms + client.round_trip_ms / 2)


def take_and_answer(client: Client) -> int:
    """Take a request as a polling program does, and answer it; return its number, or 0 without one."""
    taken = client.call("serve_take 0 0")
    assert taken.code in (0, TAKE_FAILED), taken
    if taken.code:
        return 0
    number = int(taken.lines[0].split()[1])
    client.ok(f"serve_answer 0 0 {number}")
    return number


@pytest.mark.parametrize("link", LINKS.values(), ids=LINKS)
def test_each_request_is_answered_once(bench: Bench, link: Link) -> None:
    """The stream is full of samples each time a request comes: it waits, and no reply is refused."""
    client, agent = opened(bench, link)
    served: list[int] = []
    published = 0
    for number in range(1, CALLS + 1):
        while client.call(f"publish 0 {published}").code == 0:
            published += 1
        request(client, agent, number)
        for _ in range(800):
            client.spin(1, STEP_MS)
            served += [number] if take_and_answer(client) else []
    client.ok("flush 20000")
    assert served == list(range(1, CALLS + 1))
    assert agent.answered == [identity(n) + struct.pack("<i", n) for n in served]
    assert agent.values() == list(range(published))
    assert published >= CALLS * SLOTS
    assert (client.statistics()["resent"], client.statistics()["reconnects"]) == (0, 0)


@pytest.mark.parametrize("link", LINKS.values(), ids=LINKS)
def test_each_call_gets_its_reply(bench: Bench, link: Link) -> None:
    client, agent = opened(bench, link)
    replies: list[tuple[int, int]] = []
    called = answered = 0
    for _ in range(CALLS * 400):
        if called < CALLS and called - len(replies) < 3:
            called += client.call(f"serve_ask 0 {called}").code == 0
        while answered < len(agent.calls):
            client.bring(agent.reply(answered, 100 + answered), client.now_ms + client.round_trip_ms / 2)
            answered += 1
        client.spin(1, STEP_MS)
        reply = client.call("serve_reply 0")
        assert reply.code in (0, REPLY_FAILED), reply
        if reply.code == 0:
            _, value, sequence = reply.lines[0].split()
            replies.append((int(value), int(sequence)))
    assert replies == [(100 + number, number + 1) for number in range(CALLS)]
    assert (client.statistics()["resent"], client.statistics()["reconnects"]) == (0, 0)


def test_more_under_way_than_the_history_holds(bench: Bench) -> None:
    """Where acknowledgements take three seconds, the default history is what limits the pace: nothing is lost by it."""
    link = LINKS["3 s"]
    client, agent = opened(bench, link)
    for number in range(1, 2 * SLOTS + 1):
        request(client, agent, number)
    served: list[int] = []
    for _ in range(2400):
        client.spin(1, STEP_MS)
        number = take_and_answer(client)
        served += [number] if number else []
    assert served == list(range(1, 2 * SLOTS + 1))
    assert len(agent.answered) == len(served)
