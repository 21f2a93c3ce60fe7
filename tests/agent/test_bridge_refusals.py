# SPDX-License-Identifier: Apache-2.0
"""An installation of ROS 2 that the bridge cannot use is refused with a reason, not found out by a crash."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import pytest

from microros_gen.agent.ros import libraries, rclpy_bridge
from microros_gen.agent.ros.libraries import Libraries
from microros_gen.agent.ros.raw_types import RawTypes
from microros_gen.diagnostics import UserError

pytestmark = pytest.mark.ros


@pytest.fixture
def loaded() -> Libraries:
    rclpy_bridge._import_rclpy()
    return Libraries()


def test_another_rmw_implementation_is_refused_before_it_ends_the_process() -> None:
    """To import rclpy with an RMW implementation that is not installed exits with 102."""
    done = subprocess.run(
        [sys.executable, "-m", "microros_gen", "agent", "udp4", "--port", "0"],
        env={**os.environ, "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"},
        capture_output=True,
        text=True,
        timeout=30,
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

    monkeypatch.setattr(rclpy_bridge, "_import_rclpy", lambda: Handles)
    with pytest.raises(UserError, match="chooses rmw_zenoh_cpp"):
        rclpy_bridge.open_bridge(1)


def test_layouts_are_as_expected_here(loaded: Libraries) -> None:
    RawTypes(loaded)


def _other_order(kind: type) -> type:
    """Return a structure with its first two members exchanged."""
    first, second, *rest = kind._fields_  # type: ignore[attr-defined]
    return type(kind.__name__, (ctypes.Structure,), {"_fields_": (second, first, *rest)})


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("MessageSupport", _other_order, "identifier"),
        ("ServiceSupport", _other_order, "identifier of a service"),
        ("MessageCallbacks", _other_order, "namespace"),
        ("ServiceCallbacks", _other_order, "service"),
        ("MessageMembers", _other_order, "namespace"),
        ("TypeDescription", _other_order, "description"),
        ("TypeHash", _other_order, "hash"),
        ("_SAMPLE", lambda _: ("rcl_interfaces", "GetParameters"), "description"),
        ("_SAMPLE", lambda _: ("no_such_interfaces", "A"), "no_such_interfaces"),
        ("FastBuffer", _other_order, "buffer of libfastcdr"),
    ],
)
def test_another_layout_is_refused(
    loaded: Libraries,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    change: Callable[[Any], Any],
    said: str,
) -> None:
    monkeypatch.setattr(libraries, name, change(getattr(libraries, name)))
    with pytest.raises(UserError, match=rf"not as in ROS 2 Jazzy: .*{said}") as caught:
        loaded.check_layout()
    assert caught.value.diagnostics[0].hint


def test_a_missing_library_is_refused(loaded: Libraries, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Libraries, "FASTRTPS", b"rosidl_typesupport_of_another_dds")
    with pytest.raises(UserError, match=r"a part of ROS 2 Jazzy is missing: .*of_another_dds"):
        Libraries()
