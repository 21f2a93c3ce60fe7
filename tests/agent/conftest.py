# SPDX-License-Identifier: Apache-2.0
"""A bridge in this process and an observer in another one, in a separate ROS domain."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.agent.bridging import Bridged, opened
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain


@pytest.fixture(scope="module")
def bridged() -> Iterator[Bridged]:
    with opened(own_domain()) as running:
        yield running


@pytest.fixture(scope="module")
def bridge_observer(bridged: Bridged) -> Iterator[Observer]:
    with observing(bridged.domain) as running:
        yield running
