# SPDX-License-Identifier: Apache-2.0
"""The five data formats (DDS-XRCE 1.0, 7.7.1, 7.7.2, table 11): bytes, both orders, both ways through the agent."""

from __future__ import annotations

import contextlib
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.agent.wire.cdr import Reader, Writer
from microros_gen.agent.wire.constants import DataFormat
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, WriteData
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.samples import Sample, SampleInfo, overhead, packs, read_samples, write_samples
from tests.support.agent.dialogue import GRAPH, message, publishing
from tests.support.agent.readers import FOREVER, LABEL, Listener, put, sample, subscribing
from tests.support.examples import examples

u32 = st.integers(0, 0xFFFFFFFF)
info = st.builds(SampleInfo, st.integers(0, 15), st.none() | u32, st.none() | u32)
samples = st.lists(st.builds(Sample, st.binary(max_size=40), info), min_size=1, max_size=5)


def bound(form: int, items: list[Sample]) -> int:
    fixed, each = overhead(form)
    return fixed + sum(each + len(item.body) for item in items)


def read(data: bytes, form: int, little: bool = True) -> tuple[Sample, ...]:
    return read_samples(Reader(data, 0, len(data), little), form)


def written(form: int, items: list[Sample], little: bool = True) -> bytes:
    writer = Writer(little)
    write_samples(writer, form, items)
    return writer.content()


@pytest.mark.parametrize(
    ("form", "data", "wanted"),
    [
        # B.3.1: a Temperature of 25
        (0x00, "19 00", [Sample(b"\x19\0")]),
        # B.3.3: with the time only
        (0x02, "00 02 00 00 e8 03 00 00 19 00", [Sample(b"\x19\0", SampleInfo(0, None, 1000))]),
        # B.3.4: disposed, nothing besides the state
        (0x02, "02 00 11 22 33 64 19 00", [Sample(bytes.fromhex("112233641900"), SampleInfo(2))]),
        # B.3.2: four Temperatures without lengths
        (0x08, "04 00 00 00 14 00 11 00 1a 00 24 00", [Sample(bytes((v, 0))) for v in (20, 17, 26, 36)]),
        # B.5.2
        (0x08, "02 00 00 00 01 00 00 00 02 00 00 00", [Sample(bytes((v, 0, 0, 0))) for v in (1, 2)]),
    ],
)
def test_the_examples_of_annex_b(form: int, data: str, wanted: list[Sample]) -> None:
    assert list(read(bytes.fromhex(data), form)) == wanted


@pytest.mark.parametrize("little", [True, False], ids=["little", "big"])
@pytest.mark.parametrize(
    "form", [DataFormat.DATA_SEQ, DataFormat.SAMPLE_SEQ, DataFormat.SAMPLE, DataFormat.DATA]
)
@settings(max_examples=examples(60), deadline=None)
@given(items=samples)
def test_there_and_back(form: int, little: bool, items: list[Sample]) -> None:
    if form in (DataFormat.SAMPLE, DataFormat.DATA):
        items = items[:1]
    if form in (DataFormat.DATA, DataFormat.DATA_SEQ):
        items = [Sample(item.body) for item in items]
    data = written(form, items, little)
    assert list(read(data, form, little)) == items
    assert len(data) <= bound(form, items)


@settings(max_examples=examples(100), deadline=None)
@given(
    st.integers(0, 1 << 31),
    st.lists(st.tuples(st.binary(max_size=20), st.integers(0, 255), st.integers(0, 0xFFFF)), max_size=5),
    st.booleans(),
)
def test_packed_samples_add_up(base: int, items: list[tuple[bytes, int, int]], little: bool) -> None:
    """7.7.2, table 1: number and time are those of the base plus the delta's, time in tenths of a second."""
    first = Sample(b"first", SampleInfo(4, base, base))
    wanted = [first] + [Sample(b, SampleInfo(0, base + n, base + t * 100)) for b, n, t in items]
    assert all(packs(first.info, item.info) for item in wanted)
    data = written(DataFormat.PACKED_SAMPLES, wanted, little)
    assert list(read(data, DataFormat.PACKED_SAMPLES, little)) == wanted
    assert len(data) <= bound(DataFormat.PACKED_SAMPLES, wanted)


def test_packed_samples_have_bounds() -> None:
    base = SampleInfo(0, 10, 1000)
    assert packs(base, SampleInfo(0, 10 + 255, 1000 + 6_553_599))
    assert not packs(base, SampleInfo(0, 10 + 256, 1000))
    assert not packs(base, SampleInfo(0, 10, 1000 + 6_553_600))
    assert not packs(base, SampleInfo(0, 9, 1000))


