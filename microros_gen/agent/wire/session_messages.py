# SPDX-License-Identifier: Apache-2.0
"""Submessages about sessions and time: CREATE_CLIENT, STATUS_AGENT, GET_INFO, INFO, TIMESTAMP, TIMESTAMP_REPLY."""

from __future__ import annotations

from functools import partial
from typing import ClassVar

from microros_gen.agent.wire.cdr import Reader, Writer
from microros_gen.agent.wire.constants import COOKIE, VENDOR, VERSION, ObjectKind, SubmessageId
from microros_gen.agent.wire.entity_messages import Representation
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

Properties = tuple[tuple[str, str], ...]


def _read_properties(reader: Reader) -> Properties | None:
    return reader.optional(lambda: reader.sequence(lambda: (reader.string(), reader.string())))


def _write_properties(writer: Writer, properties: Properties | None) -> None:
    def pair(item: tuple[str, str]) -> None:
        writer.string(item[0]).string(item[1])

    writer.optional(lambda items: writer.sequence(pair, items), properties)


@dataclass(frozen=True)
class CreateClient:
    """CREATE_CLIENT: open a session. `mtu` is the largest message in bytes that the client accepts."""

    ID: ClassVar = SubmessageId.CREATE_CLIENT
    key: bytes
    session: int
    mtu: int
    properties: Properties | None = None
    cookie: bytes = COOKIE
    version: bytes = VERSION
    vendor: bytes = VENDOR

    @staticmethod
    def decode(reader: Reader, flags: int) -> CreateClient:
        """Read the payload."""
        cookie, version, vendor, key = reader.raw(4), reader.raw(2), reader.raw(2), reader.raw(4)
        session = reader.u8()
        properties = _read_properties(reader)
        return CreateClient(key, session, reader.u16(), properties, cookie, version, vendor)

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.raw(self.cookie).raw(self.version).raw(self.vendor).raw(self.key).u8(self.session)
        _write_properties(writer, self.properties)
        writer.u16(self.mtu)
        return 0


@dataclass(frozen=True)
class AgentConfig:
    """AGENT_Representation: version, vendor and properties of the agent."""

    cookie: bytes = COOKIE
    version: bytes = VERSION
    vendor: bytes = VENDOR
    properties: Properties | None = None

    @staticmethod
    def read(reader: Reader) -> AgentConfig:
        """Read an AGENT_Representation."""
        return AgentConfig(reader.raw(4), reader.raw(2), reader.raw(2), _read_properties(reader))

    def write(self, writer: Writer) -> None:
        """Append the AGENT_Representation."""
        writer.raw(self.cookie).raw(self.version).raw(self.vendor)
        _write_properties(writer, self.properties)


@dataclass(frozen=True)
class StatusAgent:
    """STATUS_AGENT: answer to CREATE_CLIENT."""

    ID: ClassVar = SubmessageId.STATUS_AGENT
    status: int
    implementation_status: int = 0
    agent: AgentConfig = AgentConfig()

    @staticmethod
    def decode(reader: Reader, flags: int) -> StatusAgent:
        """Read the payload."""
        return StatusAgent(reader.u8(), reader.u8(), AgentConfig.read(reader))

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        self.agent.write(writer.u8(self.status).u8(self.implementation_status))
        return 0


@dataclass(frozen=True)
class GetInfo:
    """GET_INFO: request INFO on an object; bit 0 of `mask` requests its configuration, bit 1 its activity."""

    ID: ClassVar = SubmessageId.GET_INFO
    request: int
    object: int
    mask: int

    @staticmethod
    def decode(reader: Reader, flags: int) -> GetInfo:
        """Read the payload."""
        return GetInfo(reader.identifier(), reader.identifier(), reader.u32())

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object).u32(self.mask)
        return 0


# Discriminant of a TransportLocator → bytes of the address, code of the port; 3 is a string instead.
_LOCATOR_ADDRESS = {0: 2, 1: 4, 2: 16}
_LOCATOR_STRING = 3


@dataclass(frozen=True)
class Locator:
    """TransportLocator: an address of the agent. `kind`: 0 small (2 bytes), 1 IPv4, 2 IPv6, 3 text in UTF-8."""

    kind: int
    address: bytes
    port: int = 0

    @staticmethod
    def read(reader: Reader) -> Locator:
        """Read a TransportLocator. Raises MalformedError if its kind is unknown."""
        kind = reader.u8()
        if kind == _LOCATOR_STRING:
            return Locator(kind, reader.string().encode("utf-8"))
        if kind not in _LOCATOR_ADDRESS:
            raise MalformedError("locator", f"kind {kind}")
        address = reader.raw(_LOCATOR_ADDRESS[kind])
        return Locator(kind, address, (reader.u8, reader.u16, reader.u32)[kind]())

    def write(self, writer: Writer) -> None:
        """Append the TransportLocator."""
        writer.u8(self.kind)
        if self.kind == _LOCATOR_STRING:
            writer.string(self.address.decode("utf-8"))
        else:
            writer.raw(self.address)
            (writer.u8, writer.u16, writer.u32)[self.kind](self.port)


