# SPDX-License-Identifier: Apache-2.0
"""Events from a graph server: requests have the names of the graph, and what they cannot be combined with."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.interfaces.types import TypeName
from tests.support.components.rendered import planned

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_events]
nodes: [{name: device, namespace: /arm}]
"""
REQUEST = TypeName("microros_graph_msgs", "srv", "EndpointStatus_Request")


@pytest.mark.parametrize(
    ("more", "bound"), [("", 95), ("limits: {microros_graph_msgs/msg/Name: {name: 120}}\n", 120)]
)
def test_names_of_requests_follow_from_those_of_the_graph(more: str, bound: int, tmp_path: Path) -> None:
    types = planned(tmp_path, APPLICATION + more).project.types
    (plan,) = (found for found in types if found.name == REQUEST)
    assert plan.limits is not None
    assert [limit.string for limit in plan.limits.fields[:2] if limit is not None] == [bound, bound]


def test_its_client_is_declared(tmp_path: Path) -> None:
    clients = planned(tmp_path, APPLICATION).project.runtime.entities.clients.declared
    assert [client.name for client in clients] == [
        "/microros_graph/list_names",
        "/microros_graph/list_endpoints",
        "/microros_graph/endpoint_status",
    ]


def test_the_topic_of_micro_ros_agent_has_no_qos(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, APPLICATION.replace("[+graph_events]", "[+graph_events, +graph_topic]"))
    found = [str(diagnostic) for diagnostic in caught.value.diagnostics]
    assert any("'graph_events' needs a graph server, and 'graph_topic' replaces it" in line for line in found)
