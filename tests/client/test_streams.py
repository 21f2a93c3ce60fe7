# SPDX-License-Identifier: Apache-2.0
"""Sizes of the streams: the smallest that do, fragments, what the application asks for, what cannot be."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.application.model import Application
from microros_gen.application.task_decl import TaskDecl
from microros_gen.application.transport_decl import Transport
from microros_gen.client.plan.streams import (
    LARGEST_BODY,
    Received,
    StreamSizes,
    Written,
    plan_streams,
)
from microros_gen.client.plan.transport_sizes import DEFAULT_MTU
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.selection.declared import STREAM_BEST_EFFORT, STREAM_RELIABLE_INPUT, stream_demands
from tests.support.ids import without_id

INT32 = Written("std_msgs/msg/Int32 on /count", 4, True, False)
RELIABLE = Application(creation=Named("reliable"))


def plan(
    *written: Written,
    application: Application | None = None,
    create: int = 92,
    transport: str = "udp",
    reliable_input: bool = False,
) -> tuple[StreamSizes, list[str]]:
    found = Diagnostics()
    streams = plan_streams(
        application or Application(), transport, written, create, found, reliable_input=reliable_input
    )
    return streams, [without_id(d.headline()) for d in found]


def test_a_serial_line_has_room_for_the_longest_frame_with_every_byte_stuffed_but_text() -> None:
    """A frame is a flag and, twice at the worst, addresses, length, message and CRC; one byte of a ring stays free."""
    streams, _ = plan(INT32, transport="serial", create=0)
    assert streams.send_buffer == 1 + 2 * (24 + 6) + 1 + 2, "CREATE_CLIENT, and up to a multiple of four"
    streams, _ = plan(large(400), transport="serial", create=92)
    assert streams.send_buffer == 1 + 2 * (412 + 6) + 1 + 2
    streams, _ = plan(large(60_000), transport="serial", create=92)
    assert streams.send_buffer == 1 + 2 * (512 + 6) + 1 + 2, "of fragments, one"
    found = Diagnostics()
    text = plan_streams(Application(), "serial", (INT32,), 92, found, create_text=50)
    assert text.send_buffer == 1 + 2 * (92 + 6) - 50 + 1
    assert plan(INT32, transport="udp")[0].send_buffer == 0


def test_a_line_takes_large_reliable_messages_from_their_slots() -> None:
    """Then its ring has what is copied: CREATE of 92 bytes, best-effort messages. Small ones are not worth the code."""

    def kept(*written: Written, application: Application | None = None) -> tuple[bool, int]:
        reported = application or Application()
        streams = plan_streams(reported, "serial", written, 92, Diagnostics(), keeps_output=True)
        return streams.keeps_output, streams.send_buffer

    created, copied = 1 + 2 * (92 + 6) + 1 + 2, 1 + 2 * (412 + 6) + 1 + 2
    assert kept(large(400)) == (True, created)
    assert kept(large(100)) == (False, 1 + 2 * (112 + 6) + 1 + 2)
    assert kept(large(400), large(300, reliable=False)) == (True, 1 + 2 * (312 + 6) + 1 + 2)
    assert kept(large(400), large(400, reliable=False)) == (False, copied)
    assert kept(large(60_000)) == (False, 1 + 2 * (512 + 6) + 1 + 2), (
        "fragments are made where they are sent from"
    )
    assert kept(large(400), application=Application(on_full="drop_oldest")) == (False, copied)
    applications = [Application(transport=Transport("serial", send_buffer=size)) for size in (400, 2000)]
    assert [kept(large(400), application=a) for a in applications] == [(True, 400), (False, 2000)]


def test_a_serial_line_has_room_for_one_message_of_each_best_effort_writer() -> None:
    streams, _ = plan(*[large(100, reliable=False)] * 5, transport="serial")
    assert 5 * (112 + 7) < streams.send_buffer < 5 * (112 + 7 + 8)


def test_a_send_buffer_is_what_the_application_says_if_the_longest_frame_fits() -> None:
    def planned(size: int) -> tuple[StreamSizes, list[str]]:
        application = Application(transport=Transport("serial", send_buffer=size))
        return plan(large(100), application=application, transport="serial", create=0)

    assert planned(238)[0].send_buffer == 240
    assert planned(4000)[0].send_buffer == 4000
    found_warnings = planned(200)[1]
    assert len(found_warnings) == 1
    assert (
        "'transport.send_buffer' is 200 and the longest frame on the line may take 237 bytes"
        in found_warnings[0]
    )
    assert "Set send_buffer: 240" in found_warnings[0]


def large(size: int, reliable: bool = True) -> Written:
    return Written("a/msg/B on /b", size, reliable, not reliable)


def test_no_buffer_is_larger_than_it_must_be() -> None:
    streams, found_warnings = plan(INT32)
    assert streams == StreamSizes(92, 92, 4, 16, 64)
    assert streams.ram == 92 + 4 * 16 + 64
    assert found_warnings == []


def test_reliable_creation_alone_needs_no_best_effort_stream() -> None:
    streams, _ = plan(INT32, application=RELIABLE, reliable_input=True)
    assert streams == StreamSizes(92, 0, 4, 16, 64, creation_size=92, reliable_input_slots=1)
    demands = list(stream_demands(RELIABLE, frozenset(), "binary"))
    assert [d.component for d in demands] == ["stream_reliable", STREAM_RELIABLE_INPUT]
    assert all(d.text.startswith("creation: reliable (") for d in demands)
    assert [d.component for d in stream_demands(Application(), frozenset(), "binary")] == [STREAM_BEST_EFFORT]
    assert list(stream_demands(RELIABLE, frozenset(), "preconfigured")) == []


def test_reliable_creation_with_best_effort_messages() -> None:
    streams, _ = plan(large(20, reliable=False), application=RELIABLE, reliable_input=True)
    assert (streams.best_effort_size, streams.reliable_slots, streams.creation_size) == (32, 1, 92)


@pytest.mark.parametrize("transport", DEFAULT_MTU)
def test_fragments_begin_one_byte_above_the_mtu(transport: str) -> None:
    mtu = DEFAULT_MTU[transport]
    most = mtu & ~3  # submessages are aligned to four bytes
    fits, _ = plan(large(most - 12), transport=transport, create=0)
    assert (fits.fragments, fits.reliable_slot_size, fits.mtu) == (False, most, most)
    above, found_warnings = plan(large(most - 11), transport=transport, create=0)
    assert (above.fragments, above.mtu, found_warnings) == (True, mtu, [])
    assert above.reliable_slot_size == most + 4 + 4, "the message, and FRAGMENT's header in front of it"


@pytest.mark.parametrize("transport", ["serial", "tcp"])
def test_where_there_are_no_datagrams_the_longest_create_needs_no_mtu(transport: str) -> None:
    """CREATE cannot be fragmented; the MTU of a stream of bytes is a matter of memory alone."""
    streams, found_errors = plan(large(3000), transport=transport, create=2000)
    assert (streams.mtu, streams.best_effort_size, found_errors) == (2000, 2000, [])
    streams, _ = plan(large(1999 - 12), transport=transport, create=2000)
    assert not streams.fragments


@pytest.mark.parametrize("transport", ["udp", "custom"])
def test_a_create_above_the_datagram_is_an_error(transport: str) -> None:
    mtu = DEFAULT_MTU[transport]
    assert plan(INT32, transport=transport, create=mtu)[1] == []
    what = (
        f"the longest CREATE message takes {mtu + 1} bytes and without transport.mtu a datagram holds {mtu}"
    )
    (error,) = plan(INT32, transport=transport, create=mtu + 1)[1]
    assert what in error
    application = Application(transport=Transport(mtu=600))
    what = "the longest CREATE message takes 601 bytes and transport.mtu is 600"
    (error,) = plan(INT32, application=application, transport="serial", create=601)[1]
    assert what in error


def test_a_create_above_a_frame_goes_in_fragments_on_the_reliable_stream() -> None:
    streams, found_errors = plan(
        INT32, application=RELIABLE, transport="canfd", create=92, reliable_input=True
    )
    assert found_errors == []
    assert (streams.mtu, streams.input_size, streams.fragments) == (63, 63, False)
    assert (streams.creation_fragments, streams.creation_size) == (True, 92 + 4), (
        "a fragment's header in front"
    )
    streams, _ = plan(INT32, application=RELIABLE, transport="canfd", create=63, reliable_input=True)
    assert (streams.creation_fragments, streams.creation_size) == (False, 63)


def test_a_create_beyond_what_an_agent_holds_is_an_error() -> None:
    most = 15 * (63 - 8) + 4
    assert plan(INT32, application=RELIABLE, transport="canfd", create=most, reliable_input=True)[1] == []
    (error,) = plan(INT32, application=RELIABLE, transport="canfd", create=most + 1, reliable_input=True)[1]
    assert f"the longest CREATE message takes {most + 1} bytes and a CAN FD frame holds 63" in error


@pytest.mark.parametrize("reliable", [True, False])
def test_what_fits_no_frame_is_sent_reliably_or_refused(reliable: bool) -> None:
    _, found = plan(large(100, reliable=reliable), transport="canfd", create=0)
    if reliable:
        assert found == []
    else:
        (error,) = found
        assert "takes up to 112 bytes in its stream and a CAN FD frame holds 63" in error
        assert "Lower its limits, or make it reliable: reliable messages are sent in fragments" in error


@given(size=st.integers(1, LARGEST_BODY), mtu=st.integers(64, 65507))
def test_a_slot_holds_the_whole_message(size: int, mtu: int) -> None:
    application = Application(transport=Transport(mtu=mtu))
    streams, found_warnings = plan(large(size), application=application, create=0)
    front = 8 if streams.fragments else 4
    assert found_warnings == []
    assert streams.fragments == (-(-(12 + size) // 4) * 4 > mtu)
    assert 0 <= streams.reliable_slot_size - (front + 8 + size) < 4
    assert streams.mtu <= mtu


def test_the_largest_message_is_reported() -> None:
    assert plan(large(LARGEST_BODY))[1] == []
    _, found_warnings = plan(large(LARGEST_BODY + 1))
    (line,) = found_warnings
    assert "a/msg/B on /b takes up to 65528 bytes, but a message holds at most 65527" in line


def test_a_best_effort_message_above_the_mtu_has_three_ways_out() -> None:
    (line,) = plan(large(1461, reliable=False))[1]
    assert "takes up to 1476 bytes in its stream and without transport.mtu a datagram holds 1472" in line
    assert (
        "Set transport.mtu: 1476, or lower its limits, or make it reliable: reliable messages are sent in"
        in line
    )
    (line,) = plan(replace(large(1461), best_effort=True))[1]
    assert "or declare its publisher under `nodes:` as reliable" in line


def test_no_advice_to_take_an_mtu_that_a_datagram_cannot_have() -> None:
    (line,) = plan(large(65_500, reliable=False))[1]
    assert "Set transport.mtu" not in line
    assert "Lower its limits, or make it reliable" in line
    (line,) = plan(large(65_500, reliable=False), transport="serial")[1]
    assert "Set transport.mtu: 65512, or lower its limits" in line


@pytest.mark.parametrize(
    ("size", "history"), [(4, 4), (256 - 12, 4), (256, 3), (356 - 12, 2), (1400, 2), (30_000, 2)]
)
def test_fewer_large_messages_are_kept(size: int, history: int) -> None:
    """Four, as long as they take 1 KiB, and two of any; what the application file says counts."""
    assert plan(large(size, reliable=True))[0].reliable_slots == history
    application = Application(pools={"history": 5})
    assert plan(large(size, reliable=True), application=application)[0].reliable_slots == 5


def test_the_settings_of_another_stack() -> None:
    """MTU 512, output history 4, input history 1, slots of the MTU."""
    application = Application(
        transport=Transport(mtu=512), pools={"history": 4, "input_history": 1, "slot_size": 512}
    )
    streams, found_warnings = plan(INT32, application=application, reliable_input=True)
    assert streams == StreamSizes(512, 512, 4, 512, 512, reliable_input_slots=1)
    assert streams.ram == 6 * 512
    assert found_warnings == []


def test_slots_above_the_mtu_are_for_reliable_streams_alone() -> None:
    application = Application(transport=Transport(mtu=512), pools={"slot_size": 2000, "input_history": 3})
    streams, _ = plan(INT32, application=application, reliable_input=True)
    assert (streams.best_effort_size, streams.input_size, streams.mtu) == (512, 512, 512)
    assert (streams.fragments, streams.reliable_slot_size, streams.reliable_input_slots) == (True, 2004, 3)
    nothing, _ = plan(application=application, create=0, reliable_input=True)
    assert (nothing.best_effort_size, nothing.reliable_slots, nothing.reliable_slot_size) == (0, 0, 0)


def test_an_input_history_without_a_reliable_input_stream_has_no_effect() -> None:
    streams, found_warnings = plan(INT32, application=Application(pools={"input_history": 2}))
    (line,) = found_warnings
    assert "'pools.input_history' has no effect" in line
    assert streams.reliable_input_slots == 0


def test_best_effort_messages_wait_for_the_task_of_the_session() -> None:
    """One for each writer, at least two, or as many as the file says; one more place is for what creates entities."""
    tasks = (TaskDecl("control", Named("a")),)
    many = [replace(INT32, best_effort=True) for _ in range(5)]
    streams, _ = plan(*many, application=Application(tasks=tasks))
    assert (streams.best_effort_slots, streams.best_effort_places) == (5, 6)
    assert streams.best_effort_shown == f"6 x {streams.best_effort_size}"
    assert streams.ram == plan(*many)[0].ram + 5 * streams.best_effort_size
    streams, _ = plan(many[0], application=Application(tasks=tasks), create=0)
    assert (streams.best_effort_slots, streams.best_effort_places) == (2, 2)
    application = Application(tasks=tasks, pools={"best_effort_history": 1})
    streams, warnings = plan(*many, application=application)
    assert (streams.best_effort_slots, streams.best_effort_places, warnings) == (1, 2, [])


def test_a_best_effort_history_without_tasks_has_no_effect() -> None:
    streams, found_warnings = plan(INT32, application=Application(pools={"best_effort_history": 3}))
    (line,) = found_warnings
    assert "'pools.best_effort_history' has no effect" in line
    assert (streams.best_effort_slots, streams.best_effort_places) == (0, 1)
    assert streams.best_effort_shown == str(streams.best_effort_size)


def test_drop_oldest_with_fragments_needs_two_slots() -> None:
    application = Application(on_full="drop_oldest", pools={"history": 1})
    (line,) = plan(large(5000), application=application)[1]
    assert "needs a history of 2" in line
    assert plan(INT32, application=application)[1] == []


def reception(
    *received: Received,
    transport: str = "udp",
    lends: bool = True,
    slot_size: int = 0,
    mtu: int | None = None,
) -> StreamSizes:
    application = Application(
        transport=Transport(mtu=mtu), pools={"slot_size": slot_size} if slot_size else {}
    )
    return plan_streams(
        application, transport, (INT32,), 92, Diagnostics(), True, received, lends_input=lends
    )


SCAN = Received("sensor_msgs/msg/LaserScan on /scan", 2944, True, False, alone=True)
FAST = replace(SCAN, reliable=False, best_effort=True)
SMALL = Received("std_msgs/msg/String on /said", 100, True, False)


def test_a_reliable_sample_that_waits_alone_arrives_in_fragments() -> None:
    """The client announces its input buffer to the agent; other whole messages and pools.slot_size make it larger."""
    streams = reception(SCAN)
    assert (streams.input_size, streams.arrives_in_fragments, streams.input_buffer) == (988, True, 988)
    assert reception(SCAN, transport="serial").input_size == 372
    assert reception(SCAN, SMALL, replace(SMALL, max_size=1200)).input_size == 1212
    assert reception(SCAN, slot_size=1400).input_size == 1400
    queued = reception(replace(SCAN, alone=False))
    assert (queued.input_size, queued.arrives_in_fragments) == (DEFAULT_MTU["udp"], True)
    small = reception(replace(SCAN, max_size=200))
    assert (small.input_size, small.arrives_in_fragments) == (212, False)
    pool = reception(replace(SCAN, best_effort=True), mtu=4000)
    assert (pool.input_size, pool.arrives_in_fragments) == (2956, False)


def test_a_best_effort_sample_that_waits_alone_waits_in_the_input_buffer() -> None:
    streams = reception(SMALL, FAST, mtu=4000)
    assert (streams.input_size, streams.input_reader, streams.input_free) == (2956, 1, 112)
    assert streams.input_buffer == 112 + 2944
    assert streams.ram == reception(SMALL, mtu=4000).ram + 2944
    for other in (
        reception(SMALL, FAST, mtu=4000, lends=False),
        reception(SMALL, replace(FAST, alone=False), mtu=4000),
        reception(SMALL, replace(FAST, reliable=True), mtu=4000),
        reception(replace(SMALL, max_size=2700), FAST, mtu=4000),
        reception(FAST, mtu=4000, slot_size=2800),
    ):
        assert (other.input_reader, other.input_buffer) == (None, other.input_size)
