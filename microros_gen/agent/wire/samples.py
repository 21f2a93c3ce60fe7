# SPDX-License-Identifier: Apache-2.0
"""The five layouts of data in WRITE_DATA and DATA (DDS-XRCE 1.0, clauses 7.7.1 and 7.7.2, annex A).

The standard does not define the bytes of an XCDRSerializedBuffer. Here, a single sample (FORMAT_DATA, FORMAT_SAMPLE) is
the rest of the submessage, as in examples B.3.1, B.3.3 and B.3.4. In a sequence, a length (u32) precedes each sample,
as in the types of the public client and agent, so that samples can be separated without knowing their type. Sequences
without lengths, as in example B.3.2, are accepted if all samples have the same size. Alignment is relative to the end
of the ids, and within a sample's body to its own start.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from types import MappingProxyType

from microros_gen.agent.wire.cdr import MOST_ELEMENTS, Reader, Writer
from microros_gen.agent.wire.constants import DataFormat
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

UNREGISTERED, DISPOSED, VIEW_NEW, READ = 1, 2, 4, 8
"""Bits of SampleInfoFlags."""
LIFE_CYCLE = UNREGISTERED | DISPOSED
"""Each of these bits marks a sample that ends an instance and carries no value."""
_SEQUENCE, _TIME = 1, 2
"""SampleInfoFormat: which optional fields follow the state."""
MILLISECONDS_A_DECISECOND = 100
_OVERHEAD = MappingProxyType(
    {  # a SampleInfo has 12 bytes, a count or a length 4, a SampleInfoDelta 4; up to 3 align a length
        DataFormat.DATA: (0, 0),
        DataFormat.SAMPLE: (0, 12),
        DataFormat.DATA_SEQ: (4, 7),
        DataFormat.SAMPLE_SEQ: (4, 19),
        DataFormat.PACKED_SAMPLES: (16, 11),
    }
)
SEQUENCES = frozenset((DataFormat.DATA_SEQ, DataFormat.SAMPLE_SEQ, DataFormat.PACKED_SAMPLES))


@dataclass(frozen=True)
class SampleInfo:
    """A sample's state, sequence number, and time in ms since the session began; None if absent (clause 7.7.2)."""

    state: int = 0
    sequence: int | None = None
    offset_ms: int | None = None


@dataclass(frozen=True)
class Sample:
    """The CDR body of a sample, without encapsulation header, and its SampleInfo."""

    body: bytes
    info: SampleInfo = SampleInfo()


def read_samples(reader: Reader, form: int) -> tuple[Sample, ...]:
    """Return the samples that follow the ids in layout `form`. Raises MalformedError if they are invalid."""
    return tuple(cut_samples(reader, form))


def cut_samples(reader: Reader, form: int) -> Iterator[Sample]:
    """Yield the samples one by one, so that a caller that stops early does not decode the others."""
    if form == DataFormat.DATA:
        yield Sample(reader.rest())
    elif form == DataFormat.SAMPLE:
        info = _read_info(reader)
        yield Sample(reader.rest(), info)
    elif form == DataFormat.DATA_SEQ:
        yield from map(Sample, _read_data_sequence(reader))
    elif form == DataFormat.SAMPLE_SEQ:
        for _ in range(reader.count()):
            yield _with_body(reader, _read_info(reader))
    elif form == DataFormat.PACKED_SAMPLES:
        base = _read_info(reader)
        for _ in range(reader.count()):
            yield _with_body(reader, _read_delta(reader, base))
    else:
        raise MalformedError("data_format", f"unknown format {form:#04x}")


def write_samples(writer: Writer, form: int, samples: Sequence[Sample]) -> None:
    """Append samples in layout `form`: DATA and SAMPLE take exactly one, PACKED_SAMPLES those that fit (`packs`)."""
    if form == DataFormat.DATA:
        writer.raw(samples[0].body)
    elif form == DataFormat.SAMPLE:
        _write_info(writer, samples[0].info)
        writer.raw(samples[0].body)
    elif form == DataFormat.DATA_SEQ:
        writer.sequence(lambda sample: writer.octets(sample.body), tuple(samples))
    elif form == DataFormat.SAMPLE_SEQ:
        writer.sequence(lambda sample: _write_sample(writer, sample), tuple(samples))
    else:
        base = samples[0].info
        _write_info(writer, base)
        writer.sequence(lambda sample: _write_delta(writer, base, sample), tuple(samples))


