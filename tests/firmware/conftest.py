# SPDX-License-Identifier: Apache-2.0
"""Output folders that all tests of this folder share."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain
from tests.support.firmware.board import Builds


@pytest.fixture(scope="session")
def builds(tmp_path_factory: pytest.TempPathFactory) -> Builds:
    base = tmp_path_factory.getbasetemp()
    return Builds((base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "firmware")


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running
