# SPDX-License-Identifier: Apache-2.0
"""One executor on a board with all that a node has, over the serial line, to rclpy and back, in rclpy's time."""

from __future__ import annotations

import time
from itertools import pairwise

import pytest

from tests.support.agent.observer import Observer
from tests.support.e2e.serving import await_replies
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.everything import APPLICATION
from tests.support.firmware.running import BOARD, started
from tests.support.patience import deadline

TYPE = "rcl_interfaces/srv/GetParameterTypes"
TOPICS = ("/ticks", "/seen")
HEARD, ANSWERED = 1000, 2000
"""The board publishes on /seen: HEARD and what came on /set, ANSWERED and each element of a reply."""
VALUES = list(range(8))
PERIOD_MS, JUMP_MS = 50, 60_000


class RosTime:
    """/clock: each step lets the period of the board's timer pass; between steps time stands still."""

    def __init__(self, observer: Observer) -> None:
        self._observer = observer
        self.steps = 0
        self._now_ms = 100_000
        self._publish([])

    def step(self, by_ms: int = PERIOD_MS) -> None:
        self.steps += 1
        self._now_ms += by_ms
        now = {"sec": self._now_ms // 1000, "nanosec": self._now_ms % 1000 * 1_000_000}
        self._publish([{"clock": now}])

    def _publish(self, values: list[object]) -> None:
        self._observer.ask(do="publish", topic="/clock", type="rosgraph_msgs/msg/Clock", values=values)


@pytest.mark.ros
def test_everything_under_one_executor(builds: Builds, observer: Observer, domain: int) -> None:
    built = builds.merged(BOARD, APPLICATION)
    need(BOARD, emulator=True)
    image = builds.application(built, "everything.c")
    for topic in TOPICS:
        observer.subscribe(topic, "std_msgs/msg/Int32", reliable=True)
    observer.ask(do="serve", service="/peer/lengths", type=TYPE, hold=1)
    with (
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        ros_time = RosTime(observer)
        running.go_on()
        before = _until(observer, ros_time, ANSWERED + 7)
        observer.ask(do="call", service="/lengths", type=TYPE, names=[["a", "bb"], ["ccc"], []])
        _publish_when_heard(observer)
        after = _until(observer, ros_time, HEARD + VALUES[-1])
        replies = await_replies(observer)
        still = _ticks(observer)  # time stands: what was on its way comes
        ros_time.step(JUMP_MS)
        late = _ticks(observer)
        refused = running.words("everything_refused")[0]
    ticks, seen = (before[topic] + after[topic] for topic in TOPICS)
    assert len(late) == 1, "one for all periods that a jump skips"
    ticks += still + late
    assert len(ticks) <= ros_time.steps
    assert replies == [[1, 2], [3], []]
    assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))
    assert [value - HEARD for value in seen if value < ANSWERED] == VALUES
    answered = [value - ANSWERED for value in seen if value >= ANSWERED]
    assert set(answered) == {3, 7}
    assert all(sample != other for sample, other in pairwise(answered)), "a reply was lost or came twice"
    assert refused == 0


def _ticks(observer: Observer) -> list[int]:
    """Return the ticks of half a second: ten periods of a timer that does not follow ROS time."""
    ticks: list[int] = []
    for _ in range(25):
        time.sleep(0.02)
        ticks += [value["data"] for topic, value in observer.ask(do="samples") if topic == "/ticks"]
    return ticks


def _until(observer: Observer, ros_time: RosTime, last: int) -> dict[str, list[int]]:
    """Return what comes on both topics while time goes on, until `last` has been seen."""
    found: dict[str, list[int]] = {topic: [] for topic in TOPICS}
    end = deadline(30)
    while last not in found["/seen"]:
        assert time.monotonic() < end, found
        for topic, value in observer.ask(do="samples"):
            if topic in found:
                found[topic].append(value["data"])
        ros_time.step()
        time.sleep(0.02)
    return found


def _publish_when_heard(observer: Observer) -> None:
    """Publish VALUES on /set when the board's subscription is there."""
    where = {"topic": "/set", "type": "std_msgs/msg/Int32"}
    observer.ask(do="publish", values=[], **where)
    end = deadline(15)
    while not observer.ask(do="matched", topic="/set"):
        assert time.monotonic() < end, "nobody hears /set"
        time.sleep(0.02)
    observer.ask(do="publish", values=[{"data": value} for value in VALUES], **where)
