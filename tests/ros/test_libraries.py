# SPDX-License-Identifier: Apache-2.0
"""An installation of ROS 2 that cannot be used is refused with a reason, not found out by a crash."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import pytest

from microros_gen.ros import libraries
from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.libraries import Libraries
from microros_gen.ros.loading import import_rclpy
from microros_gen.ros.raw_types import RawTypes

pytestmark = pytest.mark.ros


@pytest.fixture
def loaded() -> Libraries:
    import_rclpy()
    return Libraries()


def test_layouts_are_as_expected_here(loaded: Libraries) -> None:
    RawTypes(loaded)


def _other_order(kind: type) -> type:
    """Return a structure with its first two members exchanged."""
    first, second, *rest = kind._fields_  # type: ignore[attr-defined]
    return type(kind.__name__, (ctypes.Structure,), {"_fields_": (second, first, *rest)})


@pytest.mark.parametrize(
    ("name", "change", "expected"),
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
    expected: str,
) -> None:
    monkeypatch.setattr(libraries, name, change(getattr(libraries, name)))
    with pytest.raises(RosUnusableError, match=rf"not as in ROS 2 Jazzy: .*{expected}") as caught:
        loaded.check_layout()
    assert "pip install" in caught.value.hint


def test_a_missing_library_is_refused(loaded: Libraries, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Libraries, "FASTRTPS", b"rosidl_typesupport_of_another_dds")
    with pytest.raises(RosUnusableError, match=r"a part of ROS 2 Jazzy is missing: .*of_another_dds"):
        Libraries()
