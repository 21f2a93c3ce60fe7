# SPDX-License-Identifier: Apache-2.0
"""A board with an agent and another board at once: it publishes to rclpy and the board, and receives from both."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.free_ports import free_ports
from tests.support.patience import deadline, seconds
from tests.support.runtime.peers import APPLICATION, HOST, Board, board_program, started, system

pytestmark = pytest.mark.ros

BEST, SURE, INT32 = 0, 1, "std_msgs/msg/Int32"
FROM_ROS = 100_000
TIMES = (
    "round_trip: 50 ms, heartbeat: 10 ms, liveliness_period: 300 ms, liveliness_timeout: 1500 ms, retry_max: 500 ms,"
    " connect_timeout: 20 s, create_timeout: 20 s"
)


@contextmanager
def agent_at(port: int, domain: int) -> Iterator[AgentProcess]:
    with running_agent(domain, "--domain", str(domain), transport=("udp4", "--port", str(port))) as running:
        yield running


def programs(folder: Path, agent: int, domain: int) -> tuple[Path, Path]:
    """Return the programs of both boards, of which only a has an agent."""
    ports = free_ports(2)
    ends = system(*(f"{HOST}:{port}" for port in ports))
    alone = APPLICATION.replace("- name: board", f"- name: board\n    domain_id: {domain}")
    besides = alone.replace(
        "/sure, type: std_msgs/msg/Int32, peer: only", "/sure, type: std_msgs/msg/Int32, peer: also"
    )
    besides = besides.replace("round_trip: 20 ms, heartbeat: 10 ms", TIMES)
    besides += f'transport: {{type: udp, agent: "{HOST}:{agent}"}}\n'
    return (
        board_program(folder, "a", ends, besides, others=alone),
        board_program(folder, "b", ends, alone, others=besides),
    )


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


def test_besides_an_agent_that_is_killed(observer: Observer, domain: int, tmp_path: Path) -> None:
    [port] = free_ports(1)
    program_a, program_b = programs(tmp_path, port, domain)
    observer.subscribe("/a/sure", INT32)
    with agent_at(port, domain) as agent, started(program_a) as a, started(program_b) as b:
        boards, numbers, numbers_of_b = (a, b), Numbers(a), Numbers(b)
        until(lambda: not a.publish(BEST, 0), *boards)
        until(lambda: not b.publish(BEST, 0), *boards)
        assert numbers_of_b.publish() == ""
        first = of_ros(observer, numbers, boards, 3)
        assert first == sorted(set(first))
        hear_ros(observer, FROM_ROS, boards)

        agent.process.send_signal(signal.SIGKILL)
        agent.process.wait(timeout=seconds(15))
        errors = {numbers.publish() for _ in range(2)}
        end = time.monotonic() + 2  # the time-out of the liveliness, and more
        while time.monotonic() < end:
            errors.add(numbers.publish())
            until(lambda: len(b.values[SURE]) == numbers.count, *boards)
            assert numbers_of_b.publish() == ""
            until(lambda: len(of_b(a)) == numbers_of_b.count, *boards)
        assert any("session" in error or "acknowledged" in error for error in errors), errors
        assert not any("board b" in error for error in errors), errors

        with agent_at(port, domain):
            again = of_ros(observer, numbers, boards, 3)
            hear_ros(observer, FROM_ROS + 1, boards)
        assert again == sorted(set(again))
        assert b.values[SURE] == [*range(numbers.count)]
        assert of_b(a) == [*range(numbers_of_b.count)]
