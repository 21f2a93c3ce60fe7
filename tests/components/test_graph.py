# SPDX-License-Identifier: Apache-2.0
"""Sizes of the graph's pages follow from limits."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.components.graph.plan import GraphPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned
from tests.support.ids import without_id

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph]
nodes: [{name: device}]
"""
NAME, NAMES = "microros_graph_msgs/msg/Name", "microros_graph_msgs/srv/ListNames_Response"
ENDPOINTS = "microros_graph_msgs/srv/ListEndpoints_Response"


def pages(folder: Path, limits: str = "") -> GraphPlan:
    part = planned(
        folder, APPLICATION + (f"limits: {{{limits}}}\n" if limits else "")
    ).project.runtime.features.of("graph")
    assert isinstance(part, GraphPlan)
    return part


def test_pages_follow_from_limits(tmp_path: Path) -> None:
    assert pages(tmp_path) == GraphPlan(name_size=96, names=2, types=2, endpoints=1)
    own = f"{NAME}: {{name: 40}}, {NAMES}: {{names: 5}}, {ENDPOINTS}: {{endpoints: 3}}"
    assert pages(tmp_path, own) == GraphPlan(name_size=41, names=5, types=2, endpoints=3)
    assert pages(tmp_path, "'*': {string: 8, sequence: 1}") == pages(tmp_path)


def test_pages_that_no_message_holds_are_reported_at_the_limits(tmp_path: Path) -> None:
    """The component opens the client: no line of the file declares it."""
    with pytest.raises(UserError) as error:
        pages(tmp_path, f"{NAMES}: {{names: 4000}}")
    lines = [without_id(d.headline()) for d in error.value.diagnostics]
    assert [line.split("microros.yaml")[1] for line in lines] == [
        ":5:1: error: the reply of microros_graph_msgs/srv/ListNames on /microros_graph/list_names takes up to 1216028 "
        "bytes, but a message holds at most 65527. Lower its limits"
    ]
