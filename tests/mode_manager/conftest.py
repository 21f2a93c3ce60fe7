# SPDX-License-Identifier: Apache-2.0
"""A ROS domain and a stack of what is closed at the end, for the tests with nodes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.support.agent.process import enter_domain


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> int:
    return enter_domain(monkeypatch)


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    with ExitStack() as opened:
        yield opened
