# SPDX-License-Identifier: Apache-2.0
"""A rolling restart: each of two agents is stopped in order and started again while samples flow in both directions.

rclpy counts what a device publishes, and the device what rclpy publishes; both are `transient_local`.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.observer import observing
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.agent_list import listed
from tests.support.e2e.flow import APPLICATION, INT32, TIMES, UP, Flow, lost_and_doubled
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.free_ports import free_ports
from tests.support.slices import first

pytestmark = [pytest.mark.ros, pytest.mark.system]


def restart_in_turn(
    flow: Flow, agents: Sequence[AgentProcess], start: Callable[[int], AgentProcess]
) -> list[AgentProcess]:
    """Stop each agent while samples flow, and start it again; the device is with the first one before."""
    restarted = []
    for index, agent in enumerate(agents):
        flow.go_on_for(20)
        agent.process.send_signal(signal.SIGTERM)
        flow.go_on(lambda agent=agent: agent.process.poll() is not None)  # type: ignore[misc]
        assert agent.process.returncode == 0
        flow.go_on_for(20)
        restarted.append(start(index))
    return restarted


@pytest.mark.parametrize("workers", first([2, 1]))
def test_a_rolling_restart_loses_nothing(images: Images, domain: int, tmp_path: Path, workers: int) -> None:
    ports = free_ports(2)
    image = images.build(0, listed(ports, TIMES, APPLICATION))
    program = image.application(
        C_FILES / "rolling.c", tmp_path / "rolling", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    with ExitStack() as stack:
        observer = stack.enter_context(
            observing(domain)
        )  # of an older one the device would get what it sent before
        observer.subscribe(UP, INT32, transient_local=True)

        def start(index: int) -> AgentProcess:
            options = ("--domain", str(domain), "--workers", str(workers))
            return stack.enter_context(
                running_agent(domain, *options, transport=("udp4", "--port", str(ports[index])))
            )

        agents = [start(0), start(1)]
        flow = Flow(observer, stack.enter_context(started(program)))
        restarted = restart_in_turn(flow, agents, start)
        flow.go_on_for(20)
        flow.finish()
        assert flow.published is not None
        up = lost_and_doubled("device to rclpy", flow.published, flow.up)
        del flow.down[-1]
        down = lost_and_doubled("rclpy to device", flow.sent, flow.down)
        assert up == ([], []), "a stop loses and doubles nothing that a device publishes"
        assert down[0] == [], "each sample of a transient_local topic reaches the device"
        for agent in restarted:
            assert agent.process.poll() is None
