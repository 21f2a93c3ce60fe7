# SPDX-License-Identifier: Apache-2.0
"""A client changes its agent, counted by rclpy: what is lost or doubled, and that everything goes on after it."""

from __future__ import annotations

import signal
import socket
import time
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.agent_list import agent_of, listed, listed_lines, wait_for_agent
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.live import Live
from tests.support.e2e.parameter_calls import DEVICE
from tests.support.e2e.parameter_peer import parameter_peer
from tests.support.e2e.serving import await_line
from tests.support.free_ports import free_ports
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

SLOTS = 4
"""Messages of the reliable stream: the default of pure_sender."""
DDS_HISTORY = 100
"""Depth of the publisher `latched` in live.c."""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")

PATIENT = (
    "round_trip: 50 ms, liveliness_period: 300 ms, liveliness_timeout: 1500 ms, retry_max: 500 ms,"
    " connect_timeout: 20 s, create_timeout: 20 s"
)
"""An agent is another process, which may stand still for a second while the machine is busy."""


class Counted:
    """What a client published on a topic, and what rclpy received of it."""

    def __init__(self, live: Live, observer: Observer, topic: str) -> None:
        self.live, self.observer, self.topic = live, observer, topic
        self.next = 0
        self.accepted: list[int] = []
        self.received: Counter[int] = Counter()

    def publish(self, count: int, period_ms: int = 5) -> None:
        """Publish numbers; begin with `begin` and `end` where something happens meanwhile."""
        self.begin(count, period_ms)
        self.end()

    def begin(self, count: int, period_ms: int = 5) -> None:
        self.live.begin(f"burst 0 {self.next} {count} {period_ms}")
        self.next += count

    def end(self) -> None:
        samples = self.live.samples()
        assert {sample.code for sample in samples} <= {0, 1}
        self.accepted += [sample.value for sample in samples if sample.code == 0]

    def publish_until_taken(self) -> int:
        """Publish one more number, again while the stream is full; return it."""
        end = deadline(20)
        while self.live.call(f"publish 0 {self.next}").code != 0:
            assert time.monotonic() < end, f"the stream stays full: {self.live.statistics()}"
        self.accepted.append(self.next)
        self.next += 1
        return self.accepted[-1]

    def take(self, timeout_s: float = 20.0) -> None:
        """Take samples until the last one that was accepted was received, and for a moment more."""
        end = deadline(timeout_s)
        while self.received[self.accepted[-1]] == 0:
            assert time.monotonic() < end, f"{self.accepted[-1]} is not received"
            self._take()
        time.sleep(0.3)
        self._take()

    def _take(self) -> None:
        taken = [value["data"] for name, value in self.observer.ask(do="samples") if name == self.topic]
        self.received.update(taken)
        time.sleep(0.02)

    def differences(self) -> tuple[list[int], list[int]]:
        """Print and return the numbers that are lost, and those that came twice."""
        assert set(self.received) <= set(self.accepted) | {-1}
        lost = [value for value in self.accepted if self.received[value] == 0]
        doubled = [value for value in self.accepted if self.received[value] > 1]
        print(f"{self.topic}: {len(self.accepted)} published, lost {lost}, doubled {doubled}")
        return lost, doubled


def agent_at(stack: ExitStack, domain: int, port: int, kind: str = "udp4") -> AgentProcess:
    options = ("--domain", str(domain))
    return stack.enter_context(running_agent(domain, *options, transport=(kind, "--port", str(port))))


def agent_of_line(stack: ExitStack, domain: int, device: Path) -> AgentProcess:
    options = ("--domain", str(domain))
    return stack.enter_context(running_agent(domain, *options, transport=("pty", "--link", str(device))))


def ended(agent: AgentProcess, number: signal.Signals) -> None:
    agent.process.send_signal(number)
    agent.process.wait(timeout=seconds(15))


