# SPDX-License-Identifier: Apache-2.0
"""The agent's time on the device: TIMESTAMP, and whatever answer there may be."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from itertools import count

import pytest

from tests.support.plans import POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.time_sync import EPOCH_NS, TimedAgent, answer, moment

PLAN = changed(POOL, session__has_time_sync=True)
START_MS = 5_000_000_124
"""The steady time of the fake port when it has a session: connecting took a millisecond."""
MOST_S = 2**31 - 1


def start(bench: Bench, reply: Callable[[bytes], list[bytes]]) -> tuple[Client, TimedAgent]:
    agent = TimedAgent(reply=reply)
    client = bench.start(PLAN, agent=agent)
    client.ok("init")
    return client, agent


def epoch(client: Client) -> tuple[bool, int, int]:
    """Return whether the time is the agent's, and the time in milliseconds and nanoseconds."""
    result = client.call("epoch_now")
    (line,) = (x for x in result.lines if x.startswith("epoch"))
    _, milliseconds, nanoseconds = line.split()
    return bool(result.code), int(milliseconds), int(nanoseconds)


def stamp(client: Client) -> tuple[bool, int, int]:
    """Return whether the stamp is the agent's time, its seconds and nanoseconds; (False, -1, 10**9): not written."""
    result = client.call("epoch_stamp")
    (line,) = (x for x in result.lines if x.startswith("stamp"))
    _, seconds, nanoseconds = line.split()
    return bool(result.code), int(seconds), int(nanoseconds)


UNWRITTEN = (False, -1, 10**9)


def test_before_a_context_there_is_no_time(bench: Bench) -> None:
    client = bench.start(PLAN)
    assert epoch(client) == (False, 0, 0)
    assert stamp(client) == UNWRITTEN
    result = client.call("epoch_sync 1000")
    assert (result.code, result.error) == (1, "session: NULL or not initialized")


def test_before_it_was_asked_time_is_that_since_the_start(bench: Bench) -> None:
    client, agent = start(bench, lambda _: [])
    assert epoch(client) == (False, START_MS, START_MS * 10**6)
    assert stamp(client) == (False, START_MS // 1000, START_MS % 1000 * 10**6)
    assert agent.requests == []


@pytest.mark.parametrize("agent_ns", [EPOCH_NS, 1, MOST_S * 10**9 + 999_999_997, 2 * MOST_S * 10**9])
def test_the_offset_follows_from_four_moments(bench: Bench, agent_ns: int) -> None:
    """The question takes no time, the agent 2 ns, the answer 1 ms: half of it is the error that nobody can know."""
    client, agent = start(bench, lambda o: [answer(moment(agent_ns + 2), moment(agent_ns), o)])
    client.ok("epoch_sync 1000")
    assert len(agent.requests) == 1
    assert agent.requests[0] == START_MS * 10**6
    originated, ended = agent.requests[0], agent.requests[0] + 10**6
    twice_the_offset = (agent_ns - originated) + (agent_ns + 2 - ended)
    synchronized, milliseconds, nanoseconds = epoch(client)
    assert synchronized
    assert abs(2 * (nanoseconds - ended) - twice_the_offset) <= 1
    assert abs(milliseconds * 10**6 - nanoseconds) < 10**6
    fits = nanoseconds // 10**9 <= MOST_S
    assert stamp(client) == ((True, *divmod(nanoseconds, 10**9)) if fits else UNWRITTEN)


def test_time_goes_on_after_it(bench: Bench) -> None:
    client, _ = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)])
    client.ok("epoch_sync 1000")
    before = epoch(client)[2]
    client.wait(0x7FFF_FFFF)
    client.wait(0x7FFF_FFFF)
    client.wait(10)
    assert epoch(client)[2] - before == (2 * 0x7FFF_FFFF + 10) * 10**6, (
        "longer than the port counts milliseconds"
    )


