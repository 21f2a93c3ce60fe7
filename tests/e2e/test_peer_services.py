# SPDX-License-Identifier: Apache-2.0
"""A board that serves rclpy through its agent and another board over a link at once, and calls that board."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.free_ports import free_ports
from tests.support.runtime.peers import HOST, system
from tests.support.runtime.service_boards import (
    SERVICES,
    ServiceBoard,
    service_board,
    service_board_program,
    until,
)

pytestmark = pytest.mark.ros

CALLS = 6


def programs(folder: Path, agent: int, domain: int) -> tuple[Path, Path]:
    """Return the programs of both boards, of which only a has an agent."""
    ports = free_ports(2)
    ends = system(*(f"{HOST}:{port}" for port in ports))
    alone = SERVICES.replace("- name: board", f"- name: board\n    domain_id: {domain}")
    besides = alone.replace(
        "/OWN/add, type: example_interfaces/srv/AddTwoInts, peer: only",
        "/OWN/add, type: example_interfaces/srv/AddTwoInts, peer: also, queue: 5",
    )
    besides = besides.replace("[+services]", "[+services, +graph]")
    besides = besides.replace(
        "heartbeat: 10 ms", "heartbeat: 10 ms, connect_timeout: 20 s, create_timeout: 20 s"
    )
    besides += f'transport: {{type: udp, agent: "{HOST}:{agent}"}}\n'
    return (
        service_board_program(folder, "a", ends, besides, alone, ("-DHAS_GRAPH",)),
        service_board_program(folder, "b", ends, alone, besides),
    )


def is_available(board: ServiceBoard) -> bool:
    assert not board.tell("available")
    return board.words[-1] == "available 1"


def test_a_service_for_ros_and_for_another_board(observer: Observer, domain: int, tmp_path: Path) -> None:
    [port] = free_ports(1)
    program_a, program_b = programs(tmp_path, port, domain)
    transport = ("udp4", "--port", str(port))
    with running_agent(domain, "--domain", str(domain), transport=transport), service_board(program_a) as a:
        assert not is_available(a)
        with service_board(program_b) as b:
            until(lambda: is_available(a), a, b)
            until(lambda: not b.tell("ask 0 1"), a, b)
            observer.ask(do="ask_sums", service="/a/add", pairs=[[100 + i, 1] for i in range(CALLS)])
            requested = 1

            def both() -> bool:
                nonlocal requested
                if len(b.replies) == requested and requested < CALLS:
                    assert not b.tell(f"ask {requested} 1")
                    requested += 1
                sums = observer.ask(do="sums")
                return len(b.replies) == CALLS and len(sums) == CALLS and None not in sums

            until(both, a, b)
            assert sorted(observer.ask(do="sums")) == [101 + i for i in range(CALLS)]
            assert b.replies == [(i + 1, i + 1) for i in range(CALLS)]
            assert sorted(a.served) == [(i, 1) for i in range(CALLS)] + [(100 + i, 1) for i in range(CALLS)]
            assert not a.tell("ask 7 8")
            until(lambda: a.replies == [(1, 15)], a, b)
