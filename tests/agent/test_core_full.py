# SPDX-License-Identifier: Apache-2.0
"""DDS has no room for a sample: what is reliable waits unacknowledged, in order, and nobody else waits for it."""

from __future__ import annotations

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.processing import LONGEST_RETRY_S
from microros_gen.agent.ros.bridge import BusyError
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import DataFormat, SubmessageId
from microros_gen.agent.wire.entity_messages import Delete, Fragment, Reset
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.samples import Sample, write_samples
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.captured import CREATE_CLIENT, STATUS_AGENT
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import entities, message, publishing
from tests.support.agent.fakes import Bench
from tests.support.agent.stream_messages import RELIABLE, acknacks, heartbeat, samples, values, write


def full(limits: Limits | None = None) -> Bench:
    bench = publishing(limits)
    bench.bridge.room = 0
    return bench


def drain(bench: Bench, room: int | None = None) -> list[tuple[int, int]]:
    """Let DDS take `room` samples more (None: any number) and time pass; return the acknowledgements."""
    bench.bridge.room = room
    return acknacks(bench.wait(LONGEST_RETRY_S, 0.001))


def test_a_reliable_sample_is_acknowledged_after_dds_has_it() -> None:
    bench = full()
    assert acknacks(bench.say(write(0, 1))) == [(0, 0)]
    assert acknacks(bench.say(write(1, 2))) == [(0, 0)]
    assert acknacks(bench.say(heartbeat(0, 2))) == [(0, 4)]  # the third lacks
    assert acknacks(bench.say(write(0, 1))) == [(0, 4)]  # the client repeats the first
    assert set(drain(bench, 0)) == {(0, 4)}
    assert values(bench) == []
    assert drain(bench, 1)[-1] == (1, 2)
    assert values(bench) == [1]
    assert drain(bench) == [(2, 1)]
    assert values(bench) == [1, 2]
    assert acknacks(bench.say(write(2, 3))) == [(3, 0)]
    assert values(bench) == [1, 2, 3]
    assert bench.agent.samples == 3
    assert bench.log.counters == {"publish_waits": 1}
    assert bench.agent.due() != bench.now  # nothing is tried any more


def test_several_samples_of_a_message_go_once_each() -> None:
    bench = full()
    bench.bridge.room = 2
    assert acknacks(bench.say(write(0, 1, 2, 3, 4))) == [(0, 0)]
    assert values(bench) == [1, 2]
    assert drain(bench, 1)[-1] == (0, 0)
    assert drain(bench) == [(1, 0)]
    assert values(bench) == [1, 2, 3, 4]


@pytest.mark.parametrize("little", [True, False])
def test_a_sequence_of_samples_goes_on_where_it_stopped(little: bool) -> None:
    bench = full()
    writer = Writer(little)
    write_samples(writer, DataFormat.DATA_SEQ, [Sample(int32_body(v)) for v in (1, 2, 3)])
    ids = b"\0\x01\0\x15"
    body = ids + writer.content()
    flags = int(little) | DataFormat.DATA_SEQ
    head = bytes((SubmessageId.WRITE_DATA, flags, len(body), 0))
    data = join(Header(0x81, RELIABLE, 0), [head + body])
    bench.bridge.room = 1
    assert acknacks(bench.say(data)) == [(0, 0)]
    assert drain(bench, 1)[-1] == (0, 0)
    assert drain(bench) == [(1, 0)]
    assert values(bench) == [1, 2, 3]
    assert bench.agent.samples == 3


def test_fragments_are_acknowledged_up_to_the_last() -> None:
    bench = full()
    whole = encode(samples(7)[0])
    assert acknacks(bench.say(message(Fragment(whole[:8], False), stream=RELIABLE, sequence=0))) == [(1, 0)]
    assert acknacks(bench.say(message(Fragment(whole[8:], True), stream=RELIABLE, sequence=1))) == [(1, 0)]
    assert acknacks(bench.say(write(2, 8))) == [(1, 0)]
    assert drain(bench) == [(3, 0)]
    assert values(bench) == [7, 8]


@pytest.mark.parametrize("room", [0, 1, 2, 3])
def test_what_follows_the_last_fragment_follows_it_to_dds(room: int) -> None:
    """One message has the end of one sample, two more samples, and a question that is answered after them."""
    bench = full()
    bench.bridge.room = room
    whole = encode(samples(7)[0])
    bench.say(message(Fragment(whole[:8], False), stream=RELIABLE, sequence=0))
    tail = message(Fragment(whole[8:], True), *samples(8, 9), Delete(9, 0x15), stream=RELIABLE, sequence=1)
    reported = acknacks(bench.say(tail))
    assert values(bench) == [7, 8, 9][:room]
    assert reported[-1] == ((1 if room < 3 else 2), 0)
    assert acknacks(bench.say(write(2, 10)))[-1] == ((1 if room < 3 else 3), 0)
    assert drain(bench)[-1:] == ([(3, 0)] if room < 3 else [])
    assert values(bench) == [7, 8, 9]
    assert bench.log.counters["unknown_writer"] == 1, "the last sample came behind the DELETE"
    (client,) = bench.agent.clients
    assert client.session._holder.held == 0


