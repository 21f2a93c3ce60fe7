# SPDX-License-Identifier: Apache-2.0
"""A board with two agents and rclpy: datagrams are lost, one agent is killed, and the clock wraps."""

from __future__ import annotations

import signal
import time
from collections import Counter
from contextlib import ExitStack

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.firmware.board import Board, Builds, board, need
from tests.support.firmware.running import BOARD
from tests.support.firmware.uart_network import UartNetwork
from tests.support.free_ports import free_ports
from tests.support.patience import deadline, seconds

NAMED = (8801, 8802)
SLOTS, DDS_HISTORY = 4, 100
"""The window of the reliable stream, and the depth of the publisher of c/agents.c."""
APPLICATION = f"""\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {{type: udp, agents: ["127.0.0.1:{NAMED[0]}", "127.0.0.1:{NAMED[1]}"]}}
session:
  {{round_trip: 50 ms, liveliness_period: 300 ms, liveliness_timeout: 1500 ms, retry_max: 500 ms,
    connect_timeout: 4 s, create_timeout: 20 s}}
pools: {{history: {SLOTS}}}
nodes:
  - name: device
    publishers:
      - {{topic: agents_up, type: std_msgs/msg/Int32, qos: {{durability: transient_local, depth: {DDS_HISTORY}}}}}
    subscriptions:
      - {{topic: agents_down, type: std_msgs/msg/Int32, qos: {{reliability: reliable}}}}
"""
ACCEPTED, TAKEN, AGENT, CHANGES, WRAPPED, REPORTS = range(6)
LAST = 77


class Numbers:
    """What the board has published, and what of it has arrived."""

    def __init__(self, running: Board, observer: Observer) -> None:
        self._running, self._observer = running, observer
        self.received: Counter[int] = Counter()

    def report(self, what: int) -> int:
        return self._running.words("agents_report", REPORTS)[what]

    def wait_for(self, more: int) -> None:
        """Wait until the board has published `more` numbers, and until the last one of them has arrived."""
        wanted = self.report(ACCEPTED) + more
        end = deadline(30)
        while not any(number >= wanted for number in self.received):
            assert time.monotonic() < end, (wanted, self._running.words("agents_report", REPORTS))
            found = self._observer.ask(do="samples")
            self.received.update(value["data"] for topic, value in found if topic == "/agents_up")
            time.sleep(0.02)

    def differences(self) -> tuple[list[int], list[int]]:
        """Print and return what was lost, of the numbers since the first one that was received, and what came twice."""
        lost = sorted(set(range(min(self.received), max(self.received))) - set(self.received))
        doubled = sorted(number for number, times in self.received.items() if times > 1)
        print(f"{len(self.received)} received, lost {lost}, doubled {doubled}")
        return lost, doubled


def agent_at(stack: ExitStack, domain: int, port: int) -> AgentProcess:
    options = ("--domain", str(domain))
    return stack.enter_context(running_agent(domain, *options, transport=("udp4", "--port", str(port))))


@pytest.mark.variant  # of tests/e2e/test_agent_list.py and test_agent_change.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_a_board_goes_on_with_the_other_agent(builds: Builds, observer: Observer, domain: int) -> None:
    """What was not acknowledged is sent to the next agent; loss alone costs and doubles nothing."""
    need(BOARD, emulator=True)
    built = builds.build(BOARD, APPLICATION)
    image = builds.application(built, "agents.c")
    ports = free_ports(2)
    observer.subscribe("/agents_up", "std_msgs/msg/Int32", transient_local=True)
    with ExitStack() as stack:
        agents = [agent_at(stack, domain, port) for port in ports]
        running = stack.enter_context(board(built, image))
        network = UartNetwork(running.device, dict(zip(NAMED, ports, strict=True)), loss=0.05)
        stack.enter_context(network)
        numbers = Numbers(running, observer)
        running.go_on()
        numbers.wait_for(30)
        at = numbers.report(AGENT)  # the second one, if the first is still starting
        assert numbers.report(CHANGES) == 0
        assert numbers.differences() == ([], [])
        agents[at].process.send_signal(signal.SIGKILL)
        agents[at].process.wait(timeout=seconds(15))
        running.wait_for(lambda: numbers.report(CHANGES) == 1)
        numbers.wait_for(30)
        assert numbers.report(AGENT) == 1 - at
        lost, doubled = numbers.differences()
        assert len(lost) <= SLOTS + DDS_HISTORY
        assert len(doubled) <= SLOTS
        observer.ask(do="publish", topic="/agents_down", type="std_msgs/msg/Int32", values=[])
        end = deadline(15)
        while not observer.ask(do="matched", topic="/agents_down"):
            assert time.monotonic() < end, "no subscription"
            time.sleep(0.05)
        values = [{"data": LAST}]
        observer.ask(do="publish", topic="/agents_down", type="std_msgs/msg/Int32", values=values)
        running.wait_for(lambda: numbers.report(TAKEN) == LAST)
        running.wait_for(lambda: numbers.report(WRAPPED))
        numbers.wait_for(30)
        assert numbers.differences() == (lost, doubled), "the wrap of the clock loses and doubles nothing"
        assert network.lost
