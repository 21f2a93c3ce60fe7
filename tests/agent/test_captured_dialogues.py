# SPDX-License-Identifier: Apache-2.0
"""Public clients as recorded, with the public agent's answers: this agent gives the same ones, by their meaning.

`dialogues/` holds what went over the wire. The client's half is replayed; where the record has the agent send a
sample, request or reply, the ROS side (a fake) has it at that moment. Bytes are read here on their own, without the
agent's decoders.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from microros_gen.agent.framing import FrameDecoder, LengthDecoder, encode_frame, encode_length
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.diagnostics import Source
from tests.support.agent.fakes import Bench

HERE = Path(__file__).parent / "dialogues"
STATUS, INFO, DATA, ACKNACK, HEARTBEAT, FRAGMENT, TIME = 0x05, 0x06, 0x09, 0x0A, 0x0B, 0x0D, 0x0F
READER, REQUESTER, REPLIER = 6, 7, 8
ENCAPSULATION = bytes((0, 1, 0, 0))
IDENTITY = 24
MADE = [
    "61:/peer_node",
    "/peer_up [std_msgs/msg/String]",
    "/peer_down [std_msgs/msg/String]",
    "/peer_add [rcl_interfaces/srv/GetParameterTypes]",
    "/peer_srv [rcl_interfaces/srv/GetParameterTypes]",
]
"""What the clients of 2.4.3 make in ROS 2 (domain 61, or 62 where recorded so)."""

Meaning = tuple[object, ...]


@dataclass
class Side:
    """What one side sent, read message by message."""

    acknowledged: dict[int, int] = field(default_factory=dict)
    chunks: bytes = b""

    def read(self, message: bytes) -> Iterator[Meaning]:
        """Yield what a message means, without what only keeps streams going."""
        start = 4 if message[0] >= 0x80 else 8
        head = (message[0], "reliable" if message[1] >= 0x80 else message[1], message[4:start])
        at = start
        while at + 4 <= len(message):
            kind, length = message[at], int.from_bytes(message[at + 2 : at + 4], "little")
            payload = message[at + 4 : at + 4 + length]
            assert len(payload) == length
            if kind == FRAGMENT:
                self.chunks += payload
                if message[at + 1] & 2:
                    yield (*head, *meaning(self.chunks[0], self.chunks[4:]))
                    self.chunks = b""
            elif kind == ACKNACK:
                self.acknowledged[payload[4]] = int.from_bytes(payload[:2], "little")
            elif kind != HEARTBEAT:
                yield (*head, *meaning(kind, payload))
            at += 4 + length + (-length & 3)


def meaning(kind: int, payload: bytes) -> Meaning:
    """Return a submessage without the agent's clock."""
    return (kind, payload[16:] if kind == TIME else payload)


Line = tuple[str, bytes]
"""Direction and bytes."""


def lines(name: str) -> list[Line]:
    """Return each line of a dialogue."""
    text = (HERE / f"{name}.txt").read_text(encoding="ascii")
    return [(line[0], bytes.fromhex(line[2:])) for line in text.splitlines() if line[0] != "#"]


def unframed(chunks: Iterable[Line], feed: dict[str, Callable[[bytes], list[bytes]]]) -> list[Line]:
    """Return the messages of a byte stream that was recorded in parts."""
    return [(direction, message) for direction, chunk in chunks for message in feed[direction](chunk)]