@dataclass(frozen=True)
class AgentActivity:
    """AGENT_ActivityInfo: whether the agent accepts clients (1), and its addresses."""

    availability: int = 1
    locators: tuple[Locator, ...] = ()


@dataclass(frozen=True)
class WriterActivity:
    """DATAWRITER_ActivityInfo: samples written so far, and the last sequence number of the stream that carried them."""

    samples: int = 0
    stream_sequence: int = 0


@dataclass(frozen=True)
class ReaderActivity:
    """DATAREADER_ActivityInfo: the last sequence number acknowledged by the client on the stream of its samples."""

    acknowledged: int = 0


Config = AgentConfig | Representation
Activity = AgentActivity | WriterActivity | ReaderActivity


@dataclass(frozen=True)
class Info:
    """INFO: answer to GET_INFO about the agent or an object. `implementation_status`: 1 in a session, else 0.

    As the public agent sends it, the configuration comes before the activity; annex A has the opposite order.
    """

    ID: ClassVar = SubmessageId.INFO
    request: int
    object: int
    status: int = 0
    implementation_status: int = 0
    config: Config | None = None
    activity: Activity | None = None

    @staticmethod
    def decode(reader: Reader, flags: int) -> Info:
        """Read the payload."""
        head = (reader.identifier(), reader.identifier(), reader.u8(), reader.u8())
        config = reader.optional(lambda: Info._read_config(reader))
        return Info(*head, config, reader.optional(lambda: Info._read_activity(reader)))

    @staticmethod
    def _read_config(reader: Reader) -> Config:
        kind = reader.u8()
        return AgentConfig.read(reader) if kind == ObjectKind.AGENT else Representation.read(reader, kind)

    @staticmethod
    def _read_activity(reader: Reader) -> Activity:
        kind = reader.u8()
        if kind == ObjectKind.AGENT:
            return AgentActivity(reader.i16(), reader.sequence(lambda: Locator.read(reader)))
        if kind == ObjectKind.DATAWRITER:
            return WriterActivity(reader.u64(), reader.i16())
        if kind == ObjectKind.DATAREADER:
            return ReaderActivity(reader.i16())
        raise MalformedError("info_kind", f"kind {kind:#04x}")

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object)
        writer.u8(self.status).u8(self.implementation_status)
        writer.optional(partial(self._write_config, writer), self.config)
        writer.optional(partial(self._write_activity, writer), self.activity)
        return 0

    @staticmethod
    def _write_config(writer: Writer, config: Config) -> None:
        if isinstance(config, AgentConfig):
            writer.u8(ObjectKind.AGENT)
        config.write(writer)

    @staticmethod
    def _write_activity(writer: Writer, activity: Activity) -> None:
        if isinstance(activity, WriterActivity):
            writer.u8(ObjectKind.DATAWRITER).u64(activity.samples).i16(activity.stream_sequence)
        elif isinstance(activity, ReaderActivity):
            writer.u8(ObjectKind.DATAREADER).i16(activity.acknowledged)
        else:
            writer.u8(ObjectKind.AGENT).i16(activity.availability)
            writer.sequence(lambda locator: locator.write(writer), activity.locators)


Time = tuple[int, int]
"""Seconds and nanoseconds since the epoch.

Seconds have 32 bits and a sign on the wire (Time_t of annex A). From
2038-01-19 03:14:08 UTC they continue modulo 2^32: differences stay correct, and so do absolute times, until 2106, for a
reader that takes them as unsigned.
"""


def _read_time(reader: Reader) -> Time:
    return reader.i32(), reader.u32()


def _write_time(writer: Writer, time: Time) -> None:
    writer.u32(time[0] & 0xFFFF_FFFF).u32(time[1])


@dataclass(frozen=True)
class Timestamp:
    """TIMESTAMP: request the agent's time; `transmit` is the client's time when it was sent."""

    ID: ClassVar = SubmessageId.TIMESTAMP
    transmit: Time

    @staticmethod
    def decode(reader: Reader, flags: int) -> Timestamp:
        """Read the payload."""
        return Timestamp(_read_time(reader))

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        _write_time(writer, self.transmit)
        return 0


@dataclass(frozen=True)
class TimestampReply:
    """TIMESTAMP_REPLY: when the agent sent it, when it received the request, and the request's `transmit`."""

    ID: ClassVar = SubmessageId.TIMESTAMP_REPLY
    transmit: Time
    receive: Time
    originate: Time

    @staticmethod
    def decode(reader: Reader, flags: int) -> TimestampReply:
        """Read the payload."""
        return TimestampReply(_read_time(reader), _read_time(reader), _read_time(reader))

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        for time in (self.transmit, self.receive, self.originate):
            _write_time(writer, time)
        return 0
