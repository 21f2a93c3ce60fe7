# SPDX-License-Identifier: Apache-2.0
"""Which of several parameter servers serves: the rules with a made clock, and processes that start at the same time."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import cast

import pytest

from microros_gen.parameter_server.claims import AGENT, LIFE_S, REPEAT_S, STANDALONE, Candidate, Claims
from microros_gen.parameter_server.served import HELD
from microros_gen.parameter_server.values import DOUBLE, ParameterValue
from microros_gen.ros.errors import RosError
from microros_gen.ros.peer import Peer
from tests.support.parameter_server.asking import Asking, alive
from tests.support.parameter_server.board import Board
from tests.support.patience import seconds
from tests.support.ros.running import Running, running
from tests.support.slices import first

READY = "parameter server ready: /microros_parameters"


class Clock:
    """Seconds in the hands of a test."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def message(claims: Claims) -> dict[str, object]:
    own = claims.own
    return {"server": own.server, "rank": own.rank, "serving": own.serving}


def test_of_two_that_wait_the_lower_one_begins() -> None:
    clock = Clock()
    first, second = Claims(AGENT, clock, 1), Claims(AGENT, clock, 2)
    first.hear(message(second))
    second.hear(message(first))
    second.hear(message(second))
    assert first.leader() is None
    assert second.leader() == first.own


def test_one_that_serves_goes_on_unless_a_lower_one_serves_too() -> None:
    clock = Clock()
    first, second = Claims(AGENT, clock, 1), Claims(AGENT, clock, 2)
    second.set_serving(True)
    first.hear(message(second))
    second.hear(message(first))
    assert first.leader() == second.own
    assert second.leader() is None
    first.set_serving(True)
    first.hear(message(second))
    second.hear(message(first))
    assert first.leader() is None
    assert second.leader() == first.own


def test_a_separate_server_takes_over_from_an_agent() -> None:
    clock = Clock()
    own, agent = Claims(STANDALONE, clock, 2), Claims(AGENT, clock, 1)
    agent.set_serving(True)
    own.hear(message(agent))
    agent.hear(message(own))
    assert own.leader() == agent.own, "it waits until the agent has ended"
    assert agent.leader() == own.own
    agent.set_serving(False)
    own.hear(message(agent))
    assert own.leader() is None


def test_a_claim_ends_when_nothing_is_heard_of_it() -> None:
    clock = Clock()
    first, second = Claims(AGENT, clock, 1), Claims(AGENT, clock, 2)
    first.set_serving(True)
    second.hear(message(first))
    clock.now = LIFE_S
    assert second.leader() == first.own
    clock.now = LIFE_S + 0.1
    assert second.leader() is None
    assert second.others() == []


class Damaged:
    """A peer that gets a message which cannot be read."""

    def __init__(self) -> None:
        self.published: list[dict[str, object]] = []

    def publisher(self, *_: object) -> Damaged:
        return self

    def subscribe(self, *_: object) -> None:
        pass

    def publish(self, message: dict[str, object]) -> None:
        self.published.append(message)

    def spin_once(self, _: float) -> bool:
        raise RosError("a message that cannot be read")


def test_a_damaged_claim_ends_nothing() -> None:
    clock, peer, reported = Clock(), Damaged(), list[str]()
    candidate = Candidate(cast("Peer", peer), Claims(AGENT, clock, 1), clock, reported.append)
    for _ in range(4):
        candidate.turn()
        clock.now += REPEAT_S / 2
    candidate.set_serving(True)
    assert reported == ["a message that cannot be read"] * 5
    assert [message["serving"] for message in peer.published] == [False, False, True]


@pytest.mark.parametrize("seed", range(40))
def test_one_serves_in_the_end_whatever_is_lost(seed: int) -> None:
    """Messages are late and lost for a while; then one serves, and another one when that is killed."""
    dice, clock = random.Random(seed), Clock()
    servers = [Claims(dice.choice((STANDALONE, AGENT)), clock) for _ in range(dice.randrange(2, 5))]
    late: list[tuple[float, Claims, dict[str, object]]] = []

    def second(loss: float) -> None:
        for server in servers:
            if server.own.serving:
                server.set_serving(server.leader() is None)
            elif server.leader() is None and dice.random() < 0.8:  # it has waited long enough, or not yet
                server.set_serving(True)
        for server in servers:
            others = [other for other in servers if other is not server and dice.random() >= loss]
            late.extend((clock.now + dice.random() * REPEAT_S, other, message(server)) for other in others)
        clock.now += REPEAT_S
        due = sorted((entry for entry in late if entry[0] <= clock.now), key=lambda entry: entry[0])
        late[:] = [entry for entry in late if entry[0] > clock.now]
        for _, receiver, content in due:
            receiver.hear(content)

    for _ in range(20):
        second(loss=0.7)
    for _ in range(20):
        second(loss=0.0)
    (serving,) = [server for server in servers if server.own.serving]
    ranks = {server.own.rank for server in servers}
    assert serving.own.rank == min(ranks)
    servers.remove(serving)
    for _ in range(20):
        second(loss=0.0)
    assert sum(server.own.serving for server in servers) == 1


def wait(condition: Callable[[], bool], limit_s: float, servers: list[Running]) -> None:
    end = time.monotonic() + seconds(limit_s)
    while not condition():
        assert time.monotonic() < end, [server.lines for server in servers]
        time.sleep(0.1)


