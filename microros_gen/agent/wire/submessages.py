# SPDX-License-Identifier: Apache-2.0
"""Decoding and encoding of all sixteen submessages, by id."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from microros_gen.agent.wire.cdr import Reader, Writer
from microros_gen.agent.wire.constants import FLAG_LITTLE, SubmessageId
from microros_gen.agent.wire.data_messages import Data, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import (
    Acknack,
    Create,
    Delete,
    Fragment,
    Heartbeat,
    Reset,
    StatusReply,
)
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import submessage_bytes
from microros_gen.agent.wire.session_messages import (
    CreateClient,
    GetInfo,
    Info,
    StatusAgent,
    Timestamp,
    TimestampReply,
)


class Submessage(Protocol):
    """The interface of all submessages."""

    @property
    def ID(self) -> SubmessageId:  # noqa: N802
        """The first byte on the wire."""

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""


class _Decoder(Protocol):
    def __call__(self, reader: Reader, flags: int) -> Submessage: ...


_DECODERS: Mapping[int, _Decoder] = MappingProxyType(
    {
        kind.ID: kind.decode
        for kind in (
            CreateClient,
            Create,
            GetInfo,
            Delete,
            StatusAgent,
            StatusReply,
            Info,
            WriteData,
            ReadData,
            Data,
            Acknack,
            Heartbeat,
            Reset,
            Fragment,
            Timestamp,
            TimestampReply,
        )
    }
)


def decode(identifier: int, flags: int, data: bytes, start: int, end: int) -> Submessage:
    """Return the submessage whose payload is `data[start:end]`. Raises MalformedError if it is invalid."""
    decoder = _DECODERS.get(identifier)
    if decoder is None:
        raise MalformedError("submessage_id", f"id {identifier:#04x}")
    return decoder(Reader(data, start, end, bool(flags & FLAG_LITTLE)), flags)


def encode(submessage: Submessage, little: bool = True) -> bytes:
    """Return a submessage with its header, in little or big endian."""
    writer = Writer(little)
    flags = submessage.encode(writer)
    return submessage_bytes(submessage.ID, writer.content(), flags | (FLAG_LITTLE if little else 0))
