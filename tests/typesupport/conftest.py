# SPDX-License-Identifier: Apache-2.0
"""Plans of every message of the ROS wheels, generated once, and a shared library of them."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from ts_build import TEST_RULES, Generated, compile_shared, generate

ROS_PACKAGES = Path(sys.prefix) / "share"


@pytest.fixture(scope="session")
def packages() -> list[str]:
    """Every package of the environment that has messages."""
    return sorted({path.parent.parent.name for path in ROS_PACKAGES.glob("*/msg/*.msg")})


@pytest.fixture(scope="session")
def everything(packages: list[str], tmp_path_factory: pytest.TempPathFactory) -> Generated:
    """All messages under small limits, written to a folder."""
    return generate(packages, TEST_RULES, tmp_path_factory.mktemp("everything"))


@pytest.fixture(scope="session")
def library(everything: Generated) -> ctypes.CDLL:
    """All generated C as one shared library, with ROS 2's own string functions and allocator."""
    return compile_shared(everything)
