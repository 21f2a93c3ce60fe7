# SPDX-License-Identifier: Apache-2.0
"""Constants of the protocol (DDS-XRCE 1.0, clauses 7.7, 8.3 and annex A)."""

from __future__ import annotations

from enum import IntEnum
from typing import Final

COOKIE = b"XRCE"
VERSION = b"\x01\x00"
"""Protocol version 1.0: major, minor."""
VENDOR = b"\x01\x0f"
"""The vendor id of the public agent and client; clients of both projects accept it."""

SESSION_NONE_WITH_KEY: Final = 0x00
"""Session ids below 0x80 put the client key into the message header."""
SESSION_NONE_WITHOUT_KEY: Final = 0x80
STREAM_NONE: Final = 0x00
STREAM_BEST_EFFORT: Final = 0x01
"""First of the best-effort streams, 0x01 to 0x7F; STATUS is sent on it."""
STREAM_RELIABLE: Final = 0x80
"""First of the reliable streams, 0x80 to 0xFF; STATUS is sent on it."""

FLAG_LITTLE: Final = 0x01
FLAG_REUSE: Final = 0x02
FLAG_REPLACE: Final = 0x04
FLAG_LAST_FRAGMENT: Final = 0x02
DATA_FORMAT_MASK: Final = 0x0E

INFO_CONFIG: Final = 0x01
INFO_ACTIVITY: Final = 0x02
"""Bits of GET_INFO's mask."""

OBJECT_CLIENT: Final = 0xFFFE
OBJECT_AGENT: Final = 0xFFFD
RELIABLE_WINDOW: Final = 16
"""Maximum number of unacknowledged messages on a reliable stream; an ACKNACK has one bit for each."""


class SubmessageId(IntEnum):
    """First byte of a submessage; clause 8.3.5.(n + 1) describes submessage n."""

    CREATE_CLIENT = 0
    CREATE = 1
    GET_INFO = 2
    DELETE = 3
    STATUS_AGENT = 4
    STATUS = 5
    INFO = 6
    WRITE_DATA = 7
    READ_DATA = 8
    DATA = 9
    ACKNACK = 10
    HEARTBEAT = 11
    RESET = 12
    FRAGMENT = 13
    TIMESTAMP = 14
    TIMESTAMP_REPLY = 15


class ObjectKind(IntEnum):
    """Low four bits of an object id, and discriminator of an object's representation."""

    INVALID = 0x00
    PARTICIPANT = 0x01
    TOPIC = 0x02
    PUBLISHER = 0x03
    SUBSCRIBER = 0x04
    DATAWRITER = 0x05
    DATAREADER = 0x06
    REQUESTER = 0x07
    REPLIER = 0x08
    TYPE = 0x0A
    QOSPROFILE = 0x0B
    APPLICATION = 0x0C
    AGENT = 0x0D
    CLIENT = 0x0E
    OTHER = 0x0F


class Format(IntEnum):
    """How a CREATE describes its object (RepresentationFormat, clause 7.7.3)."""

    REFERENCE = 0x01
    XML = 0x02
    BINARY = 0x03


class DataFormat(IntEnum):
    """Layout of the data in WRITE_DATA, READ_DATA and DATA; bits 1 to 3 of the flags (clause 7.7.1)."""

    DATA = 0x00
    SAMPLE = 0x02
    DATA_SEQ = 0x08
    SAMPLE_SEQ = 0x0A
    PACKED_SAMPLES = 0x0E


class Status(IntEnum):
    """Result of an operation (annex A). OK_MATCHED, too, means success."""

    OK = 0x00
    OK_MATCHED = 0x01
    DDS_ERROR = 0x80
    MISMATCH = 0x81
    ALREADY_EXISTS = 0x82
    DENIED = 0x83
    UNKNOWN_REFERENCE = 0x84
    INVALID_DATA = 0x85
    INCOMPATIBLE = 0x86
    RESOURCES = 0x87


def is_reliable(stream: int) -> bool:
    """Return whether stream id `stream` (0 to 255) belongs to a reliable stream."""
    return stream >= STREAM_RELIABLE
