# SPDX-License-Identifier: Apache-2.0
"""A board with an agent and another board at once: it publishes to rclpy and the board, and receives from both."""

from __future__ import annotations

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
from tests.support.free_ports import free_ports
from tests.support.runtime.peers import APPLICATION, HOST, board_program, started, system

pytestmark = pytest.mark.ros


@contextmanager
def agent_at(port: int, domain: int) -> Iterator[AgentProcess]:
    with running_agent(domain, "--domain", str(domain), transport=("udp4", "--port", str(port))) as running:
        yield running


def programs(folder: Path, agent: int, domain: int) -> tuple[Path, Path]:
    """Return the programs of both boards, of which only a has an agent."""
    ports = free_ports(2)
    ends = system(*(f"{HOST}:{port}" for port in ports))
    alone = in_domain(APPLICATION, domain)
    besides = with_agent(alone)
    besides += f'transport: {{type: udp, agent: "{HOST}:{agent}"}}\n'
    return (
        board_program(folder, "a", ends, besides, others=alone),
        board_program(folder, "b", ends, alone, others=besides),
    )


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

        kill(agent)
        errors = {numbers.publish() for _ in range(2)}
        errors |= exchange_alone(boards, numbers, numbers_of_b, 2)  # the time-out of the liveliness, and more
        assert any("session" in error or "acknowledged" in error for error in errors), errors
        assert not any("board b" in error for error in errors), errors

        with agent_at(port, domain):
            again = of_ros(observer, numbers, boards, 3)
            hear_ros(observer, FROM_ROS + 1, boards)
        assert again == sorted(set(again))
        assert b.values[SURE] == [*range(numbers.count)]
        assert of_b(a) == [*range(numbers_of_b.count)]
