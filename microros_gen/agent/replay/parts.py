# SPDX-License-Identifier: Apache-2.0
"""The submessages of one side, in the order of their streams and each once, so that two runs can be compared.

Acknowledgements and heartbeats depend on the time alone and are left out.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields, is_dataclass, replace
from typing import Any

from microros_gen.agent.wire.constants import (
    RELIABLE_WINDOW,
    STREAM_NONE,
    ObjectKind,
    SubmessageId,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import Data, WriteData
from microros_gen.agent.wire.entity_messages import Acknack, Heartbeat
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.session_messages import CreateClient, TimestampReply
from microros_gen.agent.wire.submessages import decode
from microros_gen.records import dataclass

IDENTITY = 24
"""Bytes of the SampleIdentity in front of a request or reply of a replier: DDS gives others in each run."""
_HALF = 0x8000


@dataclass(frozen=True)
class Part:
    """A submessage: the number of its packet, its session (from 1) and stream, its name, and what it holds."""

    number: int
    session: int
    stream: int
    name: str
    content: Any


@dataclass(frozen=True)
class Taken:
    """What a message brought: new parts, and what it says about acknowledgements."""

    parts: tuple[Part, ...] = ()
    acknacks: tuple[Acknack, ...] = ()
    heartbeats: tuple[Heartbeat, ...] = ()


class Receiver:
    """The receiving end of one side's streams."""

    def __init__(self, skipped: Collection[str] = ()) -> None:
        """Leave out submessages with these names."""
        self._skipped = frozenset(skipped)
        self._session = 0
        self._last: list[tuple[str, Any]] = []
        self.expected: dict[int, int] = {}
        """Next sequence number of each reliable stream."""
        self._newest: dict[int, int] = {}
        self._early: dict[tuple[int, int], tuple[int, bytes]] = {}

    def reset(self) -> None:
        """Begin a session: all streams are at their start."""
        self._session += 1
        self._last = []
        self.expected.clear()
        self._newest.clear()
        self._early.clear()

    def take(self, data: bytes, number: int = 0) -> Taken:
        """Return what is new in a message; a malformed one is a part named `malformed`."""
        try:
            head = Header.decode(data)
            spans = split(data, header_size(data))
        except MalformedError:
            return Taken((Part(number, self._session, STREAM_NONE, "malformed", data),))
        if is_reliable(head.stream):
            return Taken(tuple(self._in_order(head, number, data)))
        if head.stream != STREAM_NONE and not self._is_newer(head):
            return Taken()
        found = [_decoded(data, span) for span in spans]
        if head.stream == STREAM_NONE and any(isinstance(each, CreateClient) for _, each in found):
            repeated = found == self._last
            if not repeated:
                self.reset()
        acknacks = tuple(each for _, each in found if isinstance(each, Acknack))
        heartbeats = tuple(each for _, each in found if isinstance(each, Heartbeat))
        kept = [(name, each) for name, each in found if not isinstance(each, Acknack | Heartbeat)]
        if head.stream == STREAM_NONE and kept:
            if kept == self._last:
                return Taken((), acknacks, heartbeats)  # sent again, without an answer
            self._last = kept
        return Taken(self._parts(kept, head.stream, number), acknacks, heartbeats)

    def skip_to(self, stream: int, first: int) -> list[Part]:
        """Give up what the sender no longer has: messages of a stream before `first`; return what follows."""
        if 0 < (first - self.expected.get(stream, 0)) & 0xFFFF < _HALF:
            self.expected[stream] = first
        return self._drain(stream)

    def missing(self, stream: int, last: int) -> int:
        """Return the messages up to `last` that have not come, as the bitmap of an ACKNACK; bit 0 is the next one."""
        first = self.expected.get(stream, 0)
        count = (last - first + 1) & 0xFFFF
        if count > RELIABLE_WINDOW:  # all arrived
            return 0
        return sum(1 << i for i in range(count) if (stream, (first + i) & 0xFFFF) not in self._early)

    def _in_order(self, head: Header, number: int, data: bytes) -> list[Part]:
        ahead = (head.sequence - self.expected.get(head.stream, 0)) & 0xFFFF
        if ahead < _HALF:
            self._early.setdefault((head.stream, head.sequence), (number, data))
        self.expected.setdefault(head.stream, 0)
        return self._drain(head.stream)

    def _drain(self, stream: int) -> list[Part]:
        parts: list[Part] = []
        while (found := self._early.pop((stream, self.expected.get(stream, 0)), None)) is not None:
            number, data = found
            self.expected[stream] = (self.expected.get(stream, 0) + 1) & 0xFFFF
            spans = split(data, header_size(data))
            parts += self._parts([_decoded(data, span) for span in spans], stream, number)
        return parts

    def _is_newer(self, head: Header) -> bool:
        last = self._newest.get(head.stream, 0xFFFF)
        if not 0 < (head.sequence - last) & 0xFFFF < _HALF:
            return False
        self._newest[head.stream] = head.sequence
        return True

    def _parts(self, found: list[tuple[str, Any]], stream: int, number: int) -> tuple[Part, ...]:
        return tuple(
            Part(number, self._session, stream, name, each)
            for name, each in found
            if name not in self._skipped
        )


def difference(recorded: Part, received: Part) -> str:
    """Return how two parts differ, in words; empty: they do not, apart from keys, times and identities of a run."""
    if recorded.name != received.name:
        return f"{recorded.name} was recorded, {received.name} was received"
    first, second = comparable(recorded.content), comparable(received.content)
    if first == second:
        return ""
    if not is_dataclass(first) or not is_dataclass(second):
        return f"{recorded.name}: {_short(first)} was recorded, {_short(second)} was received"
    differing = [
        f"{field.name} {_short(before)} was recorded, {_short(after)} was received"
        for field in fields(first)
        if (before := getattr(first, field.name)) != (after := getattr(second, field.name))
    ]
    return f"{recorded.name}: {'; '.join(differing)}"


def comparable(content: Any) -> Any:
    """Return a submessage without what differs in each run: the session's key and id, times, identities of requests."""
    if isinstance(content, CreateClient):
        return replace(content, key=b"", session=0)
    if isinstance(content, TimestampReply):
        return content.originate
    if isinstance(content, Data | WriteData) and content.object & 0x0F == ObjectKind.REPLIER:
        return replace(content, data=content.data[IDENTITY:])
    return content


def _decoded(data: bytes, span: tuple[int, int, int, int]) -> tuple[str, Any]:
    identifier, flags, start, end = span
    known = identifier <= SubmessageId.TIMESTAMP_REPLY
    name = SubmessageId(identifier).name if known else f"{identifier:#04x}"
    try:
        return name, decode(identifier, flags, data, start, end)
    except MalformedError:
        return name, data[start:end]


def _short(value: Any) -> str:
    text = value.hex(" ") if isinstance(value, bytes) else str(value)
    return text if len(text) <= 80 else f"{text[:80]}…"