def change_twice(live: Live, counted: Counted, start: Callable[[int], AgentProcess]) -> None:
    """Kill the first agent, stop the second one in order after the first was started again.

    At most what one window holds and DDS has not delivered is lost or doubled after a kill, nothing after a stop.
    """
    first, second = start(0), start(1)
    for command in ("open 0x77 -", "node 0 talker -", f"publisher 0 0 Int32 {counted.topic} latched"):
        live.ok(command)
    assert agent_of(live)[1] == 0
    counted.publish(20)
    counted.take()
    counted.begin(200)
    time.sleep(0.5)
    ended(first, signal.SIGKILL)
    counted.end()
    unacknowledged = counted.accepted[-SLOTS:]
    assert live.call("publish 0 0").code == 1, "the stream is full: these are all in it"
    wait_for_agent(live, 1)
    counted.publish(20)
    counted.publish_until_taken()
    counted.take()
    lost, doubled = counted.differences()
    assert not set(lost) & set(unacknowledged)
    assert len(lost) <= SLOTS + DDS_HISTORY
    assert len(doubled) <= SLOTS
    start(0)
    before = len(counted.accepted)
    counted.begin(150)  # after the stop fewer than DDS_HISTORY: the reader may discover the writer late
    time.sleep(0.5)
    ended(second, signal.SIGTERM)
    counted.end()
    wait_for_agent(live, 0)
    counted.publish(20)
    counted.publish_until_taken()
    counted.take()
    assert counted.differences() == (lost, doubled), "a stop loses and doubles nothing"
    assert len(counted.accepted) > before + SLOTS
    assert agent_of(live)[1:] == (0, 2)
    live.ok("close")


def test_killed_and_stopped_agents(images: Images, observer: Observer, domain: int) -> None:
    ports = free_ports(2)
    topic = "/agents_counted"
    observer.subscribe(topic, "std_msgs/msg/Int32", transient_local=True)
    with ExitStack() as stack:
        live = stack.enter_context(Live(images.live(images.build(0, listed(ports, PATIENT)))))
        counted = Counted(live, observer, topic)
        change_twice(live, counted, lambda index: agent_at(stack, domain, ports[index]))


