# SPDX-License-Identifier: Apache-2.0
"""Shared by all tests: helpers below tests/ are imported by their folder (`cli.conftest`, `agent.client`)."""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("repeatable", derandomize=True)
settings.load_profile(
    os.environ.get("HYPOTHESIS_PROFILE", "repeatable")
)  # `default` draws new examples each time
sys.path.insert(0, str(Path(__file__).resolve().parent))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what needs ROS 2 where its wheels are not installed; `make test` always installs them."""
    if importlib.util.find_spec("rclpy") is not None:
        return
    for item in items:
        if item.get_closest_marker("ros"):
            item.add_marker(pytest.mark.skip(reason="needs the ROS 2 Jazzy wheels: pip install -e '.[ros]'"))
