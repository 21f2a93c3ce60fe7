# SPDX-License-Identifier: Apache-2.0
"""Sessions with a board that loses messages and its power, with a created clock; no ROS."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import pytest

from microros_gen.parameter_server.exchange import ANSWER_S, SETTLE_S, Exchange, Outcome
from microros_gen.parameter_server.node import HeldNode, parameter
from microros_gen.parameter_server.values import DOUBLE, INTEGER, STRING, ParameterValue
from tests.support.parameter_server.board import COUNT, FIXED, GAIN, NAME, Board

Value = dict[str, Any]


class World:
    """A server and a board: what is sent arrives in the next moment, or is lost."""

    def __init__(self, board_key: int = 0xA1) -> None:
        self.now = 1000.0
        self.board = Board(lambda: self.now, board_key)
        self.others: list[Board] = []
        self.logged: list[str] = []
        self.lost: Callable[[], bool] = lambda: False
        self.reachable = True
        self.requests: list[Value] = []
        self._waiting: dict[int, Callable[[Value], object]] = {}
        self._arriving: list[tuple[int, Value]] = []
        self._next = 0
        self.held = HeldNode("/arm", lambda: self.now, self.logged.append)
        self.restart_server()

    def restart_server(self) -> None:
        self._waiting.clear()
        self.exchange = Exchange(self, self, lambda: self.now)

    # the way to the board

    def send(self, request: Value, done: Callable[[Value], object]) -> int:
        self._next += 1
        self._waiting[self._next] = done
        self.requests.append(request)
        if self.reachable and not self.lost():
            for board in [self.board, *self.others]:
                if not self.lost():
                    self._arriving.append((self._next, board.answer(request)))
        return self._next

    def forget(self, number: int) -> None:
        self._waiting.pop(number, None)

    def available(self) -> bool:
        return self.reachable

    def size(self, request: Value) -> int:
        return sum(90 + len(item["name"]) for item in request["parameters"])

    # what the exchange tells

    def listed(self, items: Sequence[Mapping[str, Any]], complete: bool) -> None:
        for name, value in self.held.merge(items, complete).push:
            self.exchange.set([parameter(name, value)], partial(self._pushed, name, value))

    def _pushed(self, name: str, value: ParameterValue, outcome: Outcome | None) -> None:
        if outcome is None:
            return
        if outcome.successful:
            self.held.has(name, value)
        else:
            self.held.refused(name, value, outcome.reason)

    def log(self, text: str) -> None:
        self.logged.append(text)

    # time

    def run(self, seconds: float) -> None:
        """Let time pass; the board publishes while it has news."""
        end = self.now + seconds
        while self.now < end:
            if self.reachable and round(self.now * 20) % 20 == 0 and self.board.has_news and not self.lost():
                notice = self.board.notice()
                self.exchange.notice(notice["board"], notice["session"], notice["revision"])
            arriving, self._arriving = self._arriving, []
            for number, response in arriving:
                if number in self._waiting:
                    self._waiting[number](response)
            self.exchange.step()
            self.now += 0.05

    def set(self, name: str, value: ParameterValue) -> list[Outcome | None]:
        """Set as a request from ROS does; the answer comes into the list."""
        answers: list[Outcome | None] = []

        def done(outcome: Outcome | None) -> None:
            answers.append(outcome)
            if outcome is None or outcome.successful:
                self.held.hold(name, value, pending=outcome is None)

        if self.exchange.is_open:
            self.exchange.set([parameter(name, value)], done)
        else:
            done(None)
        return answers

    @property
    def values(self) -> Value:
        return {name: held.value.value for name, held in self.held.parameters.items()}


@pytest.fixture
def world() -> World:
    created = World()
    created.run(3)
    assert created.exchange.is_open
    return created


def test_a_board_that_appears_is_listed_in_pages(world: World) -> None:
    assert world.values == world.board.values == {"gain": 1.0, "count": 10, "name": "arm", "fixed": True}
    assert [request["what"] for request in world.requests] == [0, 1, 3]
    assert not world.board.has_news


def test_a_set_goes_to_the_board_and_its_veto_to_the_caller(world: World) -> None:
    world.board.veto = lambda name, value: bool(value.value == 3.0)
    refused, taken = world.set("gain", ParameterValue(DOUBLE, 3.0)), []
    world.run(1)
    assert refused == [Outcome(False, "rejected by the callback")]
    taken = world.set("gain", ParameterValue(DOUBLE, 4.0))
    world.run(1)
    assert taken == [Outcome(True, "")]
    assert world.values["gain"] == world.board.value("gain") == 4.0
    before = len(world.requests)
    world.run(10)
    assert len(world.requests) == before


def test_what_the_board_changes_arrives(world: World) -> None:
    world.board.set("count", 15)
    world.run(2)
    assert world.values["count"] == 15
    assert not world.board.has_news
    world.board.revision = 2**32 - 1  # wraps with the next change
    world.board.set("count", 20)
    world.run(2)
    assert world.values["count"] == 20
    assert not world.board.has_news


def test_a_value_is_held_while_the_board_is_away(world: World) -> None:
    world.reachable = False
    world.run(0.1)
    assert world.set("gain", ParameterValue(DOUBLE, 7.0)) == [None]
    world.run(100)
    assert world.board.value("gain") == 1.0
    world.reachable = True
    world.run(40)
    assert world.board.value("gain") == 7.0
    assert world.held.pending() == []


def test_a_board_that_does_not_answer_is_away(world: World) -> None:
    world.lost = lambda: True
    answers = world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.run(ANSWER_S + 0.1)
    assert answers == [None]
    assert not world.exchange.is_open
    world.lost = lambda: False
    world.run(SETTLE_S + 3)
    assert world.board.value("gain") == 7.0


@pytest.mark.parametrize(("first", "winner"), [("server", 9.0), ("board", 5.0)])
def test_the_last_writer_wins(world: World, first: str, winner: float) -> None:
    world.reachable = False
    world.run(1)
    writes: list[Callable[[], object]] = [
        lambda: world.board.set("gain", 9.0),
        lambda: world.set("gain", ParameterValue(DOUBLE, 5.0)),
    ]
    for write in writes if first == "board" else reversed(writes):
        write()
        world.run(30)
    world.reachable = True
    world.run(40)
    assert world.values["gain"] == world.board.value("gain") == winner
    (line,) = [line for line in world.logged if "overruled" in line]
    assert ("the node's 9.0" in line.split(" is overruled by ")[0]) == (winner == 5.0)
    assert world.board.overruled == (["gain"] if winner == 5.0 else [])


def test_a_board_that_restarts_gets_what_is_held(world: World) -> None:
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.set("name", ParameterValue(STRING, "hand"))
    world.run(1)
    world.board.start()
    world.run(5)
    assert world.board.values == {"gain": 7.0, "count": 10, "name": "hand", "fixed": True}
    assert not [line for line in world.logged if "overruled" in line]
    world.board.start()
    world.board.set("gain", 2.0)  # by the program, after its start
    world.run(5)
    assert world.values["gain"] == world.board.value("gain") == 2.0
    assert world.board.value("name") == "hand"


def test_a_server_that_restarts_goes_on(world: World) -> None:
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.run(1)
    world.restart_server()
    world.board.set("count", 15)
    world.run(5)
    assert world.values == world.board.values == {"gain": 7.0, "count": 15, "name": "arm", "fixed": True}


def test_a_held_value_that_the_board_refuses_is_reported(world: World) -> None:
    world.reachable = False
    world.run(0.1)
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.board.veto = lambda name, value: True
    world.reachable = True
    world.run(5)
    assert world.values["gain"] == world.board.value("gain") == 1.0
    assert "/arm: gain: the node refuses 7.0 (rejected by the callback) and keeps 1.0" in world.logged


def test_other_firmware_loses_nothing(world: World) -> None:
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.set("count", ParameterValue(INTEGER, 50))
    world.run(1)
    former = world.board.defaults
    gain, count = type(GAIN)("gain", INTEGER), type(COUNT)("count", INTEGER, range=(0, 20, 0))
    world.board.defaults = {gain: ParameterValue(INTEGER, 3), count: ParameterValue(INTEGER, 4)}
    world.board.start()
    world.run(5)
    assert world.values == world.board.values == {"gain": 3, "count": 4}
    assert sum("is kept aside" in line for line in world.logged) == 4
    world.board.defaults = former
    world.board.start()
    world.run(5)
    assert world.values == world.board.values == {"gain": 7.0, "count": 50, "name": "arm", "fixed": True}


def test_a_request_that_the_board_cannot_receive_is_refused(world: World) -> None:
    answers: list[Outcome | None] = []
    many = [parameter(name, ParameterValue(DOUBLE, 1.0)) for name in ["gain"] * 9]
    world.exchange.set(many, answers.append)
    assert answers == [Outcome(False, "the request is too large, none of it was set")]


def test_two_boards_with_one_node_are_reported(world: World) -> None:
    second = Board(lambda: world.now, 0xB2)
    world.others = [second]
    world.exchange.notice(second.key, 0, 0)
    world.run(3)
    (line,) = [line for line in world.logged if "two boards" in line]
    assert line == "two boards have this node: 0x000000A1 and 0x000000B2; the first is served, rename one"
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.run(1)
    assert (world.board.value("gain"), second.value("gain")) == (7.0, 1.0)


def test_a_board_takes_the_place_of_another(world: World) -> None:
    world.set("gain", ParameterValue(DOUBLE, 7.0))
    world.run(1)
    world.board = Board(lambda: world.now, 0xB2)
    world.run(10)
    assert world.board.value("gain") == 7.0
    assert not [line for line in world.logged if "two boards" in line]


def test_another_server_is_noticed(world: World) -> None:
    rival = Exchange(world, world, lambda: world.now)
    for _ in range(20):
        rival.notice(0xA1, 0, 0)
        rival.step()
        world.now += 0.2
        rival.step()
        world.board.set("count", 15)
        world.run(1)
    assert "another parameter server also queries this node: stop one of them" in world.logged


@pytest.mark.parametrize("seed", range(12))
def test_both_sides_agree_whatever_is_lost(seed: int) -> None:
    """Everything happens at random; afterwards both have the same, of the last writer where it can be known."""
    draw = random.Random(seed)
    world = World()
    world.lost = lambda: draw.random() < 0.3
    for _ in range(120):
        event = draw.randrange(8)
        if event == 0:
            world.reachable = not world.reachable
        elif event == 1:
            world.board.start()
        elif event == 2:
            world.restart_server()
        elif event in (3, 4):
            world.board.set("count", 5 * draw.randrange(20))
        elif world.held.parameters:
            world.set("count", ParameterValue(INTEGER, 5 * draw.randrange(20)))
        world.run(draw.random() * 4)
    world.reachable, world.lost = True, lambda: False
    world.run(70)
    last = 5 * draw.randrange(20)
    world.set("count", ParameterValue(INTEGER, last))
    world.run(2)
    assert world.values == world.board.values
    assert world.board.value("count") == last
    assert world.held.pending() == []
    assert not world.board.has_news
    assert (NAME.name, FIXED.name) == ("name", "fixed")
