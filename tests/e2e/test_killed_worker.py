# SPDX-License-Identifier: Apache-2.0
"""A worker process of the agent is killed while a device publishes and takes: the device finds out and goes on."""

from __future__ import annotations

import os
import signal
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.client import XrceClient
from tests.support.agent.observer import observing
from tests.support.agent.worker_agents import clients, running
from tests.support.e2e.flow import APPLICATION, INT32, TIMES, UP, Flow
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.free_ports import free_ports

pytestmark = [pytest.mark.ros, pytest.mark.system]
KILLS = 2


def test_a_device_goes_on_after_its_worker_is_killed(images: Images, domain: int, tmp_path: Path) -> None:
    """It opens its session again at the process that took the place; the client of the other worker notices nothing."""
    (port,) = free_ports(1)
    image = images.build(
        0, f'{APPLICATION}transport: {{type: udp, agent: "127.0.0.1:{port}"}}\nsession: {{{TIMES}}}\n'
    )
    program = image.application(
        C_FILES / "rolling.c", tmp_path / "rolling", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    with ExitStack() as stack:
        observer = stack.enter_context(
            observing(domain)
        )  # of an older one the device would get what it sent before
        observer.subscribe(UP, INT32, transient_local=True)
        agent = stack.enter_context(running("--domain", str(domain), port=port))
        flow = Flow(observer, stack.enter_context(started(program)))
        flow.go_on_for(20)
        (device,) = clients(agent.status()).values()
        other = stack.enter_context(XrceClient(port, key=0x10 + 2 - device["worker"]))
        assert other.connect() == 0
        other.publisher("beside", "beside", INT32, domain)
        neighbor = agent.client(other.key.hex().upper(), state="connected")
        assert neighbor["worker"] != device["worker"]
        for count in range(1, KILLS + 1):
            os.kill(agent.pid(device["worker"]), signal.SIGKILL)
            flow.go_on_for(20)
            known = clients(agent.status())
            assert known[device["key"]]["state"] == "connected"
            assert known[neighbor["key"]]["sessions"] == 1
            assert agent.status()["agent"]["workers"][device["worker"] - 1]["restarts"] == count
            assert other.ping() == 1
        flow.finish()
        assert flow.published is not None
        print(
            f"{flow.published} published, {sum(flow.up[value] == 0 for value in range(flow.published))} lost"
        )
        assert set(flow.up) <= set(range(flow.published))