@pytest.mark.parametrize(
    ("form", "data", "kind"),
    [
        (0x04, "00", "data_format"),
        (0x02, "00 04 00", "sample_info"),
        (0x02, "00", "truncated"),
        (0x08, "03 00 00 00 01 02 03 04", "data_sequence"),
        (0x08, "00 00 00 00 01 02 03 04", "data_sequence"),
        (0x08, "ff ff ff ff", "data_sequence"),
        (0x0A, "ff ff ff ff 00", "truncated"),
        (0x0E, "00 00 00 00 02 00 00 00 00 00", "truncated"),
    ],
)
def test_what_cannot_be_cut_is_malformed(form: int, data: str, kind: str) -> None:
    with pytest.raises(MalformedError) as caught:
        read(bytes.fromhex(data), form)
    assert caught.value.kind == kind


@settings(max_examples=examples(300), deadline=None)
@given(st.sampled_from(list(DataFormat)), st.binary(max_size=60), st.booleans())
def test_any_bytes_are_samples_or_malformed(form: int, data: bytes, little: bool) -> None:
    with contextlib.suppress(MalformedError):
        read(data, form, little)


# Through the agent


@pytest.mark.parametrize("little", [True, False], ids=["little", "big"])
@pytest.mark.parametrize("form", list(DataFormat))
def test_write_data_in_every_format(form: DataFormat, little: bool) -> None:
    bench = publishing()
    items = [Sample(struct.pack("<i" if little else ">i", i), SampleInfo(0, i, 100 * i)) for i in range(3)]
    count = 1 if form in (DataFormat.DATA, DataFormat.SAMPLE) else 3
    data = written(form, items[:count], little)
    bench.say(message(WriteData(1, 0x15, data, form), sequence=4, little=little))
    head = b"\0\1\0\0" if little else b"\0\0\0\0"
    assert bench.bridge.published == [(GRAPH[1], head + item.body) for item in items[:count]]
    assert bench.agent.samples == count


def test_disposing_is_counted_and_not_published() -> None:
    """7.8.4.1: dispose and unregister are for instances, and ROS 2 topics have no keys."""
    bench = publishing()
    items = [Sample(b"aaaa", SampleInfo(state)) for state in (0, 1, 2, 3, 4, 8)]
    bench.say(message(WriteData(1, 0x15, written(DataFormat.SAMPLE_SEQ, items), 0x0A), sequence=4))
    assert len(bench.bridge.published) == 3
    assert bench.log.counters == {"life_cycle": 3}


@pytest.mark.parametrize("little", [True, False], ids=["little", "big"])
@pytest.mark.parametrize("form", list(DataFormat))
def test_data_in_every_format(form: DataFormat, little: bool) -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(format=int(form))
    bench.now += 2.0
    bench.bridge.source(LABEL).put(*(sample(i, little) for i in range(3)))
    answers = [a for a in listener.take() if isinstance(a, Data)]
    assert len(answers) == (3 if form in (DataFormat.DATA, DataFormat.SAMPLE) else 1)
    assert {a.format for a in answers} == {form}
    assert {data[5] & 1 for data, _ in listener.messages()} == {little}
    received = [item for a in answers for item in read(a.data, form, little)]
    assert [item.body for item in received] == [sample(i, little)[4:] for i in range(3)]
    if form not in (DataFormat.DATA, DataFormat.DATA_SEQ):
        assert [item.info.sequence for item in received] == [0, 1, 2]
        assert [item.info.state for item in received] == [4, 0, 0], "the first one is new"
        assert [item.info.offset_ms for item in received] == [2000] * 3, "since the session began"


def test_a_sequence_fills_a_message_and_keeps_to_the_limit() -> None:
    bench = subscribing(mtu=64)
    listener = Listener(bench)
    listener.read(format=8, control=DeliveryControl(20))
    put(bench, *range(30))
    answers = [a for a in listener.take() if isinstance(a, Data)]
    counts = [len(read(a.data, 8)) for a in answers]
    assert sum(counts) == 20
    assert max(counts) > 2
    assert all(len(data) <= 64 for _, data in bench.transport.sent)
    rest = listener.read(format=8, control=FOREVER)
    received = [item.body for a in [*answers, *rest] if isinstance(a, Data) for item in read(a.data, 8)]
    assert received == [sample(i)[4:] for i in range(30)], (
        "none was lost between two messages or two requests"
    )


def test_byte_orders_do_not_share_a_sequence() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(format=8)
    bench.bridge.source(LABEL).put(sample(1), sample(2, little=False), sample(3, little=False))
    listener.take()
    sent = [
        (data[5] & 1, len(read(a.data, 8, bool(data[5] & 1))))
        for data, a in listener.messages()
        if isinstance(a, Data)
    ]
    assert sent == [(1, 1), (0, 2)]