class Replay:
    """An agent that is told what the client of a record said."""

    def __init__(self, dialogue: Iterable[Line]) -> None:
        references = HERE / "references.xml"
        self.bench = Bench(
            references=read_references([Source(str(references), references.read_text("ascii"))])
        )
        self.record, self.agent = Side(), Side()
        self.waiting: list[Meaning] = []
        self.graph: list[str] = []
        for direction, message in dialogue:
            if direction == ">":
                self._note(self.bench.say(message))
                self.graph = max(self.graph, list(self.bench.bridge.graph), key=len)
                continue
            for wanted in self.record.read(message):
                if wanted[3] == DATA and isinstance(wanted[4], bytes):
                    self._provide(wanted[4])
                assert self.waiting[:1] == [wanted]
                del self.waiting[0]
            for stream, first in self.record.acknowledged.items():
                assert self.agent.acknowledged[stream] - first & 0xFFFF < 0x8000, "acknowledged as early"

    def _note(self, answers: list[str]) -> None:
        for answer in answers:
            self.waiting.extend(self.agent.read(bytes.fromhex(answer)))

    def _provide(self, payload: bytes) -> None:
        """Let the ROS side have what the recorded agent delivered."""
        (client,) = self.bench.agent.clients
        entity = client.objects.find(payload[2] << 8 | payload[3])
        assert entity is not None
        body, kind = payload[4:], payload[3] & 0x0F
        source = entity.source
        if kind == READER:
            source.put(ENCAPSULATION + body)  # type: ignore[union-attr]
        elif kind == REPLIER:
            source.put((body[:IDENTITY], ENCAPSULATION + body[IDENTITY:]))  # type: ignore[union-attr]
        else:
            source.put((source.requests[-1][0], ENCAPSULATION + body[4:]))  # type: ignore[union-attr]
        self._note(self.bench.take())


@pytest.mark.parametrize("name", sorted(path.stem for path in HERE.glob("*.txt")))
def test_a_recorded_client_is_answered_as_by_the_public_agent(name: str) -> None:
    replay = Replay(lines(name))
    assert replay.waiting == [], "nothing more than the public agent says"
    assert replay.bench.bridge.graph == [], "the client said good-bye"
    assert replay.bench.log.counters == {}, "no fault is found in what public clients send"


@pytest.mark.parametrize(
    "name", ["binary", "xml", "reference", "session_with_key", "fragments", "best_effort"]
)
def test_every_representation_gives_the_same_entities_in_ros(name: str) -> None:
    replay = Replay(lines(name))
    assert [text.replace("62:", "61:") for text in replay.graph] == MADE
    size = 1500 if name == "fragments" else 16
    samples = [b"m%09d" % n + bytes(97 + (i + n) % 26 for i in range(10, size)) for n in (1, 2)]
    found = [(label, body[8 : 8 + size]) for label, body in replay.bench.bridge.published]
    assert found == [(MADE[1], sample) for sample in samples[: 1 if size > 400 else 2]]


def test_the_same_over_tcp() -> None:
    chunks = lines("streams/tcp")
    messages = unframed(chunks, {">": LengthDecoder().feed, "<": LengthDecoder().feed})
    replay = Replay(messages)
    assert (replay.waiting, replay.bench.log.counters) == ([], {})
    for side in "<>":
        sent = b"".join(chunk for direction, chunk in chunks if direction == side)
        assert sent == b"".join(
            encode_length(message) for direction, message in messages if direction == side
        )


def test_the_same_over_a_serial_line() -> None:
    chunks = lines("streams/serial")
    faults: list[tuple[str, str]] = []
    agent, client = (FrameDecoder(lambda *fault: faults.append(fault), address) for address in (0, 1))

    def from_client(chunk: bytes) -> list[bytes]:
        return [payload for source, payload in agent.feed(chunk) if source == 1]

    def from_agent(chunk: bytes) -> list[bytes]:
        return [payload for source, payload in client.feed(chunk) if source == 0]

    messages = unframed(chunks, {">": from_client, "<": from_agent})
    replay = Replay(messages)
    assert (replay.waiting, replay.bench.log.counters, faults) == ([], {}, [])
    for side, source in ((">", 1), ("<", 0)):
        sent = b"".join(chunk for direction, chunk in chunks if direction == side)
        frames = (encode_frame(m, 1 - source, source) for direction, m in messages if direction == side)
        assert sent == b"".join(frames)
