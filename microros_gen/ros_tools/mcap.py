# SPDX-License-Identifier: Apache-2.0
"""Recordings in MCAP files as ROS 2's rosbag2 writes and plays them (mcap.dev/spec, profile `ros2`).

Messages are in chunks without compression, each with its index, so that players can seek. A file whose writer was
killed lacks the summary at its end; readers find the complete chunks without it.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Mapping
from typing import BinaryIO

from microros_gen.records import dataclass

MAGIC = b"\x89MCAP0\r\n"
CHUNK_BYTES = 256 * 1024
"""Bytes of messages after which a chunk is written: what a killed recorder loses at most."""
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _MESSAGE_INDEX, _CHUNK_INDEX = range(1, 9)
_STATISTICS, _DATA_END = 0x0B, 0x0F
_NO_SCHEMA = 0


@dataclass(frozen=True)
class Schema:
    """The definition of a type: `encoding` is ros2msg or ros2idl."""

    name: str
    encoding: str
    text: str


class McapWriter:
    """Writes one file. Not thread-safe; `close` completes it."""

    def __init__(self, file: BinaryIO, library: str, chunk_bytes: int = CHUNK_BYTES) -> None:
        """Write to `file`, which stays open; `library` names the writer."""
        self._file = file
        self._position = 0
        self._chunk_bytes = chunk_bytes
        self._schemas: dict[Schema, int] = {}
        self._channels: list[bytes] = []
        self._counts: list[int] = []
        self._chunk = bytearray()
        self._indexes: dict[int, list[tuple[int, int]]] = {}
        self._chunk_indexes: list[bytes] = []
        self._all_times: list[int] = []
        self._times: list[int] = []
        """Times of the first and the last message by time: of the file, of the chunk; empty before the first."""
        self._write(MAGIC)
        self._write(_record(_HEADER, _text("ros2") + _text(library)))

    def add_channel(self, topic: str, schema: Schema | None, metadata: Mapping[str, str]) -> int:
        """Declare a topic; return the number for `add`. Without `schema`, players need the type from elsewhere."""
        number = _NO_SCHEMA
        if schema is not None:
            number = self._schemas.get(schema, 0)
            if not number:
                number = self._schemas[schema] = len(self._schemas) + 1
                self._chunk += _schema_record(number, schema)
        channel = len(self._channels)
        record = _record(
            _CHANNEL,
            struct.pack("<HH", channel, number) + _text(topic) + _text("cdr") + _map(metadata.items()),
        )
        self._channels.append(record)
        self._counts.append(0)
        self._chunk += record
        return channel

    def add(self, channel: int, data: bytes, log_time: int, publish_time: int) -> None:
        """Add a message: encapsulation and CDR body; times in nanoseconds since 1970."""
        for times in (self._times, self._all_times):
            times[:] = [min(*times, log_time), max(*times, log_time)] if times else [log_time, log_time]
        self._indexes.setdefault(channel, []).append((log_time, len(self._chunk)))
        head = struct.pack("<HIQQ", channel, self._counts[channel] & 0xFFFFFFFF, log_time, publish_time)
        self._counts[channel] += 1
        self._chunk += _record(_MESSAGE, head + data)
        if len(self._chunk) >= self._chunk_bytes:
            self._end_chunk()

    def close(self) -> None:
        """Write what is left, and the summary."""
        self._end_chunk()
        self._write(_record(_DATA_END, struct.pack("<I", 0)))
        start = self._position
        schemas = (_schema_record(number, schema) for schema, number in self._schemas.items())
        summary = b"".join((*schemas, *self._channels, self._statistics(), *self._chunk_indexes))
        self._write(summary)
        footer = struct.pack("<BQQQ", _FOOTER, 20, start, 0)  # and the CRC of the summary up to here
        self._write(footer + struct.pack("<I", zlib.crc32(summary + footer)))
        self._write(MAGIC)
        self._file.flush()

    def _end_chunk(self) -> None:
        if not self._chunk:
            return
        low, high = self._times or (0, 0)
        data = bytes(self._chunk)
        start = self._position
        head = struct.pack("<QQQI", low, high, len(data), zlib.crc32(data)) + _text("")
        chunk = _record(_CHUNK, head + struct.pack("<Q", len(data)) + data)
        self._write(chunk)
        offsets: list[tuple[int, int]] = []
        index_start = self._position
        for channel, entries in sorted(self._indexes.items()):
            offsets.append((channel, self._position))
            packed = b"".join(struct.pack("<QQ", *entry) for entry in entries)
            self._write(_record(_MESSAGE_INDEX, struct.pack("<HI", channel, len(packed)) + packed))
        packed_offsets = b"".join(struct.pack("<HQ", *offset) for offset in offsets)
        self._chunk_indexes.append(
            _record(
                _CHUNK_INDEX,
                struct.pack("<QQQQI", low, high, start, len(chunk), len(packed_offsets))
                + packed_offsets
                + struct.pack("<Q", self._position - index_start)
                + _text("")
                + struct.pack("<QQ", len(data), len(data)),
            )
        )
        self._chunk.clear()
        self._indexes.clear()
        self._times.clear()
        self._file.flush()

    def _statistics(self) -> bytes:
        counts = b"".join(struct.pack("<HQ", i, count) for i, count in enumerate(self._counts) if count)
        numbers = struct.pack(
            "<QHIIIIQQI",
            sum(self._counts),
            len(self._schemas),
            len(self._channels),
            0,
            0,
            len(self._chunk_indexes),
            *(self._all_times or (0, 0)),
            len(counts),
        )
        return _record(_STATISTICS, numbers + counts)

    def _write(self, data: bytes) -> None:
        self._file.write(data)
        self._position += len(data)


def _record(kind: int, content: bytes) -> bytes:
    return struct.pack("<BQ", kind, len(content)) + content


def _schema_record(number: int, schema: Schema) -> bytes:
    data = schema.text.encode()
    named = struct.pack("<H", number) + _text(schema.name) + _text(schema.encoding)
    return _record(_SCHEMA, named + struct.pack("<I", len(data)) + data)


def _text(text: str) -> bytes:
    data = text.encode()
    return struct.pack("<I", len(data)) + data


def _map(entries: Iterable[tuple[str, str]]) -> bytes:
    data = b"".join(_text(key) + _text(value) for key, value in entries)
    return struct.pack("<I", len(data)) + data
