# SPDX-License-Identifier: Apache-2.0
"""What a life cycle does in the middle of a transition, compared with librcl_lifecycle and with rclpy's node.

rclpy's node raises where a transition does not begin in the current state, and where a callback has left the state of
its transition by itself. The device refuses it instead: RCL_RET_ERROR, or `success` false. In both the state is that
of the machine of librcl_lifecycle.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.agent.wire.constants import SubmessageId
from tests.support.agent.process import running_agent
from tests.support.e2e.images import Images
from tests.support.e2e.lifecycle_pair import BOTH, CALLBACKS, DEVICE, RETURNED, Pair, program_of, running_pair
from tests.support.e2e.lifecycle_peer import WHATS
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline
from tests.support.slices import first

pytestmark = pytest.mark.ros

LABELS = (
    *("configure", "cleanup", "activate", "deactivate", "shutdown", "create", "destroy"),
    *("transition_success", "transition_failure", "transition_error", "Configure", "configured"),
)
WAYS: dict[str, tuple[tuple[int, ...], int]] = {
    "configure": ((), 1),
    "cleanup": ((1,), 2),
    "activate": ((1,), 3),
    "deactivate": ((1, 3), 4),
    "shutdown unconfigured": ((), 5),
    "shutdown inactive": ((1,), 6),
    "shutdown active": ((1, 3), 7),
}
"""The transitions before, and the one in question."""
ENDS = {"configure": 10, "cleanup": 20, "activate": 30, "deactivate": 40, "shutdown": 50, "error": 60}
"""The transition with which a callback's success leaves the state of its transition; the next two: failure, error."""

DATA, WRITE_DATA = int(SubmessageId.DATA), int(SubmessageId.WRITE_DATA)
FIRST_OF_TRANSITIONS = 10
"""The smallest id of a state in which a transition is."""


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return program_of(images, image_port, tmp_path_factory.mktemp("cycle"))


@pytest.fixture
def pair(program: Path, image_port: Relay, agent: object, domain: int) -> Iterator[Pair]:
    with running_pair(program, domain) as pair:
        yield pair


def begin(pair: Pair, way: str, error: bool = False) -> tuple[str, int]:
    """Go where a transition begins, by the applications; return its callback and its id.

    `error`: its callback leads to error processing.
    """
    path, identifier = WAYS[way]
    pair.program.call("place 1")
    pair.peer.ask(do="reset")
    for name in CALLBACKS:
        pair.returns(name, "SUCCESS")
    for step in path:
        assert pair.both_by_api(step)
    pair.calls()
    name = way.split()[0]
    if error:
        pair.returns(name, "ERROR")
    return name, identifier


def test_every_transition_from_every_state_of_the_machine(pair: Pair) -> None:
    """All 256 ids and the labels, from the ten states that a machine can be in."""
    lines = pair.program.call("table")[2]
    found = [[start, int(identifier), goal] for start, identifier, goal in map(str.split, lines)]
    for label in LABELS:
        lines = pair.program.call(f"table {label}")[2]
        found += [[start, label, goal] for start, _, goal in map(str.split, lines)]
    expected = pair.peer.ask(do="table", labels=LABELS)
    assert len(expected) == 2 * 25
    assert sorted(map(repr, found)) == sorted(map(repr, expected))


@pytest.mark.parametrize("way", first(WAYS))
def test_every_outcome_of_every_callback(pair: Pair, way: str) -> None:
    """Success, failure and error, and each of them for the callback of the error."""
    for outcome in RETURNED:
        for after in RETURNED:
            name, identifier = begin(pair, way)
            pair.returns(name, outcome)
            pair.returns("error", after)
            assert pair.both_by_api(identifier)
            assert pair.calls() == [name, *(["error"] if outcome == "ERROR" else [])]