@pytest.mark.variant
def test_killed_and_stopped_agents_of_serial_lines(
    images: Images, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """The line of an agent that is killed vanishes with it, and comes back with another name behind its link."""
    devices = [tmp_path / "left", tmp_path / "right"]
    topic = "/agents_of_lines"
    observer.subscribe(topic, "std_msgs/msg/Int32", transient_local=True)
    with ExitStack() as stack:
        live = stack.enter_context(Live(images.live(images.build(0, listed_lines(devices, PATIENT)))))
        counted = Counted(live, observer, topic)
        change_twice(live, counted, lambda index: agent_of_line(stack, domain, devices[index]))


def test_the_first_line_is_missing(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    """A client starts with the second device; when that vanishes, with the first one as soon as there is one."""
    devices = [tmp_path / "left", tmp_path / "right"]
    topic = "/agents_of_a_line"
    observer.subscribe(topic, "std_msgs/msg/Int32", transient_local=True)
    with ExitStack() as stack:
        second = agent_of_line(stack, domain, devices[1])
        live = stack.enter_context(Live(images.live(images.build(0, listed_lines(devices, PATIENT)))))
        counted = Counted(live, observer, topic)
        for command in ("open 0x79 -", "node 0 talker -", f"publisher 0 0 Int32 {topic} latched"):
            live.ok(command)
        assert agent_of(live) == (0, 1, 0)
        counted.publish(20)
        live.ok("flush 5000")
        counted.take()
        ended(second, signal.SIGKILL)
        assert not devices[1].exists()
        devices[1].unlink()  # what it points to may be the line of the next agent
        agent_of_line(stack, domain, devices[0])
        wait_for_agent(live, 0)
        counted.publish_until_taken()
        counted.take()
        assert counted.differences() == ([], [])
        assert agent_of(live) == (0, 0, 1)
        live.ok("close")


@pytest.mark.variant
def test_both_are_away_and_one_returns_over_ipv6(images: Images, observer: Observer, domain: int) -> None:
    ports = free_ports(2, socket.AF_INET6, socket.SOCK_STREAM)
    topic = "/agents_ipv6"
    application = listed(ports, PATIENT, kind="tcp", host="[::1]")
    observer.subscribe(topic, "std_msgs/msg/Int32", transient_local=True)
    with ExitStack() as stack:
        second = agent_at(stack, domain, ports[1], "tcp6")
        live = stack.enter_context(Live(images.live(images.build(0, application))))
        counted = Counted(live, observer, topic)
        for command in ("open 0x78 -", "node 0 talker -", f"publisher 0 0 Int32 {topic} latched"):
            live.ok(command)
        assert agent_of(live) == (ports[1], 1, 0)
        counted.publish(20)
        live.ok("flush 5000")
        counted.take()
        before = len(counted.accepted)
        ended(second, signal.SIGKILL)
        answer = live.call("publish 0 0")
        assert (answer.code, len(counted.accepted)) == (1, before), "without a session nothing is accepted"
        agent_at(stack, domain, ports[0], "tcp6")
        wait_for_agent(live, 0)
        counted.publish_until_taken()
        counted.take()
        assert counted.differences() == ([], [])
        assert agent_of(live) == (ports[0], 0, 1)
        live.ok("close")


PARAMETERS = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes: [{name: device, namespace: /arm}]
"""


@pytest.mark.system
def test_parameters_go_on(images: Images, domain: int, tmp_path: Path) -> None:
    """The services of a node are there again at the next agent, with what was set before."""
    ports = free_ports(2)
    image = images.build(0, listed(ports, PATIENT, PARAMETERS))
    program = image.application(C_FILES / "parameters.c", tmp_path / "parameters", *STRICT)
    with ExitStack() as stack:
        first = agent_at(stack, domain, ports[0])
        agent_at(stack, domain, ports[1])
        peer = stack.enter_context(parameter_peer(domain))
        process = stack.enter_context(started(program))
        await_line(process, "ready")
        peer.wait(DEVICE)
        assert peer.call(DEVICE, "set_parameters", [("motor.steps", 30)])["results"][0]["successful"]
        ended(first, signal.SIGTERM)
        peer.wait(DEVICE)
        assert peer.call(DEVICE, "get_parameters", ["motor.steps"])["values"] == [[2, 30]]
        peer.call(DEVICE, "set_parameters", [("motor.steps", 120)])
        ends_well(process)


ASKER = """\
version: 1
profiles: [pure_sender]
components: [-publish, +services, +executor]
nodes:
  - name: asker
    clients:
      - {name: /peer/lengths, type: rcl_interfaces/srv/GetParameterTypes}
limits: {"*": {string: 8, sequence: 4}}
"""


@pytest.mark.system
def test_a_pending_request_has_its_result(
    images: Images, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """An acknowledged request whose reply can no longer come is reported by the next take."""
    ports = free_ports(2)
    image = images.build(0, listed(ports, PATIENT, ASKER))
    program = image.application(C_FILES / "ask.c", tmp_path / "ask", *STRICT)
    observer.ask(do="serve", service="/peer/lengths", type="rcl_interfaces/srv/GetParameterTypes", hold=9)
    with ExitStack() as stack:
        first = agent_at(stack, domain, ports[0])
        agent_at(stack, domain, ports[1])
        process = stack.enter_context(started(program, "2"))
        await_line(process, "ready")
        time.sleep(1)  # services are not among the topics of the graph: discovery has had a second
        assert process.stdin is not None
        process.stdin.write("\n")
        process.stdin.flush()
        time.sleep(0.5)
        ended(first, signal.SIGTERM)
        _, errors = process.communicate(timeout=seconds(20))
    observer.ask(do="stop_serving")
    assert process.returncode == 1
    assert errors == "spin: service /peer/lengths: a session was lost with 2 requests under way\n"
