# SPDX-License-Identifier: Apache-2.0
"""A device that sleeps, with rclpy: each time awake is a process, and a file is all that the next one has of it."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.images import C_FILES, Images, run
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+subscribe, +sleep_cycles]
nodes:
  - name: sleeper
    publishers: [{topic: sleep_out, type: std_msgs/msg/Int32, qos: {depth: 1000}}]
    subscriptions: [{topic: sleep_in, type: std_msgs/msg/Int32, queue: 8, qos: {depth: 1000}}]
pools: {history: 16}
"""
CYCLES, EACH = 6, 10
CREATE_CLIENT, CREATE, GET_INFO, DELETE = range(4)


@pytest.mark.system
def test_samples_go_on_over_sleeps(
    images: Images, relay: Relay, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """In order in both directions, in one session in which everything was created once."""
    image = images.build(relay.port, APPLICATION)
    program = image.application(C_FILES / "sleep.c", tmp_path / "sleep", "-std=c99", "-Wall", "-Werror")
    memory = tmp_path / "memory"
    observer.subscribe("/sleep_out", "std_msgs/msg/Int32")
    observer.ask(do="publish", topic="/sleep_in", type="std_msgs/msg/Int32", values=[])
    with running_agent(domain, "--domain", str(domain)) as agent:
        relay.connect(agent.port)
        first = run([str(program), str(memory), "0", "0", "0"])
        assert (first.returncode, first.stdout.split()) == (0, ["cold", "ready"]), first.stderr
        end = deadline(20)
        while not observer.ask(do="matched", topic="/sleep_in"):
            assert time.monotonic() < end
            time.sleep(0.05)
        time.sleep(1.0)  # and the other way
        observer.ask(do="samples")
        relay.sent.clear()
        taken: list[int] = []
        for cycle in range(CYCLES):
            numbers = range(cycle * EACH, (cycle + 1) * EACH)
            values = [{"data": value} for value in numbers]
            observer.ask(do="publish", topic="/sleep_in", type="std_msgs/msg/Int32", values=values)
            awake = run([str(program), str(memory), str(numbers[0]), str(EACH), str(EACH)])
            assert awake.returncode == 0, awake.stderr
            assert awake.stdout.split()[0] == "woken"
            taken += [int(value) for value in awake.stdout.split()[2:]]
        arrived = [value["data"] for _, value in observer.got(CYCLES * EACH)]
    assert taken == arrived == list(range(CYCLES * EACH))
    assert not relay.sent.keys() & {CREATE_CLIENT, CREATE, DELETE}
    assert relay.sent[GET_INFO] >= CYCLES, "with each wake-up the agent is asked whether it has the session"
