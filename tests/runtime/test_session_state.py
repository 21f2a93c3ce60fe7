# SPDX-License-Identifier: Apache-2.0
"""What the application is told of its session, without doing anything for it."""

from __future__ import annotations

from tests.support.plans import POOL, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.reading_agent import ReadingAgent

CLOSED, CONNECTING, CONNECTED, LOST, RECONNECTING = range(5)
NONE, SILENT, FORGOTTEN, UNACKNOWLEDGED, BROKEN, REFUSED = range(6)
PLAN = changed(READER, session__has_state=True, session__has_sleep=True)
PERIOD = POOL.times.liveliness_period_ms


class Watched:
    """A client with a publisher and a subscription; `reported` are (state, reason) in their order."""

    def __init__(self, bench: Bench, liveliness: str = "ping") -> None:
        self.agent = ReadingAgent()
        self.client: Client = bench.start(PLAN, liveliness, agent=self.agent)
        self.reported: list[tuple[int, int]] = []
        self.counters: dict[str, int] = {}
        for call in (
            "extra_watch",
            "init",
            "node 0 n -",
            "publisher 0 0 Int32 out reliable",
            "read_init 0 0 Int32 in reliable",
        ):
            self.call(call)
        self.spin(3)

    def call(self, command: str) -> tuple[str, ...]:
        result = self.client.call(command)
        for line in result.lines:
            word, *rest = line.split()
            if word == "event":
                self.reported.append((int(rest[0]), int(rest[1])))
                self.counters = {k: int(v) for k, v in (pair.split("=") for pair in rest[2:])}
        return result.lines

    def spin(self, times: int, step: int = 0) -> None:
        for _ in range(times):
            self.client.wait(step)
            self.call("spin")

    def news(self) -> list[tuple[int, int]]:
        reported, self.reported = self.reported, []
        return reported


def test_the_agent_restarts(bench: Bench) -> None:
    """Entities come back, the publisher counts what it gave up, the subscription goes on."""
    watched = Watched(bench)
    assert watched.news() == [(CONNECTING, NONE), (CONNECTED, NONE)]
    watched.agent.restart()
    watched.spin(1, PERIOD + 1)
    watched.call("spin")
    assert watched.news()[0] == (LOST, FORGOTTEN)
    for value in range(6):
        watched.call(f"publish 0 {value}")
    watched.spin(20, 20)
    assert watched.news() == [(RECONNECTING, NONE), (CONNECTED, NONE)]
    assert watched.counters["losses"] == watched.counters["reconnects"] == 1
    kept = watched.agent.values()
    assert kept == sorted(set(kept))
    assert len(kept) + watched.counters["dropped"] == 6, "each was sent once, or counted"
    watched.client.queued += watched.agent.numbers(PLAN.entities.publishers.max, 5)
    watched.spin(1)
    assert watched.call("read_take 0") == ("value 5",)


def test_a_link_that_breaks_and_a_session_that_is_refused(bench: Bench) -> None:
    watched = Watched(bench)
    watched.news()
    watched.agent.silent = True
    watched.spin(8, PERIOD)
    assert watched.news() == [(LOST, SILENT)]
    watched.agent.silent, watched.agent.session_status = False, 0x87
    watched.spin(8, PERIOD)
    assert watched.news() == [(LOST, REFUSED)], "told once, asked again and again"
    watched.agent.session_status = 0
    watched.spin(20, PERIOD)
    assert watched.news() == [(RECONNECTING, NONE), (CONNECTED, NONE)]
    watched.call("fini")
    assert watched.news() == [(CLOSED, NONE)]


def test_unacknowledged_data(bench: Bench) -> None:
    watched = Watched(bench, "acknack")
    watched.news()
    watched.agent.silent = True
    watched.call("publish 0 1")
    watched.spin(6, PERIOD)
    assert watched.news() == [(LOST, UNACKNOWLEDGED)]


def test_a_callback_that_is_taken_back(bench: Bench) -> None:
    client = bench.start(PLAN, agent=ReadingAgent())
    client.ok("extra_watch")
    client.ok("extra_unwatch")
    assert client.ok("init").lines == ("open 127.0.0.1 8888",)
