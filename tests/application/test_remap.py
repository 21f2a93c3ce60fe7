# SPDX-License-Identifier: Apache-2.0
"""`remap:` of a node: what is wrong with rules, and names as ROS 2's own remapping gives them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from microros_gen.application.model import NodeDecl
from microros_gen.application.names import expand_topic_name
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.ids import without_id

NODE = """\
nodes:
  - name: imu
    namespace: /arm
    remap: {%s}
    publishers: [{topic: data, type: std_msgs/msg/Bool}, {topic: ~/state, type: std_msgs/msg/Bool}]
    services: [{name: reset, type: std_srvs/srv/Empty}]
"""

ERRORS = {
    "nothing of that name": (
        "dat: x",
        "f:4:13: error: the node has no topic or service 'dat' to remap. Did you mean 'data'?",
    ),
    "no name of a topic": ("data: 1x", "f:4:19: error: the name '1x' has a part that begins with a digit"),
    "no name to remap": ('"a b": x', "f:4:13: error: the name 'a b' has the character ' '"),
    "a substitution": ('data: "{node}/x"', "f:4:20: error: the name '{node}/x' has a substitution"),
    "one name twice": (
        "data: x, /arm/data: y",
        "f:4:22: error: '/arm/data' and 'data' are the same name, '/arm/data': it is remapped twice",
    ),
    "no node name": ("__node: a/b", "f:4:22: error: the node name 'a/b' has the character '/'"),
    "no namespace": ("__ns: /9", "f:4:20: error: the namespace '/9' has a part that begins with a digit"),
    "no text": ("data: 7", "f:4:19: error: 'nodes[0].remap.data' must be a text; it is 7"),
    "nothing": ("", "f:4:12: error: 'nodes[0].remap' must be"),
    "too long": (f"data: {'x' * 248}", "f:4:19: error: the name '/arm/xxx"),
}


def parse(rules: str) -> tuple[NodeDecl | None, list[str]]:
    found = Diagnostics()
    application = parse_application(Source("f", NODE % rules), found)
    return (application.nodes[0] if application and application.nodes else None), [
        without_id(d.headline()) for d in found
    ]


@pytest.mark.parametrize("name", ERRORS)
def test_a_rule_that_cannot_hold_is_an_error_at_its_place(name: str) -> None:
    rules, expected = ERRORS[name]
    _, messages = parse(rules)
    assert [line[: len(expected)] for line in messages] == [expected]


def test_names_of_the_source_are_kept_next_to_those_on_the_wire() -> None:
    node, messages = parse("__ns: /left, data: /robot/imu, reset: ~/restart")
    assert messages == []
    assert node is not None
    assert (node.name, node.namespace, node.given_name, node.given_namespace) == (
        "imu",
        "/left",
        "imu",
        "/arm",
    )
    assert [(e.topic, e.declared_as) for e in node.endpoints] == [
        ("/robot/imu", "/left/data"),
        ("~/state", ""),
        ("/left/imu/restart", "/left/reset"),
    ]


@pytest.mark.ros
@pytest.mark.parametrize(
    "rules",
    [
        {"data": "/robot/imu"},
        {"~/state": "state", "data": "~/raw"},
        {"__ns": "/left", "data": "other/data"},
        {"__node": "imu2", "~/state": "/state"},
        {"__node": "imu2", "__ns": "/a/b", "/a/b/data": "deep"},
        {"__ns": "/"},
        {"/arm/reset": "~/reset"},
    ],
    ids=lambda rules: ",".join(rules),
)
def test_names_are_those_that_ros_makes(rules: dict[str, str], tmp_path: Path) -> None:
    rclpy: Any = pytest.importorskip("rclpy")
    arguments = [word for pair in rules.items() for word in ("-r", ":=".join(pair))]
    context = rclpy.context.Context()
    rclpy.init(context=context)
    try:
        peer = rclpy.create_node(
            "imu",
            namespace="/arm",
            context=context,
            cli_args=["--ros-args", *arguments],
            enable_rosout=False,
            start_parameter_services=False,
        )
        topics = [peer.resolve_topic_name(name) for name in ("data", "~/state")]
        theirs = (peer.get_name(), peer.get_namespace(), *topics, peer.resolve_service_name("reset"))
        peer.destroy_node()
    finally:
        rclpy.shutdown(context=context)
    node, messages = parse(", ".join(f'"{key}": "{value}"' for key, value in rules.items()))
    assert messages == []
    assert node is not None
    full = [expand_topic_name(e.topic, node.name, node.namespace) for e in node.endpoints]
    assert (node.name, node.namespace, *full) == theirs
