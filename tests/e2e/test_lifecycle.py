# SPDX-License-Identifier: Apache-2.0
"""A node with a life cycle is driven by rclpy, next to a lifecycle node of rclpy: both go through the same states."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.e2e.images import Images
from tests.support.e2e.lifecycle_pair import BOTH, DEVICE, PATHS, Pair, program_of, running_pair
from tests.support.e2e.lifecycle_peer import MODEL
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline
from tests.support.slices import first

pytestmark = pytest.mark.ros

IDS = (*range(10), 10, 11, 12, 20, 21, 22, 30, 31, 32, 40, 41, 42, 50, 51, 52, 60, 61, 62, 97, 98, 99, 255)
"""Every id of lifecycle_msgs/msg/Transition, and some that it has not."""
LABELS = (
    *("configure", "cleanup", "activate", "deactivate", "shutdown", "create", "destroy"),
    *("transition_success", "transition_failure", "transition_error", "Configure", " ", "configured"),
    *("no_transition_has_such_a_label", "unconfigured"),
)


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return program_of(images, image_port, tmp_path_factory.mktemp("cycle"))


@pytest.fixture
def pair(program: Path, image_port: Relay, agent: object, domain: int) -> Iterator[Pair]:
    with running_pair(program, domain) as pair:
        yield pair


def test_states_and_transitions_are_those_of_ros(pair: Pair) -> None:
    assert len(pair.both("available_states")) == 11
    assert len(pair.both("transition_graph")) == 25
    assert [[s.replace(DEVICE, MODEL), t] for s, t in pair.peer.ask(do="services", node=DEVICE)] == (
        pair.peer.ask(do="services", node=MODEL)
    )


@pytest.mark.parametrize("state", first(PATHS))
def test_every_transition_from_every_state(pair: Pair, state: str) -> None:
    """By id and by label. What rclpy's node answers with an exception is false here, and the state stays."""
    pair.begin(*PATHS[state])
    for identifier, label in [*((i, "") for i in IDS), *((0, text) for text in LABELS), (1, "cleanup")]:
        assert pair.both("state")[1] == state
        transitions = pair.both("available_transitions")
        is_valid = any(t[1] == label if label else t[0] == identifier for t in transitions)
        if is_valid or label:
            assert pair.changed(identifier, label) == [is_valid, is_valid], (identifier, label)
        else:
            assert pair.peer.change(DEVICE, identifier) is False, identifier
        pair.both("state")
        pair.calls()
        if is_valid:
            pair.begin(*PATHS[state])


@pytest.mark.parametrize("outcome", first(["ERROR", "FAILURE"]))
@pytest.mark.parametrize("after_error", first(["SUCCESS", "FAILURE", "ERROR"]))
def test_callbacks_that_fail(pair: Pair, outcome: str, after_error: str) -> None:
    ways = {"configure": (), "activate": (1,), "cleanup": (1,), "deactivate": (1, 3), "shutdown": (1, 3)}
    for name, way in ways.items():
        pair.begin(*way)
        pair.calls()
        pair.returns(name, outcome)
        pair.returns("error", after_error)
        assert pair.changed(0, name) == [False, False]
        pair.both("state")
        assert pair.calls() == [name, *(["error"] if outcome == "ERROR" else [])]
        pair.returns(name, "SUCCESS")


@pytest.mark.parametrize("state", first(PATHS))
def test_every_transition_by_the_application(pair: Pair, state: str) -> None:
    """The machine of rclpy's node goes as the device's, without services."""
    is_new = False
    for identifier in IDS:
        if not is_new:
            pair.program.call("reset")
            pair.peer.ask(do="reset")
            for step in PATHS[state]:
                assert pair.both_by_api(step)
        is_new = not pair.both_by_api(identifier)
        pair.calls()


def test_events_are_published(pair: Pair) -> None:
    for node in BOTH:
        pair.peer.ask(do="watch", node=node)
    end = deadline(20)
    while not all(pair.peer.ask(do="matched", node=node) for node in BOTH):
        assert time.monotonic() < end
    time.sleep(1)  # both writers know the reader
    pair.returns("deactivate", "ERROR")
    for identifier in (1, 3, 4, 5):
        pair.changed(identifier)
    events: list[Any] = []
    while len(events) < 2 * 9:
        events += pair.peer.ask(do="events")
        assert time.monotonic() < end, events
        time.sleep(0.05)
    of_device, of_model = ([event[1:] for event in events if event[0] == node] for node in BOTH)
    assert of_device == of_model
