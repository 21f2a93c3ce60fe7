# SPDX-License-Identifier: Apache-2.0
"""The agent's view of its clients, with a fake clock: presence, loss, reconnects, and limits of what it keeps."""

from __future__ import annotations

from dataclasses import replace

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.output_queue import Queue
from microros_gen.agent.states import ClientState, Presence
from microros_gen.agent.traffic import Direction, Meter
from microros_gen.agent.wire.data_messages import ReadData
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities, sample
from tests.support.agent.stream_messages import heartbeat, write

KEY = "A1B2C3D4"
BEST_EFFORT = 1


def watched(limits: Limits | None = None) -> Bench:
    return Bench(limits, watched=True)


def opened(bench: Bench, key: str = "a1 b2 c3 d4", session: str = "81", address: str = "a") -> None:
    bench.say(CREATE_CLIENT.replace("a1 b2 c3 d4", key).replace("81", session), address)


def state(bench: Bench, key: str = KEY) -> ClientState:
    (found,) = [state for state in bench.agent.client_states() if state.key == key]
    return found


def test_a_client_from_its_first_message_to_its_last() -> None:
    bench = watched(Limits(client_timeout_s=10))
    assert bench.agent.client_states() == ()
    opened(bench)
    for sequence, create in enumerate(entities()):
        bench.say(message(create, sequence=sequence))
    assert replace(state(bench), received=Direction(), sent=Direction()) == ClientState(
        key=KEY,
        presence=Presence.CONNECTED,
        transport="fake",
        address="a",
        nodes=("0:/a",),
        silent_s=0.0,
        sessions=1,
        reconnects=0,
        silences=0,
        round_trip_s=None,
        lost=0,
        resent=0,
        last_error="",
    )
    bench.now += 3
    assert state(bench).silent_s == 3.0
    bench.wait(60)
    silent = state(bench)
    assert (silent.presence, silent.nodes, silent.silences) == (Presence.SILENT, ("0:/a",), 1)
    bench.say(write(9, 1, stream=BEST_EFFORT))
    bench.wait(1)
    back = state(bench)
    assert (back.presence, back.sessions, back.reconnects) == (Presence.CONNECTED, 1, 0)
    bench.say("81 00 00 00 03 01 04 00 00 09 ff fe")  # DELETE of the client
    assert state(bench).presence is Presence.GONE
    assert state(bench).nodes == ("0:/a",)


def test_the_api_is_empty_where_it_is_not_asked_for() -> None:
    bench = Bench()
    opened(bench)
    assert bench.agent.client_states() == ()


def test_lost_messages_are_counted_over_the_wrap_of_their_numbers() -> None:
    bench = watched()
    opened(bench)
    for sequence in (65_530, 65_531, 65_534, 2, 1, 3):  # 2 lost, then 3 (65535, 0, 1); 1 is late
        bench.say(write(sequence, 1, stream=BEST_EFFORT))
    assert state(bench).lost == 5


def test_messages_that_the_client_abandoned_are_lost() -> None:
    bench = watched()
    opened(bench)
    bench.say(write(0, 1))
    bench.say(write(3, 1))
    assert state(bench).lost == 0  # they may still come
    bench.say(heartbeat(5, 5))
    assert state(bench).lost == 3  # 1, 2 and 4


def test_a_board_that_restarts_keeps_its_counts() -> None:
    bench = watched()
    opened(bench)
    bench.say(write(0, 1, stream=BEST_EFFORT))
    bench.say(write(5, 1, stream=BEST_EFFORT))
    opened(bench)  # the same session id
    bench.say(write(0, 1, stream=BEST_EFFORT))
    bench.say(write(2, 1, stream=BEST_EFFORT))
    assert (state(bench).sessions, state(bench).reconnects, state(bench).lost) == (2, 1, 5)
    opened(bench, session="82")  # another one: a new client at the agent
    assert (state(bench).sessions, state(bench).reconnects, state(bench).lost) == (3, 2, 5)
    assert state(bench).presence is Presence.CONNECTED
    opened(bench, session="82", address="b")  # from elsewhere
    assert (state(bench).address, state(bench).reconnects) == ("b", 3)


def test_an_agent_that_restarts_begins_with_no_clients_and_no_counts() -> None:
    before = watched()
    opened(before)
    opened(before)
    assert state(before).reconnects == 1
    after = watched()
    after.say(write(7, 1, stream=BEST_EFFORT))  # of a session that it does not know
    assert after.agent.client_states() == ()
    opened(after)
    after.say(write(0, 1, stream=BEST_EFFORT))
    found = state(after)
    assert (found.presence, found.sessions, found.reconnects, found.lost) == (Presence.CONNECTED, 1, 0, 0)


