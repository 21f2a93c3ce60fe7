# SPDX-License-Identifier: Apache-2.0
"""Names against ROS 2's own judges: rclpy's validation and expansion."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.application.names import (
    absolute,
    expand_topic_name,
    expanded_fault,
    namespace_fault,
    node_name_fault,
    topic_fault,
)
from tests.support.application.names import NAMES, accepted
from tests.support.examples import examples

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def ros() -> Any:
    pytest.importorskip("rclpy")
    import rclpy.expand_topic_name
    import rclpy.impl.implementation_singleton
    import rclpy.validate_full_topic_name
    import rclpy.validate_namespace
    import rclpy.validate_node_name
    import rclpy.validate_topic_name

    return rclpy


def is_stricter_here(name: str) -> bool:
    """rcl takes `~x` and joins it to the node's name."""
    return name.startswith("~") and name[1:2] not in ("", "/")


@given(name=NAMES)
@settings(max_examples=examples(400))
def test_topics_are_what_ros_takes(ros: Any, name: str) -> None:
    def judge(text: str) -> None:
        ros.validate_topic_name.validate_topic_name(text)
        full = ros.expand_topic_name.expand_topic_name(text, "node", "/ns")
        ros.validate_full_topic_name.validate_full_topic_name(full)

    ours = topic_fault(name) is None and expanded_fault(expand_topic_name(name, "node", "/ns")) is None
    if is_stricter_here(name):
        assert not ours
    else:
        assert ours == accepted(judge, name)


@given(name=NAMES, namespace=st.sampled_from(["/", "/ns", "/a/b"]))
@settings(max_examples=examples(200))
def test_topics_expand_as_in_ros(ros: Any, name: str, namespace: str) -> None:
    if topic_fault(name) is None:
        full = expand_topic_name(name, "node", namespace)
        assert full == ros.expand_topic_name.expand_topic_name(name, "node", namespace)


@given(name=NAMES)
@settings(max_examples=examples(300))
def test_node_names_are_what_ros_takes(ros: Any, name: str) -> None:
    assert (node_name_fault(name) is None) == accepted(ros.validate_node_name.validate_node_name, name)


@given(name=NAMES)
@settings(max_examples=examples(300))
def test_namespaces_are_what_ros_takes(ros: Any, name: str) -> None:
    """rcl puts a slash before a namespace that lacks one, and takes an empty one as the root."""
    given_name = absolute(name)
    judge = ros.validate_namespace.validate_namespace
    assert (namespace_fault(name) is None) == accepted(judge, given_name)


@given(name=NAMES)
@settings(max_examples=examples(200))
def test_the_place_of_a_fault_is_the_one_ros_names(ros: Any, name: str) -> None:
    """Where both blame the same character class, they name the same character."""
    fault = topic_fault(name)
    reported = (
        ros.impl.implementation_singleton.rclpy_implementation.rclpy_get_validation_error_for_topic_name(name)
    )
    if fault is not None and "has the character" in fault.message and reported is not None:
        message, index = reported
        if "characters other than" in message and "substitution" not in message:
            assert index == len(name[: fault.index].encode())