def test_messages_after_a_gap_follow() -> None:
    bench = full()
    bench.say(write(1, 2))
    bench.say(write(2, 3))
    bench.bridge.room = 1
    assert acknacks(bench.say(write(0, 1))) == [(1, 0)]
    bench.say(write(4, 5))
    assert acknacks(bench.say(heartbeat(1, 4))) == [(1, 0b100)]
    assert drain(bench) == [(3, 1)]
    bench.say(write(3, 4))
    assert values(bench) == [1, 2, 3, 4, 5]


def test_an_answer_does_not_acknowledge_messages_after_the_request() -> None:
    """Answers go out with the acknowledgements that are due; samples after the question are not done then."""
    bench = full()
    bench.bridge.room = None
    question = entities()[0]
    bench.say(write(1, 1))
    reported = acknacks(bench.say(message(question, stream=RELIABLE, sequence=0)))
    assert reported == [(1, 0), (2, 0)]
    reported = acknacks(bench.say(message(question, *samples(2), stream=RELIABLE, sequence=2)))
    assert reported == [(2, 0), (3, 0)]
    bench.bridge.room = 0
    reported = acknacks(bench.say(message(question, *samples(3), stream=RELIABLE, sequence=3)))
    assert reported == [(3, 0), (3, 0)]
    assert drain(bench) == [(4, 0)]
    assert values(bench) == [1, 2, 3]


def test_best_effort_samples_are_dropped_and_counted() -> None:
    bench = full()
    assert bench.say(write(9, 1, 2, stream=1)) == []
    assert bench.log.counters == {"publish": 2}
    assert drain(bench) == []
    assert values(bench) == []


def test_other_streams_and_clients_go_on() -> None:
    bench = full()
    bench.say(write(0, 1))
    other = CREATE_CLIENT.replace("a1 b2", "77 77")
    assert bench.say(other, "b") == [STATUS_AGENT]
    assert bench.say("81 00 00 00 0e 01 08 00 01 02 03 04 05 06 07 08")  # a question of the time
    (answer,) = bench.say(message(Delete(9, 0x15), stream=1, sequence=9))
    assert answer.endswith("00 00")
    assert drain(bench) == [(1, 0)]  # its writer is gone
    assert bench.log.counters == {"publish_waits": 1, "unknown_writer": 1}


def test_what_waits_is_bounded() -> None:
    bench = full(Limits(message_bytes=40))
    for sequence in range(40):
        assert acknacks(bench.say(write(sequence, sequence)))[0][0] == 0
    assert drain(bench)[0][0] == 3  # 40 bytes: two more besides the one that stopped
    assert values(bench) == [0, 1, 2]


def test_it_is_tried_less_and_less_often(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = full()
    bench.say(write(0, 1))
    tries = len(acknacks(bench.wait(1, 0.001)))
    assert 15 <= tries <= 22


def test_a_writer_that_waits_long_is_tried_seldom(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where DDS waits for 100 ms and then refuses, nine tenths of the time are for others."""
    bench = full()
    tries = []

    def wait_and_refuse(serialized: bytes) -> None:
        tries.append(bench.now)
        bench.now += 0.1
        raise BusyError("full")

    entity = bench.agent.clients.with_key(bytes.fromhex("A1B2C3D4")).objects.find(0x15)  # type: ignore[union-attr]
    monkeypatch.setattr(entity.writer, "publish", wait_and_refuse)  # type: ignore[union-attr]
    bench.say(write(0, 1))
    bench.wait(5, 0.01)
    assert 4 <= len(tries) <= 7


def test_a_client_that_drops_a_sample_continues_after_it() -> None:
    bench = full()
    bench.say(write(0, 1))
    bench.say(write(1, 2))
    assert acknacks(bench.say(heartbeat(1, 1))) == [(1, 0)]
    assert drain(bench) == [(2, 0)]
    assert values(bench) == [2]


@pytest.mark.parametrize("restart", [message(Reset(), stream=0), CREATE_CLIENT])
def test_a_new_start_forgets_what_waits(restart: bytes | str) -> None:
    bench = full()
    bench.say(write(0, 1))
    bench.say(restart)
    assert drain(bench) == []
    assert acknacks(bench.say(write(0, 2))) == [(1, 0)]
    assert values(bench) == [2]


def test_it_waits_for_a_client_that_sleeps() -> None:
    bench = full()
    bench.say(write(0, 1))
    bench.wait(31)
    assert bench.bridge.graph == []
    bench.bridge.room = None
    bench.wait(1)
    assert values(bench) == []
    assert acknacks(bench.say(heartbeat(0, 0))) == [(0, 0)]
    assert drain(bench) == [(1, 0)]
    assert values(bench) == [1]


def test_a_client_that_left_is_forgotten() -> None:
    bench = full()
    bench.say(write(0, 1))
    bench.say("81 00 00 00 03 01 04 00 00 02 ff fe")
    assert bench.wait(1, 0.001) == []
    assert bench.agent.due() is None