@pytest.mark.parametrize("way", first([*WAYS, "error"]))
def test_a_callback_that_changes_the_state(pair: Pair, way: str) -> None:
    """By every id: what the machine has not is refused; what it has leads out of the transition, which then fails."""
    name = way.split()[0]
    for last in (0, *range(ENDS[name], ENDS[name] + 3)):
        for outcome in RETURNED:
            _, identifier = begin(pair, "configure" if way == "error" else way, way == "error")
            pair.returns(name, outcome)
            pair.program.call(f"inside {CALLBACKS.index(name)} c {last}")
            others = [i for i in range(256) if i not in range(ENDS[name], ENDS[name] + 3)]
            pair.peer.ask(do="change_inside", name=name, ids=[*others, *([last] if last else [])])
            exists, goal = pair.peer.ask(do="api", id=identifier)
            code, _, lines = pair.program.call(f"change {identifier}")
            inside = [[int(word) for word in line.split()[1:]] for line in lines]
            assert all(result == 1 for identifier, result, _ in inside if identifier > 255)
            found = [[i, result == 0, state] for i, result, state in inside if i <= 255]
            assert found == pair.peer.ask(do="seen"), (last, outcome)
            assert (code == 0) is exists is (last == 0), (last, outcome)
            assert pair.program.call("state")[2][0].split()[0] == str(goal), (last, outcome)
            pair.calls()


@pytest.mark.parametrize("way", first([*WAYS, "error"]))
def test_services_asked_during_a_transition(pair: Pair, way: str) -> None:
    """A callback that spins lets requests in: the answers are those of the model's node at this moment.

    A change that ends the transition succeeds, and the one that it ends does not.
    """
    name = way.split()[0]
    pair.begin()
    for count, last in enumerate(("", "transition_success", "transition_failure", "transition_error"), 1):
        _, identifier = begin(pair, "configure" if way == "error" else way, way == "error")
        changes = [
            (1, ""),
            (0, "configure"),
            (99, ""),
            (5, ""),
            (0, "shutdown"),
            *([(0, last)] if last else []),
        ]
        pair.peer.ask(do="ask_inside", name=name, changes=changes)
        pair.peer.ask(do="api", id=identifier)
        expected, end = pair.peer.ask(do="seen"), pair.peer.ask(do="state_of_machine")
        pair.program.call(f"inside {CALLBACKS.index(name)} s")
        pair.peer.ask(do="begin_change", node=DEVICE, id=identifier)
        limit = deadline(30)
        while pair.peer.state(DEVICE)[0] < FIRST_OF_TRANSITIONS:
            assert time.monotonic() < limit
        found: list[Any] = [pair.peer.get(DEVICE, what) for what in WHATS]
        for change in changes:
            found.append([pair.peer.change(DEVICE, *change), pair.peer.state(DEVICE)[0]])
        if last:  # where its goal is a primary state, rclpy goes there, has no outcome for it, and raises
            assert found[-1][0] is True
            expected[-1][0] = True
        assert found == expected
        assert pair.peer.ask(do="changed", node=DEVICE)[count - 1] is None
        pair.program.call("state")
        while (result := pair.peer.ask(do="changed", node=DEVICE)[count - 1]) is None:
            assert time.monotonic() < limit
        assert result == (not last and way != "error")
        assert pair.peer.state(DEVICE) == end


@pytest.fixture
def patient_pair(program: Path, relay: Relay, domain: int) -> Iterator[Pair]:
    """The same with an agent that waits for silent clients: the callback blocks as long as a busy machine needs."""
    with running_agent(domain, "--domain", str(domain), "--client-timeout", "600") as agent:
        relay.connect(agent.port)
        with running_pair(program, domain) as pair:
            yield pair


@pytest.mark.system
def test_requests_wait_for_a_transition_that_does_not_spin(patient_pair: Pair, relay: Relay) -> None:
    """They are answered after it, in their order, by the state which it has reached."""
    pair = patient_pair
    pair.begin()
    assert pair.peer.change(DEVICE, 99) is False  # its client is connected: the next request arrives at once
    pair.program.call(f"inside {CALLBACKS.index('configure')} b")
    pair.peer.ask(do="wait_inside", name="configure")
    requested, answered = relay.received[DATA], relay.sent[WRITE_DATA]
    for identifier, label in ((1, ""), (0, "activate")):
        for node in BOTH:
            pair.peer.ask(do="begin_change", node=node, id=identifier, label=label)
    limit = deadline(30)
    while relay.received[DATA] < requested + 2:
        assert time.monotonic() < limit
        time.sleep(0.01)
    assert relay.sent[WRITE_DATA] <= answered + 1  # the event of the transition's begin
    for node in BOTH:
        assert pair.peer.ask(do="changed", node=node) == [None, None]
    pair.peer.ask(do="release")
    pair.program.call("state")
    limit = deadline(30)
    for node in BOTH:
        while None in (results := pair.peer.ask(do="changed", node=node)):
            assert time.monotonic() < limit, (node, results)
        assert results == [True, True]
    assert pair.both("state")[1] == "active"
