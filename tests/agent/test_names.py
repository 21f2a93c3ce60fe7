# SPDX-License-Identifier: Apache-2.0
"""From DDS names to ROS names."""

from __future__ import annotations

import pytest

from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.names import ros_node, ros_topic, ros_type


@pytest.mark.parametrize(
    ("name", "node", "namespace"),
    [
        ("imu", "imu", "/"),
        ("/imu", "imu", "/"),
        ("robot/imu", "imu", "/robot"),
        ("/robot/left/imu", "imu", "/robot/left"),
        ("my node!", "my_node_", "/"),
        ("3d/2nd", "_2nd", "/_3d"),
        ("a//b", "b", "/a"),
        ("größe", "gr__e", "/"),
    ],
)
def test_node_names(name: str, node: str, namespace: str) -> None:
    assert ros_node(name) == (node, namespace)


@pytest.mark.parametrize("name", ["", "/", "n" * 256, "s" * 250 + "/n"])
def test_refused_node_names(name: str) -> None:
    with pytest.raises(BridgeError):
        ros_node(name)


def test_topics() -> None:
    assert ros_topic("rt/chatter") == "/chatter"
    assert ros_topic("rt/robot/imu_0/data") == "/robot/imu_0/data"


@pytest.mark.parametrize(
    "name",
    ["", "rt", "rt/", "rt//a", "rt/a/", "rt/1a", "chatter", "rq/aRequest", "rt/a b", "rt/{node}", "rt/~/a"],
)
def test_refused_topics(name: str) -> None:
    with pytest.raises(BridgeError):
        ros_topic(name)


def test_types() -> None:
    name = ros_type("std_msgs::msg::dds_::Int32_")
    assert (name.package, name.name, str(name)) == ("std_msgs", "Int32", "std_msgs/msg/Int32")


@pytest.mark.parametrize(
    "name",
    [
        "",
        "Int32",
        "std_msgs::msg::Int32",
        "Std::msg::dds_::X_",
        "a.b::msg::dds_::X_",
        "a::srv::dds_::X_Request_",
    ],
)
def test_refused_types(name: str) -> None:
    with pytest.raises(BridgeError):
        ros_type(name)
