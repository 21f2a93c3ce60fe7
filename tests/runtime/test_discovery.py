# SPDX-License-Identifier: Apache-2.0
"""Search for an agent by multicast over real sockets: agents found, tried, abandoned, and found again after a loss."""

from __future__ import annotations

import random
import socket
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.client.plan.slices import DISCOVERY_GROUP
from tests.support.patience import seconds
from tests.support.plans import POOL, changed
from tests.support.runtime.discovery import info, locator
from tests.support.runtime.harness import build, components, render
from tests.support.runtime.ports import bind, stop
from tests.support.runtime.tcp import TcpAgent, serving
from tests.support.runtime.udp import UdpAgent

PLAN = changed(
    POOL,
    transport__agent_host=DISCOVERY_GROUP,
    transport__has_discovery=True,
    times__connect_timeout_ms=20_000,
    times__create_timeout_ms=20_000,
    times__liveliness_period_ms=50,
)
QUESTION = bytes.fromhex("80000000 02010800 0009fffd 03000000")
Answers = Callable[[], list[bytes]]


class Group(threading.Thread):
    """Answers in the group, at its own port, over the loopback interface alone."""

    def __init__(self, answers: Answers) -> None:
        super().__init__(daemon=True)
        self.questions: list[bytes] = []
        self._answers = answers
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.port = bind(self.socket, DISCOVERY_GROUP)
        member = socket.inet_aton(DISCOVERY_GROUP) + socket.inet_aton("127.0.0.1")
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        self.socket.settimeout(seconds(20.0))

    def run(self) -> None:
        while True:
            try:
                question, asker = self.socket.recvfrom(2048)
            except OSError:
                return
            if not question:
                return
            self.questions.append(question)
            for answer in self._answers():
                self.socket.sendto(answer, asker)


@contextmanager
def answering(answers: Answers) -> Iterator[Group]:
    group = Group(answers)
    group.start()
    try:
        yield group
    finally:
        stop(group.socket)


def run(group: Group, folder: Path, **changes: object) -> subprocess.CompletedProcess[str]:
    plan = changed(PLAN, transport__agent_port=group.port, transport__discovery_port=group.port, **changes)
    program = build(render(folder, plan, components(plan)), ["types.c", "udp.c"], "udp")
    return subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)


def udp_agent() -> UdpAgent:
    agent = UdpAgent()
    agent.start()
    return agent


def silent_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
    return port


def test_an_agent_is_found_and_served(tmp_path: Path) -> None:
    agent = udp_agent()
    with answering(lambda: [info(locator("127.0.0.1", agent.port))]) as group:
        done = run(group, tmp_path)
    agent.stop()
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))
    assert set(group.questions) == {QUESTION}
    assert len(group.questions) <= 2, "nobody is asked while there is a session"


def test_tcp(tmp_path: Path) -> None:
    with serving(TcpAgent()) as agent, answering(lambda: [info(locator("127.0.0.1", agent.port))]) as group:
        done = run(group, tmp_path, transport__kind="tcp")
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))


def test_a_locator_without_an_answer_is_abandoned(tmp_path: Path) -> None:
    agent = udp_agent()
    places = [locator("127.0.0.1", silent_port()), locator("127.0.0.1", agent.port)]
    with answering(lambda: [info(*places)]) as group:
        done = run(group, tmp_path)
    agent.stop()
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))


def test_another_agent_is_found_after_a_loss(tmp_path: Path) -> None:
    agents = [udp_agent(), udp_agent()]
    living = [agents[0]]

    def stop_the_first(count: int) -> None:
        if count == 30:
            living[0] = agents[1]
            agents[0].agent.silent = True

    agents[0].before = stop_the_first
    with answering(lambda: [info(locator("127.0.0.1", living[0].port))]) as group:
        done = run(group, tmp_path, streams__on_full="block", streams__on_full_block_ms=500)
    for agent in agents:
        agent.stop()
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agents[1].agent.values()[-1] == 99
    assert sorted({*agents[0].agent.values(), *agents[1].agent.values()}) == list(range(100))


@pytest.mark.parametrize("kind", ["cut", "noise", "none"])
def test_answers_that_are_none(kind: str, tmp_path: Path) -> None:
    """Bytes of every kind, before the right answer comes; under sanitizers."""
    agent = udp_agent()
    dice = random.Random(7)
    good = info(locator("127.0.0.1", agent.port))
    rounds = [0]

    def answers() -> list[bytes]:
        rounds[0] += 1
        if kind == "cut":
            spoiled = [good[: dice.randrange(1, len(good) - 7)] for _ in range(6)]
        elif kind == "noise":
            spoiled = [good[:14] + dice.randbytes(dice.randrange(1, 100)) for _ in range(6)]
            # A place in the noise costs a try; the port 0 is none.
            spoiled = [answer[:15] + b"\0" + answer[16:] for answer in spoiled if len(answer) > 16]
        else:
            spoiled = [info(), info(locator("127.0.0.1", 0)), b"\x06"]
        return [*spoiled[:6], good] if rounds[0] > 1 else spoiled

    with answering(answers) as group:
        done = run(group, tmp_path, times__connect_timeout_ms=30_000)
    agent.stop()
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))


def test_no_agent(tmp_path: Path) -> None:
    with answering(list) as group:
        done = run(group, tmp_path, times__connect_timeout_ms=400)
    assert done.returncode == 2
    assert done.stdout == f"no transport to {DISCOVERY_GROUP}:{group.port}\n"
    assert len(set(group.questions)) == 1
    assert 2 <= len(group.questions) <= 10, "at 0, 40, 80, 160 and 320 ms, over one or two interfaces"
