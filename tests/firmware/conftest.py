# SPDX-License-Identifier: Apache-2.0
"""Output folders that all tests of this folder share."""

from __future__ import annotations

import os

import pytest

from firmware.board import Builds


@pytest.fixture(scope="session")
def builds(tmp_path_factory: pytest.TempPathFactory) -> Builds:
    base = tmp_path_factory.getbasetemp()
    return Builds((base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "firmware")
