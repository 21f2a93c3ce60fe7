# SPDX-License-Identifier: Apache-2.0
"""Times of the session: slow links, and a device that rests. Time is made, so an hour takes no time."""

from __future__ import annotations

import subprocess
from collections import Counter
from itertools import pairwise
from pathlib import Path

import pytest

from microros_gen.application.model import SessionTimes
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.session_times import plan_times
from tests.support.patience import seconds
from tests.support.plans import EXECUTOR, POOL, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.harness import build, components, render
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.runtime.time_sync import EPOCH_NS, answer, moment
from tests.support.runtime.times import with_times
from tests.support.slices import first

ROUND_TRIP_MS = 3000
CREATE_CLIENT, CREATE, GET_INFO, READ_DATA, HEARTBEAT = 0x00, 0x01, 0x02, 0x08, 0x0B


SLOW = with_times(
    changed(READER, session__has_time_sync=True), SessionTimes(round_trip=ROUND_TRIP_MS + ROUND_TRIP_MS // 4)
)


class SlowAgent(ReadingAgent):
    """Answers TIMESTAMP too."""

    def receive(self, datagram: bytes) -> list[bytes]:
        if datagram[4] == 0x0E and datagram[0] == 0x81:
            self.log.append(datagram)
            return [] if self.silent else [answer(moment(EPOCH_NS), moment(EPOCH_NS), datagram[8:])]
        return super().receive(datagram)


def kinds(client: Client) -> Counter[int]:
    return Counter(message[4] for message in client.sent)


@pytest.fixture
def slow(bench: Bench) -> Client:
    """A client whose agent answers after three seconds, with all that it can have."""
    client = bench.start(SLOW, agent=SlowAgent())
    client.round_trip_ms = ROUND_TRIP_MS
    for call in (
        "init",
        "node 0 talker -",
        "publisher 0 0 Int32 chatter reliable",
        "publisher 1 0 Int32 fast best_effort",
        "read_init 0 0 Int32 in reliable",
    ):
        client.ok(call)
    return client


def test_nothing_is_asked_twice_in_three_seconds(slow: Client) -> None:
    sent = kinds(slow)
    assert sent[CREATE_CLIENT] == 1
    assert sent[CREATE] == 1 + 3 + 3 + 3, "a participant, and three objects of each of the others"
    assert len(set(slow.sent)) == len(slow.sent)
    slow.spin(40, 100)
    sent = kinds(slow)
    assert sent[READ_DATA] == 1
    assert len(slow.agent.objects) == 10


def test_samples_both_ways_with_three_seconds_of_round_trip(slow: Client) -> None:
    agent = slow.agent
    assert isinstance(agent, ReadingAgent)
    slow.spin(40, 100)
    slow.sent.clear()
    for value in range(4):
        slow.ok(f"publish 0 {value}")
    slow.ok("flush 5000")
    assert agent.values() == [0, 1, 2, 3]
    assert kinds(slow)[HEARTBEAT] == 0, "the acknowledgement is not late"
    slow.queued += agent.numbers(POOL.entities.publishers.max, 7, 8)
    slow.spin(2, 10)
    assert [slow.ok("read_take 0").lines[0].split()[1] for _ in range(2)] == ["7", "8"]
    slow.ok("epoch_sync 5000")
    assert slow.call("ping 4000 1").code == 0
    assert slow.call("ping 1000 5").code == 0, "the answer to the first question comes while the fourth waits"


def test_the_session_stays_with_three_seconds_of_round_trip(slow: Client) -> None:
    slow.sent.clear()
    slow.spin(6000, 100)
    assert slow.statistics()["reconnects"] == 0
    questions = kinds(slow)[GET_INFO]
    assert 32 <= questions <= 34, "after 15 s of silence, and the answer takes three"


def test_losses_are_repeated_with_three_seconds_of_round_trip(slow: Client) -> None:
    lost = iter([True, True])
    slow.agent.drop = lambda datagram: datagram[4] == 0x07 and next(lost, False)
    slow.ok("publish 0 1")
    slow.ok("flush 60000")
    assert slow.agent.values() == [1]
    assert slow.statistics()["resent"] == 2


def test_a_session_finds_back_with_three_seconds_of_round_trip(slow: Client) -> None:
    slow.agent.restart()
    slow.spin(1000, 100)
    assert slow.statistics()["reconnects"] == 1
    slow.ok("publish 0 5")
    slow.ok("flush 60000")
    assert slow.agent.values()[-1] == 5


def test_questions_to_a_silent_agent_grow_apart(bench: Bench) -> None:
    plan = with_times(POOL, SessionTimes(retry_max=600_000))
    client = bench.start(plan, agent=FakeAgent(silent=True))
    client.call("init")
    client.agent.silent = False
    client.ok("init")
    client.agent.silent = True
    client.sent.clear()
    client.sent_at.clear()
    client.spin(36_000, 100)
    questions = [
        at for at, message in zip(client.sent_at, client.sent, strict=True) if message[4] == CREATE_CLIENT
    ]
    pauses = [b - a for a, b in pairwise(questions)]
    assert len(questions) <= 20, "in an hour"
    assert all(b >= a - 100 for a, b in pairwise(pauses))
    assert pauses[-1] <= 600_100


def test_unanswered_heartbeats_become_rare(bench: Bench) -> None:
    client = bench.connected(with_times(POOL, SessionTimes(retry_max=15_000)), "none")
    client.ok("publish 0 1")
    client.agent.silent = True
    client.ok("publish 0 2")
    client.spin(36_000, 100)
    beats = kinds(client)[HEARTBEAT]
    assert 240 <= beats <= 280, "every quarter of a minute after a while"
    client.agent.silent = False
    client.ok("flush 16000")
    assert client.agent.values() == [1, 2]


def test_a_refused_entity_is_asked_for_ever_more_seldom(bench: Bench) -> None:
    client = bench.connected(with_times(POOL, SessionTimes()))
    client.agent.refuse["datawriter"] = 0x87
    client.call("publisher 1 0 Int32 other reliable")
    client.agent.restart()
    client.spin(50, 100)
    client.sent.clear()
    client.spin(6000, 100)
    assert 140 <= kinds(client)[CREATE] <= 150, "every four seconds in ten minutes"


def test_the_times_of_a_line_follow_from_its_baud() -> None:
    def first(baud: int | None, **times: int) -> int:
        return plan_times(SessionTimes(**times), baud, 512, 512).retry_first_ms

    assert first(None) == 100
    assert first(115_200) == 100
    assert first(2400) == 4330, "1038 bytes of ten bits"
    assert first(2400, round_trip=800) == 800
    slow = plan_times(SessionTimes(), 2400, 512, 512)
    assert slow.heartbeat_period_ms == 4330
    assert (slow.connect_timeout_ms, slow.create_timeout_ms, slow.close_timeout_ms) == (
        43_300,
        43_300,
        12_990,
    )
    assert (slow.liveliness_period_ms, slow.liveliness_wait_ms) == (17_320, 17_320)
    own = plan_times(SessionTimes(100, 1, 50, 20, 90, 5, 6, 0), None, 512, 512)
    assert vars(own) == {
        "retry_first_ms": 100,
        "retry_most_ms": 100,
        "heartbeat_period_ms": 50,
        "liveliness_period_ms": 20,
        "liveliness_wait_ms": 30,
        "liveliness_attempts": 3,
        "connect_timeout_ms": 5,
        "create_timeout_ms": 6,
        "close_timeout_ms": 0,
    }


def hour(plan: RuntimePlan, liveliness: str, folder: Path) -> tuple[int, int, list[int]]:
    """Return how often a quiet node woke in an hour, then with the agent gone, and when it looked for the agent.

    An application that sleeps itself, as long as the library says, wakes as often as an executor that spins.
    """
    names = [name for name in components(plan, liveliness) if name != "port_posix"]
    program = build(render(folder, plan, names), ["port_agent.c", "types_read.c", "unit_wakes.c"], "wakes")
    outputs = []
    for arguments in ((), ("itself",)):
        command = [program, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
        assert done.returncode == 0, done.stderr
        outputs.append(done.stdout)
    assert outputs[1] == outputs[0]
    words = [line.split() for line in outputs[0].splitlines()]
    woke = [int(number) for word, number in words if word == "woke"]
    return woke[0], woke[1], [int(number) for word, number in words if word == "asked"]


QUIET = changed(EXECUTOR, timers__max=0)
BATTERY = SessionTimes(retry_max=600_000, liveliness_period=300_000)


@pytest.mark.parametrize(
    ("liveliness", "times", "most"),
    [
        pytest.param("none", SessionTimes(), 1, marks=pytest.mark.variant),
        ("acknack", SessionTimes(), 1),
        pytest.param("ping", SessionTimes(), 2 * 3600, marks=pytest.mark.variant),
        ("ping", BATTERY, 2 * 12),
    ],
    ids=["none", "acknack", "ping", "ping of a battery device"],
)
def test_a_quiet_node_rests(liveliness: str, times: SessionTimes, most: int, tmp_path: Path) -> None:
    woke, _, _ = hour(with_times(QUIET, times), liveliness, tmp_path)
    assert woke <= most + 1, "in an hour"


@pytest.mark.parametrize("liveliness", first(["ping", "acknack"]))
def test_a_node_without_its_agent_rests_longer_and_longer(liveliness: str, tmp_path: Path) -> None:
    _, woke, questions = hour(with_times(QUIET, BATTERY), liveliness, tmp_path)
    pauses = [b - a for a, b in pairwise(questions)]
    assert 5 <= len(questions) <= 22
    assert pauses == sorted(pauses)
    assert pauses[-1] == 600_000
    assert woke <= len(questions) + 40, "those of HEARTBEATs while it is not lost yet"


def test_a_task_that_shares_the_library_rests(tmp_path: Path) -> None:
    """As one that has it alone; it was woken each second before."""
    plan = with_times(changed(QUIET, session__multithread=True), SessionTimes())
    names = [name for name in components(plan, "acknack") if name != "port_posix"]
    program = build(
        render(tmp_path, plan, names), ["port_agent.c", "types_read.c", "unit_wakes.c", "no_lock.c"], "w"
    )
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    words = [line.split() for line in done.stdout.splitlines()]
    woke = [int(number) for word, number in words if word == "woke"]
    assert woke[0] <= 2, "in an hour"
    assert sum(word == "asked" for word, _ in words) >= 5, "it looks for an agent that is gone"