def packs(base: SampleInfo, info: SampleInfo) -> bool:
    """Return whether a sample fits PACKED_SAMPLES with `base`: 0 to 255 numbers and 0 to 65,535 tenths of s later."""
    steps = (info.sequence or 0) - (base.sequence or 0)
    later = (info.offset_ms or 0) - (base.offset_ms or 0)
    return 0 <= steps <= 0xFF and 0 <= later // MILLISECONDS_A_DECISECOND <= 0xFFFF


def overhead(form: int) -> tuple[int, int]:
    """Return the maximum bytes that layout `form` adds to the bodies: for all samples together, and for each."""
    return _OVERHEAD[DataFormat(form)]


def _read_info(reader: Reader) -> SampleInfo:
    state, detail = reader.u8(), reader.u8()
    if detail > _SEQUENCE | _TIME:
        raise MalformedError("sample_info", f"format {detail:#04x}")
    sequence = reader.u32() if detail & _SEQUENCE else None
    return SampleInfo(state, sequence, reader.u32() if detail & _TIME else None)


def _write_info(writer: Writer, info: SampleInfo) -> None:
    has_sequence, has_time = info.sequence is not None, info.offset_ms is not None
    writer.u8(info.state).u8((_SEQUENCE if has_sequence else 0) | (_TIME if has_time else 0))
    for number in (info.sequence, info.offset_ms):
        if number is not None:
            writer.u32(number & 0xFFFFFFFF)


def _read_delta(reader: Reader, base: SampleInfo) -> SampleInfo:
    state, steps, later = reader.u8(), reader.u8(), reader.u16()
    sequence = None if base.sequence is None else (base.sequence + steps) & 0xFFFFFFFF
    if base.offset_ms is None:
        return SampleInfo(state, sequence)
    return SampleInfo(state, sequence, (base.offset_ms + later * MILLISECONDS_A_DECISECOND) & 0xFFFFFFFF)


def _write_delta(writer: Writer, base: SampleInfo, sample: Sample) -> None:
    info = sample.info
    later = (info.offset_ms or 0) - (base.offset_ms or 0)
    writer.u8(info.state).u8((info.sequence or 0) - (base.sequence or 0))
    writer.u16(later // MILLISECONDS_A_DECISECOND).octets(sample.body)


def _with_body(reader: Reader, info: SampleInfo) -> Sample:
    return Sample(reader.octets(), info)


def _write_sample(writer: Writer, sample: Sample) -> None:
    _write_info(writer, sample.info)
    writer.octets(sample.body)


def _read_data_sequence(reader: Reader) -> list[bytes]:
    whole = reader.rest()
    bodies = _with_lengths(whole, reader.little)
    if bodies is not None:
        return bodies
    counted = Reader(whole, 0, len(whole), reader.little)
    count = counted.u32()
    size, left = divmod(counted.remaining(), count) if count else (0, 0)
    if not size or left or count > MOST_ELEMENTS:
        raise MalformedError("data_sequence", f"{count} samples in {counted.remaining()} bytes")
    return [counted.raw(size) for _ in range(count)]


def _with_lengths(whole: bytes, little: bool) -> list[bytes] | None:
    """Return the bodies of a sequence whose elements begin with their lengths; None if they do not seem to."""
    number = struct.Struct("<I" if little else ">I").unpack_from
    bodies: list[bytes] = []
    at, size = 4, len(whole)
    if size < at or (count := number(whole)[0]) > MOST_ELEMENTS:
        return None
    for _ in range(count):
        at = at + 3 & ~3
        if at + 4 > size:
            return None
        end = at + 4 + number(whole, at)[0]
        if end > size:
            return None
        bodies.append(whole[at + 4 : end])
        at = end
    return bodies if size - at < 4 else None
