# SPDX-License-Identifier: Apache-2.0
"""The POSIX port: real sockets and clocks, with a fake agent in a thread."""

from __future__ import annotations

import socket
import subprocess
from pathlib import Path

import pytest

from tests.support.patience import seconds
from tests.support.plans import INT32, POOL, changed
from tests.support.runtime.harness import build, components, render
from tests.support.runtime.udp import UdpAgent

PLAN = changed(POOL, times__create_timeout_ms=20_000, times__liveliness_period_ms=50)


def _program(tmp_path: Path, port: int, connect_timeout_ms: int = 20_000) -> Path:
    plan = changed(PLAN, transport__agent_port=port, times__connect_timeout_ms=connect_timeout_ms)
    tree = render(tmp_path, plan, components(plan))
    return build(tree, ["types.c", "udp.c"], "udp")


@pytest.mark.parametrize("restarts", [False, True])
def test_publishes_over_a_real_socket(restarts: bool, tmp_path: Path) -> None:
    agent = UdpAgent()
    if restarts:
        agent.before = lambda count: agent.agent.restart() if count == 12 else None
    agent.start()
    done = subprocess.run(
        [_program(tmp_path, agent.port)], capture_output=True, text=True, timeout=seconds(60), check=False
    )
    agent.stop()
    assert done.returncode == 0, done.stdout + done.stderr
    values = agent.agent.values()
    assert values[-1] == 99
    assert values == sorted(set(values))
    assert len(values) == 100 if not restarts else len(values) > 10
    assert not agent.agent.connected, "it took its leave"
    assert INT32.name.encode() in b"".join(agent.agent.log)


def test_no_listener(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
    done = subprocess.run(
        [_program(tmp_path, port, 200)], capture_output=True, text=True, timeout=seconds(60), check=False
    )
    assert done.returncode == 2
    assert done.stdout == f"no agent answers at 127.0.0.1:{port} within 200 ms\n"


def test_two_programs_on_one_machine_have_two_keys(tmp_path: Path) -> None:
    """Each draws its own when it starts, and keeps it: none is 0."""
    agent = UdpAgent()
    agent.start()
    plan = changed(
        PLAN, transport__agent_port=agent.port, times__connect_timeout_ms=20_000, session__client_key=None
    )
    program = build(render(tmp_path, plan, components(plan)), ["types.c", "udp.c"], "udp")
    keys = []
    for _ in range(3):
        agent.agent.log.clear()
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        keys.append({datagram[16:20] for datagram in agent.agent.log if datagram[4] == 0})
    agent.stop()
    assert [len(found) for found in keys] == [1, 1, 1]
    assert len(set.union(*keys)) == 3
    assert bytes(4) not in set.union(*keys)
