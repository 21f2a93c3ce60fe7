# SPDX-License-Identifier: Apache-2.0
"""Players of both sides: against the agent, against each other over a lossy link, and differences they must find."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.recording.packets import endpoint
from microros_gen.agent.recording.recorded import Conversation, Message, open_recording
from microros_gen.agent.replay.plan import AHEAD
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
    with open_recording(path) as recording:
        (conversation,) = recording.conversations
        assert recording.outside == 0
        return replace(conversation, messages=tuple(conversation.messages))


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


FAREWELL = bytes.fromhex("81000000 05010600 0002fffe0000")


def test_the_farewell_of_an_agent_that_ended_is_not_expected(tmp_path: Path) -> None:
    """It is the answer to a DELETE of the client that nobody sent; after such a DELETE it is expected."""
    conversation = recorded(tmp_path / "a")
    messages = tuple(conversation.messages)
    last = messages[-1]
    farewell = replace(last, number=last.number + 1, of_client=False, data=FAREWELL)
    player = Player(replace(conversation, messages=(*messages, farewell)), False, wait_s=2)
    play(player, Bench())
    assert (player.difference, player.done, player.compared) == ("", True, 7)
    delete = replace(farewell, of_client=True, data=bytes.fromhex("81000000 03010400 0002fffe"))
    requested = replace(farewell, number=last.number + 2)
    player = Player(replace(conversation, messages=(*messages, delete, requested)), False, wait_s=2)
    play(player, Bench())
    assert (player.difference, player.done, player.compared) == ("", True, 8)


def test_an_agent_that_is_silent(tmp_path: Path) -> None:
    player = Player(recorded(tmp_path / "a"), as_agent=False, wait_s=2)
    for now in (0.0, 1.9, 2.1):
        assert not player.difference
        player.tick(now, LATER, lambda _: None)
    assert player.difference == "packet 2: STATUS_AGENT did not come within 2 s"


def test_messages_are_sent_at_their_time(tmp_path: Path) -> None:
    """The first sample was recorded 0.5 s after the session began."""
    conversation = recorded(tmp_path / "a")
    begin = next(iter(conversation.messages)).time_ns
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
    other = recorded(tmp_path / "b", key=0x00000007, session=0x02)
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
    player.tick(0.0, LATER, lambda _: None)
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
    player = Player(Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), messages), False, 2)
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
    conversation = Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), messages)
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
    with pytest.raises(UserError, match="has no session of a client"), open_recording(path):
        pass


def session_of(samples: int, *streams: int) -> list[Message]:
    """Return a session in which the client writes samples, which an agent does not answer, 1 ms after each other."""
    opened = served(FIRST)[:2]
    written = [
        join(Header(0x81, stream, n & 0xFFFF), [encode(WriteData(n & 0xFFFF, 0x0015, b"1234"))])
        for n in range(samples)
        for stream in streams
    ]
    return [
        Message(n, n * 1_000_000, data is not opened[1], data) for n, data in enumerate(opened + written, 1)
    ]


def test_only_a_part_of_a_long_conversation_is_in_memory() -> None:
    """A client that waits for an answer does not read on without limit, and then sends all in its order."""
    messages = session_of(3 * AHEAD, 1)
    taken: list[int] = []

    def read() -> Iterator[Message]:
        for message in messages:
            taken.append(message.number)
            yield message

    player = Player(Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), Again(read)), False, 2)
    taken.clear()
    sent: list[bytes] = []
    player.tick(0.0, LATER, sent.append)
    assert sent == [messages[0].data]
    assert len(taken) <= AHEAD + 3
    player.receive(messages[1].data, sent.append)
    player.tick(0.1, LATER, sent.append)
    assert sent == [message.data for message in messages if message.of_client]
    assert (player.difference, player.done) == ("", True)


class Again:
    """Messages that are read again each time."""

    def __init__(self, read: Callable[[], Iterator[Message]]) -> None:
        self._read = read

    def __iter__(self) -> Iterator[Message]:
        return self._read()


def test_an_answer_that_arrives_before_its_time() -> None:
    """An agent that is faster than the recorded one is not taken for one that sends more."""
    messages = [Message(n, n * 10**9, n in (1, 4), data) for n, data in enumerate(served(FIRST), 1)]
    player = Player(Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), messages), False, 2)
    sent: list[bytes] = []
    player.tick(0.0, 1e9, sent.append)
    for answer in messages[1:3]:
        player.receive(answer.data, sent.append)
    player.tick(0.1, 1.1e9, sent.append)
    assert (player.compared, player.difference, player.done) == (0, "", False)
    player.tick(3.0, 4e9, sent.append)
    assert (player.compared, player.difference, player.done) == (2, "", True)
    assert sent == [messages[0].data, messages[3].data]


def test_many_answers_that_never_arrive() -> None:
    """The other side is silent where more answers were recorded than are read ahead: the replay goes on to its end."""
    opened = [Message(m.number, m.number, m.of_client, m.data) for m in session_of(0)]
    many = [
        Message(n, n, False, join(Header(0x81, 1, n & 0xFFFF), [encode(Data(10, 0x0016, b"data"))]))
        for n in range(3, 3 * AHEAD)
    ]
    last = Message(3 * AHEAD, 3 * AHEAD, True, served(FIRST)[3])
    player = Player(
        Conversation("udp4 127.0.0.1:1", endpoint("127.0.0.1:2"), [*opened, *many, last]), False, 2
    )
    sent: list[bytes] = []
    player.tick(0.0, LATER, sent.append)
    player.receive(opened[1].data, sent.append)
    for now in (0.1, 1.0, 2.2, 2.3):
        player.tick(now, LATER, sent.append)
    assert player.difference == "packet 3: DATA did not come within 2 s"
    assert (sent, player.done) == ([opened[0].data, last.data], True)
