# SPDX-License-Identifier: Apache-2.0
"""Output folders that all tests of this folder share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain
from tests.support.firmware.board import Builds, shared_builds


@pytest.fixture(scope="session")
def builds(tmp_path_factory: pytest.TempPathFactory) -> Builds:
    return shared_builds(tmp_path_factory)


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running
