# SPDX-License-Identifier: Apache-2.0
"""Players of both sides: against the agent, against each other over a lossy link, and differences they must find."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.recording.packets import endpoint
from microros_gen.agent.recording.recorded import Conversation, Message, read_recording
from microros_gen.agent.replay.player import Player
from microros_gen.agent.wire.data_messages import Data, WriteData
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import CreateClient, StatusAgent
from microros_gen.agent.wire.submessages import encode
from microros_gen.diagnostics import UserError
from tests.support.agent.fakes import Bench
from tests.support.agent.recordings import record_publisher

LATER = float("inf")
KEY = bytes.fromhex("a1b2c3d4")
FIRST, SECOND = bytes(range(24)), bytes(range(100, 124))


def recorded(path: Path, **client: int) -> Conversation:
    record_publisher(path, **client)
    (conversation,), outside = read_recording(path)
    assert outside == 0
    return conversation


def play(player: Player, bench: Bench, seconds: float = 8.0) -> None:
    """Play a client towards the agent of a bench, as fast as it answers."""
    waiting: deque[bytes] = deque()
    end = bench.now + seconds
    while not player.done and bench.now < end:
        bench.now += 0.05
        player.tick(bench.now, LATER, waiting.append)
        while waiting:
            for answer in bench.say(waiting.popleft()):
                player.receive(bytes.fromhex(answer), waiting.append)


@pytest.mark.parametrize("session", [0x81, 0x01])
def test_an_agent_that_answers_alike(tmp_path: Path, session: int) -> None:
    player = Player(recorded(tmp_path / "a", session=session), as_agent=False, wait_s=2)
    bench = Bench()
    play(player, bench)
    assert (player.difference, player.done) == ("", True)
    assert player.compared == 7
    assert [len(data) for _, data in bench.bridge.published] == [8, 1504, 12]


def test_an_agent_that_answers_otherwise(tmp_path: Path) -> None:
    conversation = recorded(tmp_path / "a")
    player = Player(conversation, as_agent=False, wait_s=2)
    play(player, Bench(Limits(objects=3)))
    number = int(player.difference.split()[1].rstrip(":"))
    assert player.difference == f"packet {number}: STATUS: status 0 was recorded, 135 was received"
    (status,) = (m.data for m in conversation.messages if m.number == number)
    assert status[4] == 5, "a STATUS"


def test_an_agent_that_is_silent(tmp_path: Path) -> None:
    player = Player(recorded(tmp_path / "a"), as_agent=False, wait_s=2)
    for now in (0.0, 1.9, 2.1):
        assert not player.difference
        player.tick(now, LATER, lambda _: None)
    assert player.difference == "packet 2: STATUS_AGENT did not come within 2 s"


def test_messages_are_sent_at_their_time(tmp_path: Path) -> None:
    """The first sample was recorded 0.5 s after the session began."""
    conversation = recorded(tmp_path / "a")
    begin = conversation.messages[0].time_ns
    player, bench = Player(conversation, as_agent=False, wait_s=2), Bench()
    waiting: deque[bytes] = deque()
    counts = []
    for after in (0.4, 0.6, 1.1, 1.6):
        for _ in range(60):
            bench.now += 0.01
            player.tick(bench.now, begin + after * 1e9, waiting.append)
            while waiting:
                for answer in bench.say(waiting.popleft()):
                    player.receive(bytes.fromhex(answer), waiting.append)
        counts.append(len(bench.bridge.published))
    assert counts == [0, 1, 2, 3]


@pytest.mark.parametrize("seed", range(8))
def test_both_sides_over_a_link_that_loses_and_reorders(tmp_path: Path, seed: int) -> None:
    """Only reliable streams repeat; the session itself is on none, so its messages arrive."""
    chance, conversation = Random(seed), recorded(tmp_path / "a")
    client = Player(conversation, as_agent=False, wait_s=30)
    agent = Player(conversation, as_agent=True, wait_s=30)
    to_agent: list[bytes] = []
    to_client: list[bytes] = []
    now = 0.0
    while not (client.done and agent.done):
        now += 0.05
        assert now < 60, (client.difference, agent.difference)
        client.tick(now, LATER, to_agent.append)
        agent.tick(now, LATER, to_client.append)
        for box, player, answers in ((to_agent, agent, to_client), (to_client, client, to_agent)):
            arrived, box[:] = list(box), []
            chance.shuffle(arrived)
            for data in arrived:
                if data[1] < 0x80 or chance.random() > 0.3:
                    player.receive(data, answers.append)
    assert (client.difference, agent.difference) == ("", "")


def test_firmware_with_another_key_and_session(tmp_path: Path) -> None:
    """The agent's messages have the session's id and the key that the firmware has now."""
    player = Player(recorded(tmp_path / "a", session=0x01), as_agent=True, wait_s=2)
    record_publisher(tmp_path / "b", key=0x00000007, session=0x02)
    (other,), _ = read_recording(tmp_path / "b")
    client, waiting = Player(other, as_agent=False, wait_s=2), deque[bytes]()
    seen = []
    for step in range(200):
        answers: list[bytes] = []
        client.tick(step * 0.05, LATER, waiting.append)
        while waiting:
            player.receive(waiting.popleft(), answers.append)
        player.tick(step * 0.05, LATER, answers.append)
        for answer in answers:
            seen.append(answer[0])
            assert answer[4:8].hex() == "00000007"
            client.receive(answer, waiting.append)
    assert set(seen) == {2}
    assert (player.difference, player.done) == ("", True)
    assert (client.difference, client.done) == ("", True)


def test_firmware_that_sends_something_else(tmp_path: Path) -> None:
    conversation = recorded(tmp_path / "a")
    player = Player(conversation, as_agent=True, wait_s=2)
    changed = [
        replace(m, data=m.data[:-1] + b"\x01") if m.of_client and m.data[4] == WriteData.ID else m
        for m in conversation.messages
    ]
    first = next(m.number for m in changed if m.of_client and m.data[4] == WriteData.ID)
    for message in changed:
        if message.of_client:
            player.receive(message.data, lambda _: None)
    assert player.difference.startswith(f"packet {first}: WRITE_DATA: data 00")
    assert player.difference.endswith("00 00 00 01 was received")


def served(identity: bytes) -> list[bytes]:
    """Return a session with a request that has an identity, and its reply."""
    head = Header(0x81, 1, 0)
    return [
        join(Header(0x80, 0, 0), [encode(CreateClient(KEY, 0x81, 512))]),
        join(Header(0x81, 0, 0), [encode(StatusAgent(0))]),
        join(head, [encode(Data(10, 0x0018, identity + b"ask!"))]),
        join(head, [encode(WriteData(11, 0x0018, identity + b"told"))]),
    ]


def test_a_reply_has_the_identity_of_the_request_of_this_run() -> None:
    messages = [Message(n, n, n in (1, 4), data) for n, data in enumerate(served(FIRST), 1)]
    player = Player(Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), tuple(messages)), False, 2)
    now = served(SECOND)
    sent: list[bytes] = []
    for answer in (now[1], now[2]):
        player.tick(1.0, LATER, sent.append)
        player.receive(answer, sent.append)
    player.tick(1.0, LATER, sent.append)
    assert sent == [now[0], now[3]]
    assert (player.difference, player.done) == ("", True)


def test_kinds_that_are_skipped_are_not_waited_for() -> None:
    messages = [Message(n, n, n in (1, 4), data) for n, data in enumerate(served(FIRST), 1)]
    conversation = Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), tuple(messages))
    player, sent = Player(conversation, False, 2, ["DATA"]), list[bytes]()
    player.tick(1.0, LATER, sent.append)
    player.receive(messages[1].data, sent.append)
    player.tick(1.0, LATER, sent.append)
    assert sent == [messages[0].data, messages[3].data]
    assert player.done


def test_more_than_was_recorded_is_a_difference(tmp_path: Path) -> None:
    conversation = recorded(tmp_path / "a")
    player = Player(conversation, as_agent=False, wait_s=2)
    play(player, Bench())
    player.receive(join(Header(0x81, 1, 0), [encode(Data(10, 0x0016, b"more"))]), lambda _: None)
    assert player.difference == "DATA was received, which the recording does not have"


def test_a_recording_from_the_middle_of_a_session(tmp_path: Path) -> None:
    path = tmp_path / "a"
    record_publisher(path)
    content = path.read_bytes()
    begin = content.index(b"\x06\0\0\0")
    size = int.from_bytes(content[begin + 4 : begin + 8], "little")
    path.write_bytes(content[:begin] + content[begin + size :])
    with pytest.raises(UserError, match="has no session of a client"):
        read_recording(path)
