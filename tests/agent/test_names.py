# SPDX-License-Identifier: Apache-2.0
"""From DDS names to ROS names."""

from __future__ import annotations

import pytest

from microros_gen.agent.representation import Service
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.names import ros_node, ros_service, ros_topic, ros_type
from microros_gen.agent.wire.constants import Status
from microros_gen.interfaces.dds_names import dds_type


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
    [
        *(
            "",
            "rt",
            "rt/",
            "rt//a",
            "rt/a/",
            "rt/1a",
            "chatter",
            "rq/aRequest",
            "rt/a b",
            "rt/{node}",
            "rt/~/a",
        ),
        "rt/" + "a" * 240,
    ],
)
def test_refused_topics(name: str) -> None:
    with pytest.raises(BridgeError):
        ros_topic(name)


def test_types() -> None:
    name = ros_type("std_msgs::msg::dds_::Int32_")
    assert (name.package, name.name, str(name)) == ("std_msgs", "Int32", "std_msgs/msg/Int32")


@pytest.mark.parametrize(
    ("name", "ros"),
    [
        ("example::action::dds_::Fold_FeedbackMessage_", "example/action/Fold_FeedbackMessage"),
        ("a::srv::dds_::X_Event_", "a/srv/X_Event"),
    ],
)
def test_types_of_services_and_actions(name: str, ros: str) -> None:
    assert str(ros_type(name)) == ros
    assert dds_type(ros_type(name)) == name


REQUEST, RESPONSE = "std_srvs::srv::dds_::SetBool_Request_", "std_srvs::srv::dds_::SetBool_Response_"


@pytest.mark.parametrize(
    ("service", "name"),
    [
        (Service("/set_bool", REQUEST, RESPONSE, "rq/set_boolRequest", "rr/set_boolReply"), "/set_bool"),
        (Service("", REQUEST, RESPONSE, "rq/a/bRequest", "rr/a/bReply"), "/a/b"),
        (Service("other", REQUEST, RESPONSE, "rq/aRequestRequest", "rr/aRequestReply"), "/aRequest"),
        (Service("a/b", REQUEST, RESPONSE), "/a/b"),
        (Service("/a/b", REQUEST, RESPONSE, "rq/a/bRequest"), "/a/b"),
    ],
)
def test_services(service: Service, name: str) -> None:
    found = ros_service(service)
    assert str(found) == f"{name} [std_srvs/srv/SetBool]"
    assert (dds_type(found.request), dds_type(found.response)) == (REQUEST, RESPONSE)
    assert (found.request_topic, found.reply_topic) == (f"rq{name}Request", f"rr{name}Reply")


def test_services_of_actions() -> None:
    types = "example::action::dds_::Fold_SendGoal_Request_", "example::action::dds_::Fold_SendGoal_Response_"
    topics = "rq/arm/fold/_action/send_goalRequest", "rr/arm/fold/_action/send_goalReply"
    found = ros_service(Service("/arm/fold/_action/send_goal", *types, *topics))
    assert str(found) == "/arm/fold/_action/send_goal [example/action/Fold_SendGoal]"


@pytest.mark.parametrize(
    ("service", "expected"),
    [
        (Service("", REQUEST, RESPONSE), "request topic 'rq/Request'"),
        (Service("a b", REQUEST, RESPONSE), "request topic"),
        (Service("", REQUEST, RESPONSE, "rt/a", "rr/aReply"), "'rq/nameRequest' is expected"),
        (Service("", REQUEST, RESPONSE, "rq/aRequest", "rr/aResponse"), "'rr/nameReply' is expected"),
        (Service("", REQUEST, RESPONSE, "rq/aRequest", "rr/bReply"), "one name for both"),
        (Service("a", RESPONSE, REQUEST), "SetBool_Response is not that of a ROS service"),
        (Service("a", REQUEST, "std_srvs::srv::dds_::Trigger_Response_"), "are not of one service"),
        (Service("a", "p::msg::dds_::A_Request_", "p::msg::dds_::A_Response_"), "not that of a ROS service"),
        (Service("a", "p::srv::dds_::A_Request", RESPONSE), "is not a ROS message"),
        (Service("a" * 239, REQUEST, RESPONSE), "too long"),
    ],
)
def test_refused_services(service: Service, expected: str) -> None:
    with pytest.raises(BridgeError, match=expected) as caught:
        ros_service(service)
    assert caught.value.status is Status.INVALID_DATA


@pytest.mark.parametrize(
    "name",
    [
        "",
        "Int32",
        "std_msgs::msg::Int32",
        "Std::msg::dds_::X_",
        "a.b::msg::dds_::X_",
        "a::idl::dds_::X_",
        "a::msg::dds_::_",
        f"{'a' * 150}::msg::dds_::{'B' * 60}_",
    ],
)
def test_refused_types(name: str) -> None:
    with pytest.raises(BridgeError):
        ros_type(name)
