# SPDX-License-Identifier: Apache-2.0
"""Messages: a header followed by submessages (DDS-XRCE 1.0, clauses 8.3.2 to 8.3.4)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from microros_gen.agent.wire.constants import FLAG_LITTLE, SubmessageId
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

CREATE_CLIENT: Final = int(SubmessageId.CREATE_CLIENT)
MOST_REQUESTS: Final = 256
"""Maximum number of submessages in a message, samples not counted: each may take ROS 2 a millisecond."""
SUBMESSAGE_HEADER: Final = 4
"""Number of bytes of a submessage header."""
Span = tuple[int, int, int, int]
"""One submessage in a message: id, flags, offset of its payload, offset after its payload."""


@dataclass(frozen=True)
class Header:
    """Header of a message. `key` has 4 bytes for session ids below 0x80, otherwise it is empty."""

    session: int
    stream: int
    sequence: int
    key: bytes = b""

    def encode(self) -> bytes:
        """Return its 4 or 8 bytes."""
        return header_bytes(self.session, self.stream, self.sequence, self.key)

    @staticmethod
    def decode(data: bytes) -> Header:
        """Read the header of `data`. Raises MalformedError if it is truncated."""
        size = header_size(data)
        return Header(data[0], data[1], data[2] | data[3] << 8, bytes(data[4:size]))


def header_bytes(session: int, stream: int, sequence: int, key: bytes) -> bytes:
    """Return a message header; `key` (4 bytes) is omitted for session ids from 0x80."""
    head = bytes((session, stream, sequence & 0xFF, sequence >> 8))
    return head + key if session < 0x80 else head


def header_size(data: bytes) -> int:
    """Return the size of the header of `data`, 4 or 8 bytes. Raises MalformedError if `data` is shorter."""
    size = 4 if data and data[0] >= 0x80 else 8
    if len(data) < size:
        raise MalformedError("short_header", f"{len(data)} bytes")
    return size


def split(data: bytes, at: int, rest_when_zero: bool = False) -> list[Span]:
    """Return the submessages of `data` from offset `at`, the end of the message header.

    Submessage headers are aligned to 4 bytes from the start of `data`. With `rest_when_zero`, a WRITE_DATA of length 0
    extends to the end of `data`, which is how a client sends more than 65,535 bytes in fragments. A CREATE_CLIENT of 16
    bytes with properties extends to the end as well: the public client (2.4, 3.0) does not count them. Trailing bytes
    too few for a header are padding. Raises MalformedError if a payload exceeds the message, or if there are more than
    `MOST_REQUESTS` submessages other than samples.
    """
    found: list[Span] = []
    size = len(data)
    while at + SUBMESSAGE_HEADER <= size:
        end = at + SUBMESSAGE_HEADER + (data[at + 2] | data[at + 3] << 8)
        if rest_when_zero and data[at] == SubmessageId.WRITE_DATA and end == at + SUBMESSAGE_HEADER:
            end = size
        if data[at] == CREATE_CLIENT and end == at + SUBMESSAGE_HEADER + 16 <= size and data[end - 3]:
            end = size
        if end > size:
            raise MalformedError("submessage_length", f"{end - size} bytes more than there are")
        found.append((data[at], data[at + 1], at + SUBMESSAGE_HEADER, end))
        at = end + (-end & 3)
    if len(found) > MOST_REQUESTS:
        _check_requests(found)
    return found


def is_cut(data: bytes, at: int) -> bool:
    """Return whether the submessages of `data`, whose header ends at `at`, are truncated or missing.

    A network may have lost the end of such a message; a reliable stream treats it as lost and gets it again.
    """
    size = len(data)
    if at + SUBMESSAGE_HEADER > size:
        return True
    while at + SUBMESSAGE_HEADER <= size:
        at += SUBMESSAGE_HEADER + (data[at + 2] | data[at + 3] << 8)
        if at >= size:
            return at > size
        at += -at & 3
    return False


def _check_requests(spans: list[Span]) -> None:
    requests = sum(span[0] != SubmessageId.WRITE_DATA for span in spans)
    if requests > MOST_REQUESTS:
        raise MalformedError("too_many_requests", f"{requests} in one message")


def submessage_bytes(identifier: int, payload: bytes, flags: int = FLAG_LITTLE) -> bytes:
    """Return a submessage with its header; `payload` has at most 65,535 bytes."""
    return bytes((identifier, flags, len(payload) & 0xFF, len(payload) >> 8)) + payload


def join(header: Header, submessages: Iterable[bytes]) -> bytes:
    """Return one message of complete submessages, each aligned to 4 bytes; padding bytes are 0."""
    out = bytearray(header.encode())
    for submessage in submessages:
        out += bytes(-len(out) & 3)
        out += submessage
    return bytes(out)