@pytest.mark.parametrize("round_trip_ms", [30, 90, 150, 900, 3000])
def test_any_round_trip_below_the_time_out(bench: Bench, round_trip_ms: int) -> None:
    """The answer takes all of the time, so the result is wrong by half of it, as for any client."""
    client, _ = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)])
    before = client.now_ms
    client.round_trip_ms = round_trip_ms
    result = client.ok(f"epoch_sync {round_trip_ms + 100}")
    assert round_trip_ms <= result.slept <= round_trip_ms + 2
    passed_ns = (client.now_ms - before) * 10**6
    assert abs(epoch(client)[2] - EPOCH_NS - passed_ns) <= (round_trip_ms // 2 + 2) * 10**6
    assert client.call(f"epoch_sync {round_trip_ms - 10}").code == 1


def test_of_several_answers_the_quickest_counts(bench: Bench) -> None:
    """As a modem that wakes up delivers them: the questions of a second all at once."""
    client, agent = start(bench, lambda _: [])

    def deliver() -> None:
        if client.now_ms - began == 990:
            right = EPOCH_NS + 990 * 10**6
            order = agent.requests[::-1] + agent.requests
            client.queued += [answer(moment(right), moment(right), moment(requested)) for requested in order]

    began = client.now_ms
    client.on_sleep = deliver
    client.ok("epoch_sync 2000")
    assert len(agent.requests) > 2
    largest_error = START_MS * 10**6 + 990 * 10**6 - agent.requests[-1]
    assert abs(epoch(client)[2] - EPOCH_NS - 990 * 10**6) <= largest_error // 2 + 2 * 10**6


def test_a_late_answer_to_a_call_that_has_ended_changes_nothing(bench: Bench) -> None:
    client, _ = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)])
    client.round_trip_ms = 200
    assert client.call("epoch_sync 100").code == 1
    client.spin(20, 20)
    assert not epoch(client)[0]
    client.round_trip_ms = 0
    client.ok("epoch_sync 100")


def test_a_big_endian_answer(bench: Bench) -> None:
    def reply(originate: bytes) -> list[bytes]:
        seconds, nanoseconds = struct.unpack("<iI", originate)
        requested = seconds * 10**9 + nanoseconds
        return [answer(moment(EPOCH_NS, ">"), moment(EPOCH_NS, ">"), moment(requested, ">"), flags=0)]

    client, _ = start(bench, reply)
    client.ok("epoch_sync 1000")
    assert abs(epoch(client)[2] - EPOCH_NS) < 10**6


def test_what_is_lost_is_asked_again(bench: Bench) -> None:
    replies: Iterator[int] = count()
    client, agent = start(
        bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)] if next(replies) == 3 else []
    )
    result = client.ok("epoch_sync 1000")
    assert 3 * PLAN.times.retry_first_ms <= result.slept <= 3 * PLAN.times.retry_first_ms + 5
    assert len(agent.requests) == 4
    assert len(set(agent.requests)) == 4, "each question has its own time"


@pytest.mark.parametrize(("timeout", "questions"), [(0, 1), (-1, 1), (40, 1), (41, 2), (100, 3)])
def test_no_answer_ends_in_time(bench: Bench, timeout: int, questions: int) -> None:
    client, agent = start(bench, lambda _: [])
    result = client.call(f"epoch_sync {timeout}")
    assert result.code == 1
    assert result.error == f"no agent answers at 127.0.0.1:8888 within {max(timeout, 0)} ms"
    assert result.slept == max(timeout, 0)
    assert len(agent.requests) == questions
    assert not epoch(client)[0]


def test_an_answer_to_another_question_does_not_count(bench: Bench) -> None:
    client, _ = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), moment(7))])
    assert client.call("epoch_sync 50").code == 1
    assert not epoch(client)[0]
    assert client.statistics()["malformed"] == 0, "it is late, not wrong"


@pytest.mark.parametrize(
    "spoil",
    [
        lambda o: answer(moment(EPOCH_NS), moment(EPOCH_NS), o[:-1]),
        lambda o: answer(moment(EPOCH_NS), moment(EPOCH_NS), b""),
        lambda o: answer(b"", b"", b""),
        lambda o: answer(struct.pack("<iI", 1, 10**9), moment(EPOCH_NS), o),
        lambda o: answer(moment(EPOCH_NS), struct.pack("<iI", 1, 2**32 - 1), o),
    ],
)
def test_a_malformed_answer_is_counted(bench: Bench, spoil: Callable[[bytes], bytes]) -> None:
    replies = count()

    def reply(originate: bytes) -> list[bytes]:
        good = answer(moment(EPOCH_NS), moment(EPOCH_NS), originate)
        return [spoil(originate) if next(replies) == 0 else good]

    client, agent = start(bench, reply)
    client.ok("epoch_sync 1000")
    assert len(agent.requests) == 2
    assert client.statistics()["malformed"] == 1
    assert abs(epoch(client)[2] - EPOCH_NS) < 2 * 10**6


def test_an_unasked_answer_changes_nothing(bench: Bench) -> None:
    client, agent = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)] * 2)
    client.ok("epoch_sync 1000")
    before = epoch(client)
    client.queued.append(answer(moment(5), moment(5), moment(agent.requests[0])))
    client.spin()
    assert epoch(client) == before


def test_time_outlives_a_lost_session(bench: Bench) -> None:
    client, agent = start(bench, lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)])
    client.ok("epoch_sync 1000")
    before = epoch(client)
    agent.restart()
    client.spin(8, POOL.times.liveliness_period_ms)
    assert client.statistics()["reconnects"] == 1
    assert epoch(client)[0]
    assert epoch(client)[2] - before[2] == 8 * POOL.times.liveliness_period_ms * 10**6
