# SPDX-License-Identifier: Apache-2.0
"""Sizes of the graph's pages follow from limits."""

from __future__ import annotations

from pathlib import Path

from microros_gen.components.graph.plan import GraphPlan
from tests.support.components.rendered import planned

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
