# SPDX-License-Identifier: Apache-2.0
"""Loads rclpy with the RMW implementation for which `raw_types` creates type supports."""

from __future__ import annotations

import importlib
import os
from typing import Any

from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.libraries import INSTALL

RMW = "rmw_fastrtps_cpp"
"""The only supported RMW implementation."""


def load_rclpy() -> Any:
    """Return rclpy's handles. Raises RosUnusableError if rclpy is missing or broken, or uses another RMW."""
    _check_implementation(
        os.environ.get("RMW_IMPLEMENTATION") or RMW
    )  # to load rclpy with a wrong one may exit
    handles = import_rclpy()
    _check_implementation(handles.rclpy_get_rmw_implementation_identifier())
    _check_distribution(handles)
    return handles


def _check_distribution(handles: Any) -> None:
    """Refuse rclpy of Kilted and later: with its DDS, endpoints of types that are made at run time get no samples.

    Its constructor of nodes has a seventh argument, the QoS of /rosout (rclpy 9), which tells it from that of Jazzy.
    """
    if "arg6" in (handles.Node.__init__.__doc__ or ""):
        raise RosUnusableError(
            "needs ROS 2 Jazzy, and this ROS 2 is a later one",
            f"Run: {INSTALL} in another environment; nodes of Kilted receive its samples all the same",
        )


def import_rclpy() -> Any:
    """Return rclpy's handles, whichever RMW implementation they use."""
    try:
        importlib.import_module("rclpy")
        return importlib.import_module("rclpy.impl.implementation_singleton").rclpy_implementation
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError) and error.name == "rclpy"
        reason = (
            "rclpy (ROS 2) is not installed for this Python" if missing else f"rclpy does not load: {error}"
        )
        raise RosUnusableError(
            f"needs ROS 2: {reason}", f"Run: {INSTALL}, or source a ROS 2 installation"
        ) from error


def _check_implementation(implementation: str) -> None:
    if implementation != RMW:
        raise RosUnusableError(
            f"needs {RMW}, but RMW_IMPLEMENTATION chooses {implementation}",
            f"Unset RMW_IMPLEMENTATION, or set it to {RMW}; nodes with another DDS are reached all the same",
        )