@pytest.mark.ros
@pytest.mark.parametrize("module", first(["microros_gen", "tests.support.parameter_server.of_agent"]))
def test_two_that_start_at_the_same_time(module: str, domain: int, tmp_path: Path) -> None:
    """One of them serves a node; when it is killed, the other one does, and the board keeps its value."""
    board = Board(time.monotonic)
    with ExitStack() as stack:
        servers = []
        for name in ("a", "b"):
            file = str(tmp_path / f"{name}.json")
            arguments = ["parameter-server", "--file", file] if module == "microros_gen" else [file]
            servers.append(stack.enter_context(running(domain, module, *arguments)))
        if module != "microros_gen":
            wait(lambda: all(server.says("loaded") for server in servers), 30, servers)
            for server in servers:
                server.begin()
        ask = Asking(stack.enter_context(Peer("asking")))
        stack.enter_context(alive(board))
        wait(lambda: sum(server.says(READY) for server in servers) == 1, 60, servers)
        first = next(server for server in servers if server.says(READY))
        second = next(server for server in servers if server is not first)
        wait(lambda: second.says("parameters are held by another"), 30, servers)
        ask.until(lambda: not board.has_news)
        graph = ask.peer.graph()
        ask.until(lambda: graph.nodes().count("/microros_parameters") == 1)  # names of nodes arrive late
        assert ask.get("gain") == [1.0]
        ask.set_double("gain", 2.5)
        ask.until(lambda: board.value("gain") == 2.5)
        assert not second.says(READY)
        assert not first.says("another parameter server asks this node")
        first.process.kill()
        wait(lambda: second.says(READY), 90, servers)
        board.set("count", 15)
        ask.until(lambda: not board.has_news)
        assert ask.get("gain", "count") == [2.5, 15]


@pytest.mark.ros
def test_a_separate_server_takes_over(domain: int, tmp_path: Path) -> None:
    """The agent's server yields and says so; it serves again when the other one is gone."""
    board = Board(time.monotonic)
    with ExitStack() as stack:
        module = "tests.support.parameter_server.of_agent"
        agent = stack.enter_context(running(domain, module, str(tmp_path / "agent.json")))
        agent.begin()
        stack.enter_context(alive(board))
        ask = Asking(stack.enter_context(Peer("asking")))
        wait(lambda: agent.says(READY), 60, [agent])
        ask.until(lambda: not board.has_news)
        arguments = ("parameter-server", "--file", str(tmp_path / "own.json"))
        own = stack.enter_context(running(domain, "microros_gen", *arguments))
        wait(lambda: own.says(READY), 60, [agent, own])
        wait(lambda: agent.says("another one serves now (a separate server, 0x"), 10, [agent, own])
        board.set("gain", 3.0)
        ask.until(lambda: not board.has_news)
        ask.until(lambda: (tmp_path / "own.json").exists() and "3.0" in (tmp_path / "own.json").read_text())
        own.process.terminate()
        assert own.process.wait(seconds(15)) == 0
        wait(lambda: agent.count(READY) == 2, 60, [agent])


@pytest.mark.ros
def test_a_server_without_a_claim_takes_over(domain: int, tmp_path: Path) -> None:
    """A program with the name of a server, which knows nothing of claims: the agent leaves it the parameters."""
    board = Board(time.monotonic)
    with ExitStack() as stack:
        module = "tests.support.parameter_server.of_agent"
        agent = stack.enter_context(running(domain, module, str(tmp_path / "agent.json")))
        agent.begin()
        stack.enter_context(alive(board))
        wait(lambda: agent.says(READY), 60, [agent])
        with running(domain, "tests.support.parameter_server.short_server") as own:
            wait(lambda: own.says(READY), 60, [agent, own])
            wait(lambda: agent.says("(a node /microros_parameters without a claim)"), 60, [agent, own])
            assert agent.count(READY) == 1
        wait(lambda: agent.count(READY) == 2, 90, [agent])  # when DDS has noticed that the other one is gone


@pytest.mark.ros
def test_two_agents_with_one_file(domain: int, tmp_path: Path) -> None:
    """On one machine both have the usual file: the second one continues with the values of the first one."""
    board, file = Board(time.monotonic), str(tmp_path / "p.json")
    with ExitStack() as stack:
        module = "tests.support.parameter_server.of_agent"
        servers = [stack.enter_context(running(domain, module, file)) for _ in range(2)]
        wait(lambda: all(server.says("loaded") for server in servers), 30, servers)
        for server in servers:
            server.begin()
        ask = Asking(stack.enter_context(Peer("asking")))
        with alive(board):
            wait(lambda: sum(server.says(READY) for server in servers) == 1, 60, servers)
            ask.until(lambda: not board.has_news)
        first = next(server for server in servers if server.says(READY))
        second = next(server for server in servers if server is not first)
        ask.until(lambda: ask.set(gain=ParameterValue(DOUBLE, 7.5)) == [(True, HELD)])
        first.process.kill()
        wait(lambda: second.says(READY), 90, servers)
        assert ask.get("gain") == [7.5]
        board.start()
        with alive(board):
            ask.until(lambda: board.value("gain") == 7.5)
