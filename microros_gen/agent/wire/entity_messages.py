# SPDX-License-Identifier: Apache-2.0
"""Submessages about objects and streams: CREATE, DELETE, STATUS, ACKNACK, HEARTBEAT, RESET, FRAGMENT."""

from __future__ import annotations

from typing import ClassVar

from microros_gen.agent.wire.cdr import Reader, Writer
from microros_gen.agent.wire.constants import (
    FLAG_LAST_FRAGMENT,
    FLAG_REPLACE,
    FLAG_REUSE,
    Format,
    ObjectKind,
    SubmessageId,
)
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

_WITH_PARENT = frozenset(
    (
        ObjectKind.TOPIC,
        ObjectKind.PUBLISHER,
        ObjectKind.SUBSCRIBER,
        ObjectKind.DATAWRITER,
        ObjectKind.DATAREADER,
        ObjectKind.REQUESTER,
        ObjectKind.REPLIER,
    )
)
_WITHOUT_PARENT = frozenset((ObjectKind.TYPE, ObjectKind.QOSPROFILE, ObjectKind.APPLICATION))


@dataclass(frozen=True)
class Representation:
    """What an ObjectVariant holds for the kinds that clients create.

    `body` is the text (reference or XML, UTF-8) or the binary representation. `parent` is the id of the participant,
    publisher or subscriber that the object belongs to; 0 for a participant, which has a `domain` instead, and for what
    belongs to nothing. `little`: byte order of a binary `body`.
    """

    kind: int
    format: int
    body: bytes
    parent: int = 0
    domain: int = 0
    little: bool = True

    @staticmethod
    def read(reader: Reader, kind: int) -> Representation:
        """Read what follows the discriminator `kind`."""
        form = reader.u8()
        if form == Format.BINARY:
            body = reader.octets()
        elif form in (Format.REFERENCE, Format.XML):
            body = reader.string().encode("utf-8")
        else:
            raise MalformedError("representation", f"format {form:#04x}")
        parent = domain = 0
        if kind == ObjectKind.PARTICIPANT:
            domain = reader.i16()
        elif kind in _WITH_PARENT:
            parent = reader.identifier()
        elif kind not in _WITHOUT_PARENT:
            raise MalformedError("object_kind", f"kind {kind:#04x}")
        return Representation(kind, form, body, parent, domain, reader.little)

    def write(self, writer: Writer) -> None:
        """Append it, discriminator first."""
        writer.u8(self.kind).u8(self.format)
        if self.format == Format.BINARY:
            writer.octets(self.body)
        else:
            writer.string(self.body.decode("utf-8"))
        if self.kind == ObjectKind.PARTICIPANT:
            writer.i16(self.domain)
        elif self.kind in _WITH_PARENT:
            writer.identifier(self.parent)


@dataclass(frozen=True)
class Create:
    """CREATE: make an object; the members besides the ids and the creation mode are those of Representation."""

    ID: ClassVar = SubmessageId.CREATE
    request: int
    object: int
    kind: int
    format: int
    body: bytes
    parent: int = 0
    domain: int = 0
    reuse: bool = False
    replace: bool = False
    little: bool = True

    @property
    def representation(self) -> Representation:
        """What describes the object."""
        return Representation(self.kind, self.format, self.body, self.parent, self.domain, self.little)

    @staticmethod
    def decode(reader: Reader, flags: int) -> Create:
        """Read the payload."""
        ids = reader.identifier(), reader.identifier()
        about = Representation.read(reader, reader.u8())
        mode = (bool(flags & FLAG_REUSE), bool(flags & FLAG_REPLACE))
        return Create(
            *ids, about.kind, about.format, about.body, about.parent, about.domain, *mode, about.little
        )

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object)
        self.representation.write(writer)
        return (FLAG_REUSE if self.reuse else 0) | (FLAG_REPLACE if self.replace else 0)


@dataclass(frozen=True)
class Delete:
    """DELETE: drop an object, or with object 0xFFFE the client itself."""

    ID: ClassVar = SubmessageId.DELETE
    request: int
    object: int

    @staticmethod
    def decode(reader: Reader, flags: int) -> Delete:
        """Read the payload."""
        return Delete(reader.identifier(), reader.identifier())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object)
        return 0


@dataclass(frozen=True)
class StatusReply:
    """STATUS: result of a CREATE, DELETE or READ_DATA."""

    ID: ClassVar = SubmessageId.STATUS
    request: int
    object: int
    status: int
    implementation_status: int = 0

    @staticmethod
    def decode(reader: Reader, flags: int) -> StatusReply:
        """Read the payload."""
        return StatusReply(reader.identifier(), reader.identifier(), reader.u8(), reader.u8())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object)
        writer.u8(self.status).u8(self.implementation_status)
        return 0


@dataclass(frozen=True)
class Acknack:
    """ACKNACK: all before `first` arrived; bit i of `missing` (16 bits) asks for `first + i` again."""

    ID: ClassVar = SubmessageId.ACKNACK
    first: int
    missing: int
    stream: int

    @staticmethod
    def decode(reader: Reader, flags: int) -> Acknack:
        """Read the payload; the bitmap is two bytes, high one first, in either byte order."""
        return Acknack(reader.u16(), reader.identifier(), reader.u8())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.u16(self.first).identifier(self.missing).u8(self.stream)
        return 0


@dataclass(frozen=True)
class Heartbeat:
    """HEARTBEAT: messages `first` to `last` of the stream can be sent again, older ones cannot."""

    ID: ClassVar = SubmessageId.HEARTBEAT
    first: int
    last: int
    stream: int

    @staticmethod
    def decode(reader: Reader, flags: int) -> Heartbeat:
        """Read the payload."""
        return Heartbeat(reader.u16(), reader.u16(), reader.u8())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.u16(self.first).u16(self.last).u8(self.stream)
        return 0


@dataclass(frozen=True)
class Reset:
    """RESET: all streams of the session begin again at sequence number 0."""

    ID: ClassVar = SubmessageId.RESET

    @staticmethod
    def decode(reader: Reader, flags: int) -> Reset:
        """Read the (empty) payload."""
        return Reset()

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        return 0


@dataclass(frozen=True)
class Fragment:
    """FRAGMENT: a piece of submessages too large for one message; reliable streams only."""

    ID: ClassVar = SubmessageId.FRAGMENT
    data: bytes
    last: bool

    @staticmethod
    def decode(reader: Reader, flags: int) -> Fragment:
        """Read the payload."""
        return Fragment(reader.rest(), bool(flags & FLAG_LAST_FRAGMENT))

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.raw(self.data)
        return FLAG_LAST_FRAGMENT if self.last else 0
