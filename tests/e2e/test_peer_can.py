# SPDX-License-Identifier: Apache-2.0
"""One CAN FD bus with an agent and two boards: links between the boards, and both boards in ROS, all at once."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.board_and_ros import (
    BEST,
    FROM_ROS,
    INT32,
    SURE,
    TIMES,
    Numbers,
    exchange_alone,
    hear_ros,
    in_domain,
    kill,
    of_b,
    of_ros,
    until,
    with_agent,
)
from tests.support.e2e.can_bus import CanBus
from tests.support.runtime.peers import APPLICATION, Board, board_program, started, system

pytestmark = [pytest.mark.ros, pytest.mark.system]

A_TO_B, B_TO_A = 0x10102, 0x10201
A_TO_AGENT, B_TO_AGENT = 0x11, 0x12


@contextmanager
def agent_on(bus: CanBus, domain: int) -> Iterator[AgentProcess]:
    with running_agent(domain, "--domain", str(domain), transport=("canfd", "--dev", bus.device)) as running:
        yield running


def programs(folder: Path, bus: CanBus, domain: int) -> tuple[Path, Path]:
    """Return the programs of both boards: /a/sure and /b/best are for the other board and for ROS, too."""
    ends = system(bus.device, bus.device, "canfd")
    alone = in_domain(APPLICATION, domain)
    best = "/OWN/best, type: std_msgs/msg/Int32, peer: "
    line = 'transport: {{type: canfd, device: "{}", id: {}}}\n'
    of_a = with_agent(alone) + line.format(bus.device, A_TO_AGENT)
    of_b = alone.replace(f"{best}only", f"{best}also").replace("round_trip: 20 ms, heartbeat: 10 ms", TIMES)
    of_b += line.format(bus.device, B_TO_AGENT)
    return (
        board_program(folder, "a", ends, of_a, others=of_b),
        board_program(folder, "b", ends, of_b, others=of_a),
    )


def best_of_b(observer: Observer, boards: tuple[Board, Board], first: int) -> int:
    """Let b publish /b/best until rclpy and board a have one from now on; return the next number."""
    number, found = first, list[int]()

    def both() -> bool:
        nonlocal number
        found.extend(value["data"] for name, value in observer.ask(do="samples") if name == "/b/best")
        if any(value >= first for value in found) and any(v >= first for v in boards[0].values[BEST]):
            return True
        boards[1].publish(BEST, number)
        number += 1
        return False

    until(both, *boards, timeout_s=40)
    return number


def test_an_agent_and_links_share_a_bus(observer: Observer, domain: int, tmp_path: Path) -> None:
    """Numbers reach the other board and rclpy; the board gets all of them while frames are lost or no agent runs."""
    chance = random.Random(11)
    observer.subscribe("/a/sure", INT32)
    observer.subscribe("/b/best", INT32, reliable=False)
    with CanBus() as bus:
        program_a, program_b = programs(tmp_path, bus, domain)
        with agent_on(bus, domain) as agent, started(program_a) as a, started(program_b) as b:
            boards, numbers, numbers_of_b = (a, b), Numbers(a), Numbers(b)
            until(lambda: not a.publish(BEST, 0), *boards)
            until(lambda: not b.publish(BEST, 0), *boards)
            assert numbers_of_b.publish() == ""
            seen = of_ros(observer, numbers, boards, 3)
            assert seen == sorted(set(seen))
            hear_ros(observer, FROM_ROS, boards)
            best = best_of_b(observer, boards, 1)
            assert bus.identifiers() == {A_TO_B, B_TO_A, A_TO_AGENT, B_TO_AGENT}

            bus.lost = lambda frame: chance.random() < 0.1
            seen = of_ros(observer, numbers, boards, 5)
            assert seen == sorted(set(seen))
            hear_ros(observer, FROM_ROS + 1, boards)
            bus.lost = lambda frame: False
            assert bus.losses

            kill(agent)
            exchange_alone(boards, numbers, numbers_of_b, 1)

            with agent_on(bus, domain):
                again = of_ros(observer, numbers, boards, 3)
                hear_ros(observer, FROM_ROS + 2, boards)
                best_of_b(observer, boards, best)
            assert again == sorted(set(again))
            assert b.values[SURE] == [*range(numbers.count)]
            assert of_b(a) == [*range(numbers_of_b.count)]
