# SPDX-License-Identifier: Apache-2.0
"""An installation of ROS 2 that the bridge cannot use is refused with a reason, not found out by a crash."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from microros_gen.agent.ros import rclpy_bridge
from microros_gen.diagnostics import UserError
from microros_gen.ros import loading
from microros_gen.ros.errors import RosUnusableError
from tests.support.patience import seconds

pytestmark = pytest.mark.ros


def test_another_rmw_implementation_is_refused_before_it_ends_the_process() -> None:
    """To import rclpy with an RMW implementation that is not installed exits with 102."""
    done = subprocess.run(
        [sys.executable, "-m", "microros_gen", "agent", "udp4", "--port", "0"],
        env={**os.environ, "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"},
        capture_output=True,
        text=True,
        timeout=seconds(30),
    )
    assert done.returncode == 2
    assert "needs rmw_fastrtps_cpp, but RMW_IMPLEMENTATION chooses rmw_cyclonedds_cpp" in done.stderr
    assert "Unset RMW_IMPLEMENTATION" in done.stderr


def test_the_expected_rmw_implementation_may_be_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    rclpy_bridge.open_bridge(1).close()


def test_the_implementation_that_was_loaded_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    class Handles:
        rclpy_get_rmw_implementation_identifier = staticmethod(lambda: "rmw_zenoh_cpp")

    monkeypatch.setattr(loading, "import_rclpy", lambda: Handles)
    with pytest.raises(UserError, match="chooses rmw_zenoh_cpp"):
        rclpy_bridge.open_bridge(1)


def test_a_later_distribution_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """rclpy of Kilted, as its wheel describes the constructor; with it no sample would be exchanged."""

    class Node:
        def __init__(self) -> None:
            """__init__(self: Node, arg0: str, arg1: str, arg2: Context, arg3: object, arg4: bool, arg5: bool, arg6: object)"""  # noqa: E501

    class Handles:
        rclpy_get_rmw_implementation_identifier = staticmethod(lambda: "rmw_fastrtps_cpp")

    Handles.Node = Node  # type: ignore[attr-defined]
    monkeypatch.setattr(loading, "import_rclpy", lambda: Handles)
    with pytest.raises(UserError, match="needs ROS 2 Jazzy, and this ROS 2 is a later one"):
        rclpy_bridge.open_bridge(1)


def test_what_is_missing_in_ros_2_is_reported_as_unusable_by_the_agent(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse() -> None:
        raise RosUnusableError("cannot use this ROS 2: a part of it is missing", "Run: this")

    monkeypatch.setattr(rclpy_bridge, "raw_types", refuse)
    with pytest.raises(UserError, match="the agent cannot use this ROS 2: a part") as caught:
        rclpy_bridge.open_bridge(1)
    assert caught.value.diagnostics[0].hint == "Run: this"
