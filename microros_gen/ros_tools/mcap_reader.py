# SPDX-License-Identifier: Apache-2.0
"""Reads MCAP files (mcap.dev/spec): those of `mcap`, and those of other recorders without compression.

The file is looked through once, chunk by chunk, and not kept: where chunks are, their times, topics and numbers of
messages. So a file whose recorder was killed is read like others, up to its last whole record.
"""

from __future__ import annotations

import heapq
import struct
import zlib
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO

from microros_gen.records import dataclass
from microros_gen.ros_tools.mcap import MAGIC

LARGEST_RECORD = 1 << 30
"""Bytes; a longer record is taken for damage."""
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _DATA_END, _FOOTER = 3, 4, 5, 6, 15, 2
_HEAD = struct.Struct("<BQ")
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_CHUNK_HEAD = struct.Struct("<QQQI")
Record = tuple[int, memoryview]


class McapError(Exception):
    """A file that cannot be read, with the reason."""


@dataclass(frozen=True)
class Channel:
    """A topic of a file: the name of its type (empty: unknown), the encoding of its messages, and remarks."""

    topic: str
    type: str
    encoding: str
    metadata: Mapping[str, str]


@dataclass(frozen=True)
class Recorded:
    """A message: its channel, the time at which it was recorded in nanoseconds since 1970, and its bytes."""

    channel: int
    time: int
    data: bytes


@dataclass(frozen=True)
class _Part:
    """A chunk, or a message outside of chunks: where its record is, and the times of its messages."""

    low: int
    high: int
    place: int


class McapReader:
    """What a file has. `channels` by their numbers; `counts` of messages by channel; `first` and `last` times."""

    def __init__(self, path: Path) -> None:
        """Look the file through. Raises McapError if it is no MCAP file, is damaged or compressed; OSError."""
        self._path = path
        self.channels: dict[int, Channel] = {}
        self.counts: Counter[int] = Counter()
        self.complete = False
        """Whether the recorder has completed the file."""
        self._types: dict[int, str] = {0: ""}
        self._parts: list[_Part] = []
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise McapError("it is no MCAP file")
            try:
                self._look(file)
            except (struct.error, UnicodeDecodeError, IndexError) as error:
                raise McapError(f"it is damaged: {error}") from error
        self.first = min((part.low for part in self._parts), default=0)
        self.last = max((part.high for part in self._parts), default=0)

    def messages(self, channels: Collection[int], begin: int = 0) -> Iterator[Recorded]:
        """Yield the messages of some channels from a time on, by their times; equal ones in the order of the file.

        Chunks that overlap in time are in memory together. Raises McapError, OSError.
        """
        waiting: list[tuple[int, int, int, Recorded]] = []
        with self._path.open("rb") as file:
            for part in sorted(self._parts, key=lambda part: (part.low, part.place)):
                if part.high < begin:
                    continue
                while waiting and waiting[0][0] < part.low:
                    yield heapq.heappop(waiting)[3]
                file.seek(part.place)
                for number, message in enumerate(self._of_part(file)):
                    if message.channel in channels and message.time >= begin:
                        heapq.heappush(waiting, (message.time, part.place, number, message))
        while waiting:
            yield heapq.heappop(waiting)[3]

    def _look(self, file: BinaryIO) -> None:
        while True:
            place = file.tell()
            record = _next(file)
            if record is None:
                return
            kind, content = record
            if kind in (_DATA_END, _FOOTER):
                self.complete = True  # only the summary follows, which repeats what was read
                return
            before = self.counts.total()
            times = [self._note(*inner) for inner in (_inner(content) if kind == _CHUNK else (record,))]
            found = [time for time in times if time is not None]
            if self.counts.total() > before:
                self._parts.append(_Part(min(found), max(found), place))

    def _note(self, kind: int, content: memoryview) -> int | None:
        """Take what a record says; return the time of a message."""
        if kind == _SCHEMA:
            (number,) = struct.unpack_from("<H", content)
            self._types[number] = _text(content, 2)[0]
        elif kind == _CHANNEL:
            number, schema = struct.unpack_from("<HH", content)
            topic, at = _text(content, 4)
            encoding, at = _text(content, at)
            if schema not in self._types:
                raise McapError(f"topic {topic} has a type that the file does not declare")
            self.channels[number] = Channel(topic, self._types[schema], encoding, _map(content, at))
        elif kind == _MESSAGE:
            channel, _, time, _ = _MESSAGE_HEAD.unpack_from(content)
            if channel not in self.channels:
                raise McapError(f"a message belongs to channel {channel}, which the file does not declare")
            self.counts[channel] += 1
            return int(time)
        return None

    @staticmethod
    def _of_part(file: BinaryIO) -> Iterator[Recorded]:
        record = _next(file)
        if record is None:
            raise McapError("it became shorter meanwhile")
        for kind, content in _inner(record[1]) if record[0] == _CHUNK else (record,):
            if kind == _MESSAGE:
                channel, _, time, _ = _MESSAGE_HEAD.unpack_from(content)
                yield Recorded(channel, time, bytes(content[_MESSAGE_HEAD.size :]))


def _next(file: BinaryIO) -> Record | None:
    """Return the next record; None at the end, and for one that is not complete."""
    head = file.read(_HEAD.size)
    if len(head) < _HEAD.size:
        return None
    kind, size = _HEAD.unpack(head)
    if size > LARGEST_RECORD:
        raise McapError(f"it is damaged: a record has a length of {size} bytes")
    content = file.read(size)
    return (kind, memoryview(content)) if len(content) == size else None


def _inner(chunk: memoryview) -> Iterator[Record]:
    """Yield the records in a chunk."""
    _, _, size, checksum = _CHUNK_HEAD.unpack_from(chunk)
    compression, at = _text(chunk, _CHUNK_HEAD.size)
    if compression:
        raise McapError(f"it is compressed ({compression})")
    (stored,) = struct.unpack_from("<Q", chunk, at)
    records = chunk[at + 8 : at + 8 + stored]
    if len(records) != size or (checksum and zlib.crc32(records) != checksum):
        raise McapError("it is damaged: a chunk has another checksum")
    at = 0
    while at < len(records):
        kind, length = _HEAD.unpack_from(records, at)
        at += _HEAD.size
        if at + length > len(records):
            raise McapError("it is damaged: a record is longer than its chunk")
        yield kind, records[at : at + length]
        at += length


def _text(content: memoryview, at: int) -> tuple[str, int]:
    """Return the text at a place, and the place after it."""
    (size,) = struct.unpack_from("<I", content, at)
    end = at + 4 + size
    if end > len(content):
        raise McapError("it is damaged: a text is longer than its record")
    return bytes(content[at + 4 : end]).decode(), end


def _map(content: memoryview, at: int) -> Mapping[str, str]:
    (size,) = struct.unpack_from("<I", content, at)
    at, end = at + 4, at + 4 + size
    found: dict[str, str] = {}
    while at < end:
        key, at = _text(content, at)
        found[key], at = _text(content, at)
    return MappingProxyType(found)
