# SPDX-License-Identifier: Apache-2.0
"""Binary representations (DDS-XRCE 1.0, annex A, OBJK_*_Binary); alignment is relative to the start of the body."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from microros_gen.agent.representation.description import (
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    Service,
    Topic,
    UnsupportedKindError,
)
from microros_gen.agent.wire.cdr import Reader
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.errors import MalformedError

RELIABLE, KEEP_LAST, EXCLUSIVE, TRANSIENT_LOCAL, TRANSIENT, PERSISTENT = 1, 2, 4, 8, 16, 32
"""Bits of EndpointQosFlags."""
_DURABILITY = (
    (PERSISTENT, Durability.PERSISTENT),
    (TRANSIENT, Durability.TRANSIENT),
    (TRANSIENT_LOCAL, Durability.TRANSIENT_LOCAL),
)


def from_binary(create: Create) -> Description:
    """Return the description in the binary `create`. Raises MalformedError, or UnsupportedKindError for other kinds."""
    reader = Reader(create.body, 0, len(create.body), create.little)
    if create.kind == ObjectKind.PARTICIPANT:
        return _participant(reader, create.domain)
    read = _READERS.get(create.kind)
    if read is None:
        raise UnsupportedKindError(f"binary objects of kind {create.kind:#04x}")
    return read(reader)


def _participant(reader: Reader, domain: int) -> Participant:
    reader.optional(reader.string)  # domain_ref; the number in the CREATE counts
    return Participant(reader.optional(reader.string) or "", domain)


def _topic(reader: Reader) -> Topic:
    name = reader.string()
    type_reference = reader.optional(reader.string)
    type_name = reader.optional(reader.string) or type_reference
    if not name or not type_name:
        raise MalformedError("representation", "a topic without name or type name")
    return Topic(name, type_name)


def _group(reader: Reader) -> Group:
    name = reader.optional(reader.string) or ""
    return Group(name, reader.optional(lambda: _partitions(reader)) or ())


def _partitions(reader: Reader) -> tuple[str, ...]:
    return reader.optional(lambda: reader.sequence(reader.string)) or ()


def _writer(reader: Reader) -> Endpoint:
    topic = reader.identifier()
    return Endpoint(None, topic, reader.optional(lambda: _qos(reader)) or Qos())


def _reader(reader: Reader) -> Endpoint:
    topic = reader.identifier()
    if not reader.flag():
        return Endpoint(None, topic, Qos(reliable=False))
    qos = _qos(reader)
    if reader.remaining() == 0:
        return Endpoint(None, topic, qos)  # some clients send the shorter QoS of a writer
    separation = reader.optional(reader.u32) or 0
    return Endpoint(None, topic, qos, separation, reader.optional(reader.string) or "")


def _qos(reader: Reader) -> Qos:
    flags = reader.u16()
    depth = reader.optional(reader.u16) or 0
    deadline = reader.optional(reader.u32) or 0
    lifespan = reader.optional(reader.u32) or 0
    reader.optional(reader.octets)  # user_data
    durability = next((kind for bit, kind in _DURABILITY if flags & bit), Durability.VOLATILE)
    return Qos(bool(flags & RELIABLE), durability, bool(flags & KEEP_LAST), depth, deadline, lifespan)


def _service(reader: Reader) -> Service:
    name, request_type, reply_type = reader.string(), reader.string(), reader.string()
    request_topic = reader.optional(reader.string) or ""
    return Service(name, request_type, reply_type, request_topic, reader.optional(reader.string) or "")


_READERS: Mapping[int, Callable[[Reader], Description]] = MappingProxyType(
    {
        ObjectKind.TOPIC: _topic,
        ObjectKind.PUBLISHER: _group,
        ObjectKind.SUBSCRIBER: _group,
        ObjectKind.DATAWRITER: _writer,
        ObjectKind.DATAREADER: _reader,
        ObjectKind.REQUESTER: _service,
        ObjectKind.REPLIER: _service,
    }
)
