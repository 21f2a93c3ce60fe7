# SPDX-License-Identifier: Apache-2.0
"""Messages of sealed links: their layouts.

All numbers are little endian. Each of them begins with its type, the version 1 and two zero bytes:

- first message of a handshake: index of the client (4 bytes), client key (4), then 48 bytes of Noise;
- second message: index of the agent (4), index of the client (4), then 48 bytes of Noise;
- record: index of the receiver (4), counter (8), then the sealed message and its tag (16);
- refusal: index of the client (4), and the reason in place of the first zero byte.
"""

from __future__ import annotations

import struct
from enum import IntEnum

VERSION = 1
LABEL = b"microros-gen seal"
"""First part of the prologue; the second one is what precedes Noise in the first message."""
FIRST = struct.Struct("<BBHII")
RECORD = struct.Struct("<BBHIQ")
REFUSAL = struct.Struct("<BBBBI")


class Kind(IntEnum):
    """First byte of a message of a sealed link."""

    FIRST = 1
    SECOND = 2
    RECORD = 3
    REFUSAL = 4


class Reason(IntEnum):
    """Why a handshake is refused."""

    UNKNOWN_KEY = 1
    OTHER_KEY = 2
    OTHER_VERSION = 3


def worker_of(data: bytes, workers: int) -> int | None:
    """Return which of several workers a message from a client is for; None: it is not sealed.

    A handshake is for that of its client key, a record for that which chose its index. Both are in each message, so
    nothing that others send changes where those of a client go.
    """
    kind = data[0] if data else 0
    if kind == Kind.FIRST and len(data) >= FIRST.size:
        key: int = FIRST.unpack_from(data)[4]
        return key % workers
    if kind == Kind.RECORD and len(data) >= RECORD.size:
        index: int = RECORD.unpack_from(data)[3]
        return index % workers
    return None
