# SPDX-License-Identifier: Apache-2.0
"""A ROS domain for the tests with nodes."""

from __future__ import annotations

import pytest

from tests.support.agent.process import enter_domain


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> int:
    return enter_domain(monkeypatch)
