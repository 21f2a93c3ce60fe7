# SPDX-License-Identifier: Apache-2.0
"""Submessages that carry or request samples: WRITE_DATA, READ_DATA, DATA."""

from __future__ import annotations

from typing import ClassVar, Final

from microros_gen.agent.wire.cdr import Reader, Writer
from microros_gen.agent.wire.constants import DATA_FORMAT_MASK, SubmessageId
from microros_gen.records import dataclass

DATA_PREFIX: Final = 4
"""Number of bytes of WRITE_DATA and DATA before the data: request id and object id."""

DELIVERY_CONTROL = 8
"""Number of bytes of a DataDeliveryControl."""


@dataclass(frozen=True)
class WriteData:
    """WRITE_DATA: samples for a writer. In FORMAT_DATA, `data` is one CDR body without encapsulation header."""

    ID: ClassVar = SubmessageId.WRITE_DATA
    request: int
    object: int
    data: bytes
    format: int = 0

    @staticmethod
    def decode(reader: Reader, flags: int) -> WriteData:
        """Read the payload."""
        return WriteData(reader.identifier(), reader.identifier(), reader.rest(), flags & DATA_FORMAT_MASK)

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object).raw(self.data)
        return self.format


@dataclass(frozen=True)
class Data:
    """DATA: samples from a reader, in answer to the READ_DATA with the same request id."""

    ID: ClassVar = SubmessageId.DATA
    request: int
    object: int
    data: bytes
    format: int = 0

    @staticmethod
    def decode(reader: Reader, flags: int) -> Data:
        """Read the payload."""
        return Data(reader.identifier(), reader.identifier(), reader.rest(), flags & DATA_FORMAT_MASK)

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object).raw(self.data)
        return self.format


@dataclass(frozen=True)
class DeliveryControl:
    """Limits of a READ_DATA (clause 7.7.14), each from 0 to 65,535.

    `max_samples`: samples, 0xFFFF for no limit. `max_elapsed_time`: s. `max_bytes_per_second`: bytes/s.
    `min_pace_period`: minimum time between two samples, ms.
    """

    max_samples: int
    max_elapsed_time: int = 0
    max_bytes_per_second: int = 0
    min_pace_period: int = 0

    @staticmethod
    def read(reader: Reader) -> DeliveryControl:
        """Read one, with the DHEADER of annex B.4.2 or without it, as clients send it."""
        if reader.remaining() >= DELIVERY_CONTROL + 4:
            reader.u32()
        return DeliveryControl(reader.u16(), reader.u16(), reader.u16(), reader.u16())

    def write(self, writer: Writer) -> None:
        """Append its four numbers, without a DHEADER."""
        writer.u16(self.max_samples).u16(self.max_elapsed_time)
        writer.u16(self.max_bytes_per_second).u16(self.min_pace_period)


@dataclass(frozen=True)
class ReadData:
    """READ_DATA: request samples of a reader on stream `stream` (0 to 255)."""

    ID: ClassVar = SubmessageId.READ_DATA
    request: int
    object: int
    stream: int
    format: int = 0
    content_filter: str | None = None
    delivery: DeliveryControl | None = None

    @staticmethod
    def decode(reader: Reader, flags: int) -> ReadData:
        """Read the payload."""
        head = (reader.identifier(), reader.identifier(), reader.u8(), reader.u8())
        content_filter = reader.optional(reader.string)
        return ReadData(*head, content_filter, reader.optional(lambda: DeliveryControl.read(reader)))

    def encode(self, writer: Writer) -> int:
        """Write the payload; return the flags besides the byte order."""
        writer.identifier(self.request).identifier(self.object).u8(self.stream).u8(self.format)
        writer.optional(writer.string, self.content_filter)
        writer.optional(lambda delivery: delivery.write(writer), self.delivery)
        return 0
