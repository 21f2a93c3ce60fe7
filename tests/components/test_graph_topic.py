# SPDX-License-Identifier: Apache-2.0
"""The graph by topic: sizes follow from limits, and what it cannot be combined with."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.components.graph.plan import GraphPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_topic]
nodes: [{name: device, namespace: /arm}]
"""
ENTITY = "micro_ros_msgs/msg/Entity"


def test_names_follow_from_limits(tmp_path: Path) -> None:
    sizes = planned(tmp_path, APPLICATION).project.runtime.features.of("graph")
    assert sizes == GraphPlan(name_size=96, names=0, types=0, endpoints=0)
    own = planned(tmp_path, APPLICATION + f"limits: {{{ENTITY}: {{name: 40}}}}\n").project.runtime
    assert own.features.of("graph") == GraphPlan(name_size=41, names=0, types=0, endpoints=0)


def test_the_reader_has_no_queue_and_the_name_of_a_topic_in_dds(tmp_path: Path) -> None:
    runtime = planned(tmp_path, APPLICATION).project.runtime
    (subscription,) = runtime.entities.subscriptions.declared
    assert (subscription.topic, subscription.dds_topic) == ("ros_to_microros_graph", "ros_to_microros_graph")
    (queue,) = runtime.input.queues
    assert (queue.streamed, queue.size) == (True, 4)
    assert (runtime.input.streams, runtime.input.fragments) == (True, "kept")
    assert runtime.input.size == 256, "of a piece, not of the message"


@pytest.mark.parametrize(
    ("application", "message"),
    [
        ("version: 1\nprofiles: [pure_sender]\ncomponents: [+graph_topic]\n", "needs a declared node"),
        (APPLICATION + "entities: preconfigured\n", "cannot be used with 'entities: preconfigured'"),
    ],
)
def test_what_it_cannot_do_without(tmp_path: Path, application: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, application)
    assert any(message in str(diagnostic) for diagnostic in caught.value.diagnostics)
