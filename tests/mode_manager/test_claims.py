# SPDX-License-Identifier: Apache-2.0
"""Which of several managers manages, by the publishers that the ROS graph shows."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import pytest

from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.turns import LEASE_S, Claims
from microros_gen.ros.graph import Graph
from tests.support.modes.models import model_of, model_text

OWN = "/mode_manager_00000005"
LOWER, HIGHER = "/mode_manager_00000001", "/mode_manager_00000009"
FOREIGN = "/__mode_manager"


class Publishers:
    """A graph in which nodes publish on the topic of one part."""

    def __init__(self, part: str, *nodes: str) -> None:
        self._topic, self._nodes = f"/{part}/transition_request_info", nodes

    def publishers(self, topic: str) -> list[SimpleNamespace]:
        return [SimpleNamespace(node=node) for node in self._nodes] if topic == self._topic else []


def claims(clock: list[float], roots: tuple[str, ...] = ()) -> Claims:
    return Claims(select_scope(model_of(model_text("robot")), roots), OWN, lambda: clock[0])


@pytest.mark.parametrize(
    ("nodes", "before", "meanwhile"),
    [
        ((), "", ""),
        ((OWN,), "", ""),
        ((OWN, LOWER), LOWER, LOWER),
        ((OWN, HIGHER), HIGHER, ""),
        ((OWN, FOREIGN), FOREIGN, FOREIGN),
    ],
)
def test_of_two_the_lower_one_goes_on(nodes: tuple[str, ...], before: str, meanwhile: str) -> None:
    graph = cast("Graph", Publishers("base", *nodes))
    assert claims([0.0]).other(graph, is_managing=False)[0] == before
    assert claims([0.0]).other(graph, is_managing=True)[0] == meanwhile


def test_only_parts_of_the_scope_count() -> None:
    graph = cast("Graph", Publishers("camera", LOWER))
    assert claims([0.0], ("base",)).other(graph, is_managing=False) == ("", "")
    assert claims([0.0]).other(graph, is_managing=False) == (LOWER, "camera")


def test_a_manager_that_does_not_answer_counts_again_after_a_while() -> None:
    clock = [0.0]
    known, graph = claims(clock), cast("Graph", Publishers("base", LOWER))
    known.bury(LOWER)
    assert known.other(graph, is_managing=True) == ("", "")
    clock[0] = LEASE_S
    assert known.other(graph, is_managing=True)[0] == LOWER
