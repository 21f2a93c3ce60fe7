# SPDX-License-Identifier: Apache-2.0
"""Shared by all tests. Helpers are in tests/support/; no test module imports another."""

from __future__ import annotations

import importlib.util
import os
import sys

import pytest
from hypothesis import settings

pytest.register_assert_rewrite("tests.support")
pytest_plugins = ["tests.support.command_line", "tests.support.sharing", "tests.support.trees"]


def pytest_configure() -> None:
    """Let all tests and what they start share one cache of objects, and compile each Python module once.

    The suite starts the tool some thousand times: without bytecode, that takes longer than most tests.
    """
    from tests.support.examples import examples
    from tests.support.objects.cache import put_into_path
    from tests.support.sharing import share_components

    settings.register_profile("repeatable", deadline=None, derandomize=True, max_examples=examples(100))
    # `default` draws new examples each time.
    settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False
    put_into_path()
    share_components()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what needs ROS 2 where its wheels are not installed; `make test` always installs them."""
    if importlib.util.find_spec("rclpy") is not None:
        return
    for item in items:
        if item.get_closest_marker("ros"):
            item.add_marker(pytest.mark.skip(reason="needs the ROS 2 Jazzy wheels: pip install -e '.[ros]'"))