def test_resent_messages_and_the_round_trip() -> None:
    bench = watched()
    opened(bench)
    for create in reader_entities():
        bench.say(message(create, stream=0))
    bench.say(message(ReadData(7, 0x16, 0x80, delivery=FOREVER), stream=0))
    source = bench.bridge.source("/a [std_msgs/msg/Int32]")
    source.put(sample(1), sample(2))
    bench.take()
    bench.say("81 00 00 00 0a 01 05 00 00 00 00 03 80")  # ACKNACK: both are missing
    assert state(bench).resent == 2
    bench.say("81 00 00 00 0a 01 05 00 02 00 00 00 80")
    source.put(sample(3))
    bench.take()
    bench.now += 0.25
    bench.say("81 00 00 00 0a 01 05 00 03 00 00 00 80")
    assert state(bench).round_trip_s == 0.25
    assert state(bench).resent == 2


def test_traffic_is_counted_in_both_directions_over_all_sessions() -> None:
    bench = watched()
    opened(bench)
    first = "81 01 00 00 0b 01 04 00 00 00 00 80"
    bench.say(first)
    before = state(bench)
    assert (before.received.messages, before.received.bytes) == (1, 12)
    bench.say(heartbeat(5, 5))  # is acknowledged
    assert state(bench).sent.messages == before.sent.messages + 1
    assert state(bench).sent.bytes == before.sent.bytes + 13
    opened(bench, session="82")
    after = state(bench)
    assert after.received.messages >= 2
    assert after.received.bytes >= 24
    assert after.sent.messages >= before.sent.messages + 1


def test_rates_are_those_of_the_last_second() -> None:
    bench = watched()
    opened(bench)
    bench.agent.care(bench.now)
    for sequence in range(50):
        bench.now += 0.02
        bench.say(write(sequence, 1, stream=BEST_EFFORT))
    bench.now += 0.001
    bench.agent.care(bench.now)
    measured = state(bench).received
    assert 49.8 < measured.messages_per_s < 50
    assert measured.bytes_per_s == pytest.approx(measured.messages_per_s * 16)
    bench.now += 1
    bench.agent.care(bench.now)
    assert state(bench).received == replace(measured, messages_per_s=0.0, bytes_per_s=0.0)


def test_a_meter_needs_an_interval() -> None:
    meter = Meter()
    meter.measure((1, 2, 3, 4), 1.0)
    meter.measure((1, 2, 3, 5), 1.0)
    assert meter.rates == (0.0, 0.0, 0.0, 0.0)
    meter.measure((2, 4, 3, 7), 1.5)
    assert meter.rates == (2.0, 4.0, 0.0, 4.0)


def test_messages_that_a_client_sends_again() -> None:
    bench = watched()
    opened(bench)
    for sequence in (0, 2, 2, 0, 40):  # 40 is beyond the window
        bench.say(write(sequence, 1))
    assert state(bench).repeated == 2
    opened(bench)
    bench.say(write(0, 1))
    bench.say(write(0, 1))
    assert state(bench).repeated == 3
    assert state(bench).input_bytes == 0


def test_the_queue_of_a_client_that_acknowledges_nothing() -> None:
    bench = watched()
    opened(bench)
    for create in reader_entities():
        bench.say(message(create, stream=0))
    bench.say(message(ReadData(7, 0x16, 0x80, delivery=FOREVER), stream=0))
    source = bench.bridge.source("/a [std_msgs/msg/Int32]")
    fills = []
    for number in range(20):
        source.put(sample(number))
        bench.take()
        fills.append(state(bench).queue.fill)
    assert fills == [min(1.0, (number + 1) / 16) for number in range(20)]
    assert state(bench).queue.messages == 16
    assert state(bench).queue.bytes > 16 * 12
    bench.say("81 00 00 00 0a 01 05 00 10 00 00 00 80")
    assert state(bench).queue.messages == 4
    bench.say("81 00 00 00 0a 01 05 00 14 00 00 00 80")
    assert state(bench).queue == Queue(0, 0, 0.0)


def test_the_view_is_taken_when_it_is_asked_for() -> None:
    bench = watched()
    opened(bench)
    bench.agent.care(bench.now)
    assert bench.agent.latest_client_states() == ()
    bench.agent.care(bench.now)
    assert [each.key for each in bench.agent.latest_client_states()] == [KEY]


def test_the_last_error_of_each_client() -> None:
    bench = watched()
    opened(bench)
    opened(bench, key="00 00 00 77", address="b")
    for _ in range(200):  # more than the log writes
        bench.say("81 01 04 00 01 01 10 00 00 0c 00 23 03 03 00 00 02 00 00 00 00 00 00 21")
    assert "publisher 0x0023 refused (UNKNOWN_REFERENCE)" in state(bench).last_error
    assert state(bench, "00000077").last_error == ""
    bench.say("81 80 00 00 ff 01 40 00", "b")
    assert state(bench, "00000077").last_error


def test_what_is_kept_of_clients_that_left_is_limited() -> None:
    bench = watched(Limits(clients=100))
    for number in range(300):
        opened(bench, key=number.to_bytes(4, "big").hex(" "), address=f"at {number}")
        if number < 200:
            bench.say("81 00 00 00 03 01 04 00 00 09 ff fe", f"at {number}")
    states = bench.agent.client_states()
    assert [s.presence for s in states].count(Presence.GONE) == 100
    assert [s.key for s in states if s.presence is Presence.CONNECTED] == [
        f"{n:08X}" for n in range(200, 300)
    ]
