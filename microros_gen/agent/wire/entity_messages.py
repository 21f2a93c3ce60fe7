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
    """Description of an object in a CREATE or INFO (ObjectVariant, clause 7.7.3).

    `body` is text in UTF-8 (reference or XML) or the binary representation, whose byte order is `little`. `parent` is
    the id of the participant, publisher or subscriber that contains the object; 0 for objects without a container. A
    participant has a `domain` instead.
    """

    kind: int
    format: int
    body: bytes
    parent: int = 0
    domain: int = 0
    little: bool = True

    @staticmethod
    def read(reader: Reader, kind: int) -> Representation:
        """Read one of kind `kind`, whose discriminator was read. Raises MalformedError if it is invalid."""
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
        """Append the discriminator and the description."""
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
    """CREATE: create an object. Besides the ids and the creation mode it has the members of Representation."""

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
        """The object's description."""
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
    """DELETE: delete an object, or the client's session (object 0xFFFE)."""

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
    """ACKNACK: every message before `first` arrived. Bit i of `missing` (16 bits) requests `first + i` again."""

    ID: ClassVar = SubmessageId.ACKNACK
    first: int
    missing: int
    stream: int

    @staticmethod
    def decode(reader: Reader, flags: int) -> Acknack:
        """Read the payload. The bitmap is two bytes, always high byte first."""
        return Acknack(reader.u16(), reader.identifier(), reader.u8())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.u16(self.first).identifier(self.missing).u8(self.stream)
        return 0


@dataclass(frozen=True)
class Heartbeat:
    """HEARTBEAT: the sender can repeat messages `first` to `last` of the stream, and no older ones."""

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
    """RESET: restart all streams of the session at sequence number 0."""

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
    """FRAGMENT: a part of submessages that do not fit into one message; on reliable streams only."""

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
