# SPDX-License-Identifier: Apache-2.0
"""Where the messages of each conversation are in a file: kept in a temporary file, so that memory stays small."""

from __future__ import annotations

import struct
from collections.abc import Hashable, Iterator
from tempfile import TemporaryFile
from types import TracebackType

from microros_gen.records import dataclass

_ENTRY = struct.Struct("<QQ?QI")
ENTRIES_OF_BLOCK = 512
"""Entries of a conversation that are written together; in memory there are at most so many, and 8 bytes per block."""


@dataclass(frozen=True)
class Entry:
    """A message: number of its packet, time, whether the client sent it; place and size of the packet in bytes."""

    number: int
    time_ns: int
    of_client: bool
    at: int
    size: int


class MessageIndex:
    """Entries by conversation, in the order in which they were added."""

    def __init__(self) -> None:
        """Create the temporary file. Raises OSError."""
        self._file = TemporaryFile()  # noqa: SIM115 - closed with this object
        self._blocks: dict[Hashable, list[int]] = {}
        self._open: dict[Hashable, bytearray] = {}

    def __enter__(self) -> MessageIndex:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def add(self, name: Hashable, entry: Entry) -> None:
        """Add a message to a conversation. Raises OSError if the disk is full."""
        block = self._open.setdefault(name, bytearray())
        block += _ENTRY.pack(entry.number, entry.time_ns, entry.of_client, entry.at, entry.size)
        if len(block) == ENTRIES_OF_BLOCK * _ENTRY.size:
            self._file.seek(0, 2)
            self._blocks.setdefault(name, []).append(self._file.tell())
            self._file.write(block)
            block.clear()

    def entries(self, name: Hashable) -> Iterator[Entry]:
        """Return the messages of a conversation. Raises OSError."""
        for at in self._blocks.get(name, ()):
            self._file.seek(at)
            yield from _entries(self._file.read(ENTRIES_OF_BLOCK * _ENTRY.size))
        yield from _entries(bytes(self._open.get(name, b"")))


def _entries(block: bytes) -> Iterator[Entry]:
    return (Entry(*values) for values in _ENTRY.iter_unpack(block))
