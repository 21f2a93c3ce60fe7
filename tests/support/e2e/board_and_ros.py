# SPDX-License-Identifier: Apache-2.0
"""Two boards that exchange numbers, of which one has an agent, too, and rclpy on the other side of that."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.patience import deadline, seconds
from tests.support.runtime.peers import Board

BEST, SURE, INT32 = 0, 1, "std_msgs/msg/Int32"
FROM_ROS = 100_000
"""The first number that is from rclpy; those of the boards are lower."""
TIMES = (
    "round_trip: 50 ms, heartbeat: 10 ms, liveliness_period: 300 ms, liveliness_timeout: 1500 ms, retry_max: 500 ms,"
    " connect_timeout: 20 s, create_timeout: 20 s"
)


def with_agent(text: str) -> str:
    """Return the application of a board whose /OWN/sure and /OTHER/sure exist in ROS, too."""
    also = "/sure, type: std_msgs/msg/Int32, peer: "
    return text.replace(f"{also}only", f"{also}also").replace("round_trip: 20 ms, heartbeat: 10 ms", TIMES)


def in_domain(text: str, domain: int) -> str:
    """Return an application in a domain."""
    return text.replace("- name: board", f"- name: board\n    domain_id: {domain}")


def until(seen: Callable[[], object], *boards: Board, timeout_s: float = 20.0) -> None:
    """Let boards run until something is true."""
    end = deadline(timeout_s)
    while not seen():
        assert time.monotonic() < end, [board.values for board in boards]
        for board in boards:
            board.spin()


class Numbers:
    """The numbers that a board publishes, each once."""

    def __init__(self, board: Board) -> None:
        self._board = board
        self.count = 0

    def publish(self) -> str:
        """Publish the next one; return the error text."""
        error = self._board.publish(SURE, self.count)
        self.count += 1
        return error


def of_ros(observer: Observer, numbers: Numbers, boards: tuple[Board, Board], wanted: int) -> list[int]:
    """Let a publish until rclpy has `wanted` of its numbers from now on; return them."""
    start, found = numbers.count, list[int]()

    def enough() -> bool:
        found.extend(value["data"] for name, value in observer.ask(do="samples") if name == "/a/sure")
        if len([value for value in found if value >= start]) >= wanted:
            return True
        numbers.publish()
        until(lambda: len(boards[1].values[SURE]) == numbers.count, *boards)
        return False

    until(enough, *boards, timeout_s=40)
    return found


def hear_ros(observer: Observer, value: int, boards: tuple[Board, Board]) -> None:
    """Let rclpy publish a number until board a has received it."""

    def heard() -> bool:
        observer.ask(do="publish", topic="/b/sure", type=INT32, values=[{"data": value}])
        return value in boards[0].values[SURE]

    until(heard, *boards)


def of_b(board: Board) -> list[int]:
    """Return the numbers that are from board b."""
    return [value for value in board.values[SURE] if value < FROM_ROS]


def exchange_alone(
    boards: tuple[Board, Board], numbers: Numbers, numbers_of_b: Numbers, for_s: float
) -> set[str]:
    """Let the boards exchange numbers while no agent runs; return the errors that board a got.

    Each of its numbers reaches the other board all the same, and each of b reaches a.
    """
    errors, end = set[str](), time.monotonic() + for_s
    while time.monotonic() < end:
        errors.add(numbers.publish())
        until(lambda: len(boards[1].values[SURE]) == numbers.count, *boards)
        assert numbers_of_b.publish() == ""
        until(lambda: len(of_b(boards[0])) == numbers_of_b.count, *boards)
    return errors


def kill(agent: AgentProcess) -> None:
    """End an agent at once."""
    agent.process.send_signal(signal.SIGKILL)
    agent.process.wait(timeout=seconds(15))
