# SPDX-License-Identifier: Apache-2.0
"""Transforms: publishers with the QoS of tf2_ros, and sizes that follow from limits."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.components.tf_broadcaster.plan import TfPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+tf_broadcaster]
nodes: [{name: robot}, {name: arm}]
"""
LIMITS = "limits: {tf2_msgs/msg/TFMessage: {transforms: %s}}\n"


@pytest.mark.parametrize(
    ("more", "transforms", "frame"),
    [
        ("", 3, 31),
        ("limits: {'*': {string: 9, sequence: 1}}\n", 3, 31),
        (LIMITS % "{sequence: 5}", 5, 31),
        (LIMITS % "{header: {frame_id: 12}, child_frame_id: 20}", 3, 12),
    ],
)
def test_sizes_follow_from_limits(more: str, transforms: int, frame: int, tmp_path: Path) -> None:
    runtime = planned(tmp_path, APPLICATION + more).project.runtime
    assert runtime.features.of("tf_broadcaster") == TfPlan(transforms=transforms, frame=frame)


def test_publishers_are_those_of_the_first_node(tmp_path: Path) -> None:
    publishers = planned(tmp_path, APPLICATION).project.runtime.entities.publishers.declared
    assert [(publisher.node, publisher.topic) for publisher in publishers] == [(0, "/tf"), (0, "/tf_static")]


@pytest.mark.parametrize(
    ("application", "message"),
    [
        (APPLICATION.partition("nodes:")[0], "needs a declared node"),
        (
            APPLICATION + "endpoints: {/tf: {limits: {string: 9}}}\n",
            "the limits of '/tf' cannot differ from those of its type",
        ),
    ],
)
def test_what_it_cannot_do_without(application: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, application)
    assert any(message in str(diagnostic) for diagnostic in caught.value.diagnostics)
