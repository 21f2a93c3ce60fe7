# SPDX-License-Identifier: Apache-2.0
"""A publish of a board waits for no line: what it costs while that stands still, what becomes of the messages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from tests.support.firmware.board import Board, Builds, Built, board
from tests.support.firmware.line import Relay, scripted_agent
from tests.support.runtime.fake_agent import FakeAgent

NAME = "qemu-mps2-an386"
LARGE, SMALL = 7000, 4000
WHOLE = 700
"""Fits a message of the line: not in fragments."""
APPLICATION = """\
version: 1
profiles: [pure_sender]
liveliness: none
transport: {type: serial, mtu: MTU}
pools: {history: 2}
nodes:
  - name: large
    publishers:
      - {topic: text, type: std_msgs/msg/String}
      - {topic: count, type: std_msgs/msg/Int32, qos: {reliability: best_effort, depth: 1}}
limits: {std_msgs/msg/String: {data: LARGE}}
"""
REPORT = (
    "ready",
    "published",
    "done",
    "large_taken",
    "small_taken",
    "large_ticks",
    "small_ticks",
    "dropped",
)
TICKS_PER_MS = 25_000


def application(mtu: int, large: int) -> str:
    return APPLICATION.replace("MTU", str(mtu)).replace("LARGE", str(large))


def text_of(size: int) -> bytes:
    return bytes(ord("%") + i % 90 for i in range(size))


def counted(built: Built) -> Built:
    """Return a board whose clock follows its instructions: 32 ns each, 0.8 of a tick."""
    emulator = built.target.emulator
    assert emulator is not None
    slow = replace(emulator, arguments=(*emulator.arguments, "-icount", "shift=5"))
    return replace(built, target=replace(built.target, emulator=slow))


def counts_of(running: Board) -> dict[str, int]:
    return dict(zip(REPORT, running.words("large_report", len(REPORT)), strict=True))


def fragments(agent: FakeAgent) -> Iterator[tuple[bool, bytes]]:
    """Yield what each FRAGMENT of the reliable stream carries, once and in order, and whether it is the last."""
    found = {int.from_bytes(m[2:4], "little"): m for m in agent.log if m[1] == 0x80 and m[4] == 0x0D}
    for _, message in sorted(found.items()):
        size = int.from_bytes(message[6:8], "little")
        yield bool(message[5] & 2), message[8 : 8 + size]


@pytest.mark.system
def test_a_publish_returns_at_once_when_the_line_takes_nothing(builds: Builds) -> None:
    """A fragment alone takes 45 ms on a line of 115,200 baud, and the 15 of a message 0.6 s."""
    stopped, agent = published_while_the_line_stalls(builds, application(512, LARGE))
    joined = [part for _, part in fragments(agent)]
    assert b"".join(joined).count(text_of(LARGE)) == 2, "what was taken arrives whole"
    assert len(joined) >= 2 * 14
    assert 0 < stopped["small_taken"] < SMALL


@pytest.mark.system
def test_a_message_that_is_not_copied_arrives_whole(builds: Builds) -> None:
    """The line takes reliable messages from their slots; the ring, for best-effort ones, is smaller than one."""
    text = application(1024, WHOLE)
    built = builds.merged(NAME, text)
    assert built.symbol_sizes()["port_output"] < WHOLE
    stopped, agent = published_while_the_line_stalls(builds, text, f"-DLARGE_SIZE={WHOLE}")
    whole = {m[2:4]: m for m in agent.log if m[1] == 0x80 and m[4] == 0x07}
    assert [text_of(WHOLE) in message for message in whole.values()] == [True, True]
    assert 0 < stopped["small_taken"] < SMALL


def published_while_the_line_stalls(
    builds: Builds, text: str, *flags: str
) -> tuple[dict[str, int], FakeAgent]:
    """Return what was so when all was published, and the agent that got it when the line went on."""
    built = counted(builds.merged(NAME, text))
    image = builds.application(built, "large.c", *flags)
    agent = FakeAgent()
    with board(built, image) as running, Relay(running.device) as relay, scripted_agent(relay.device, agent):
        running.go_on()
        running.wait_for(lambda: counts_of(running)["ready"], 60)
        relay.stopped = True
        running.wait_for(lambda: counts_of(running)["published"], 60)
        stopped = counts_of(running)
        relay.stopped = False
        running.wait_for(lambda: counts_of(running)["done"], 60)
    assert stopped["large_taken"] == 2, "the stream has two slots"
    assert stopped["dropped"] == (SMALL - stopped["small_taken"]) + 1, "each refused one is counted"
    assert stopped["small_ticks"] < 0.3 * TICKS_PER_MS, stopped
    assert stopped["large_ticks"] < 2 * TICKS_PER_MS, stopped
    return stopped, agent


CLOSE_MS = 2500
CLOSING = f"""\
version: 1
profiles: [pure_sender]
liveliness: none
entities: preconfigured
session: {{key: 7, close_timeout: {CLOSE_MS} ms}}
transport: {{type: serial, send_buffer: 600}}
nodes:
  - name: closes
    publishers: [{{topic: count, type: std_msgs/msg/Int32, qos: {{reliability: best_effort, depth: 1}}}}]
"""


@pytest.mark.system
def test_closing_lets_what_waits_for_the_line_leave(builds: Builds) -> None:
    """What the ring holds when the session ends; a line that stands holds the end no longer than `close_timeout`."""
    built = counted(builds.merged(NAME, CLOSING))
    image = builds.application(built, "closing.c")
    agent = FakeAgent(objects={b"\0\5": b""})

    def reached(running: Board, what: int) -> list[int]:
        return running.words("closing_report", 7)[what:]

    with board(built, image) as running, Relay(running.device) as relay, scripted_agent(relay.device, agent):
        running.go_on()
        running.wait_for(lambda: reached(running, 0)[0] == 1, 60)
        relay.stopped = True
        running.wait_for(lambda: reached(running, 1)[0] == 1, 60)
        relay.stopped = False
        running.wait_for(lambda: reached(running, 2)[0] == 1, 60)
        taken = reached(running, 3)[0]
        running.wait_for(lambda: len(agent.written) >= taken, 20)
        written = [int.from_bytes(body, "little") for _, body in agent.written]
        running.wait_for(lambda: reached(running, 0)[0] == 2, 60)
        relay.stopped = True
        running.wait_for(lambda: reached(running, 2)[0] == 2, 60)
        close_ms = reached(running, 5)
    assert 8 <= taken < 4000, "the ring was full"
    assert written == list(range(taken))
    assert 1 <= close_ms[0] < CLOSE_MS, "as soon as the line had taken it"
    assert CLOSE_MS <= close_ms[1] < CLOSE_MS + 100
