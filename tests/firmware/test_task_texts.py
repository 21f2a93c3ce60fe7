# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock with texts and sequences: bounded by the limits of the application file, and above what runs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from tests.support.firmware.board import C_FILES, Built
from tests.support.firmware.tasks import TEXTS, built_tasks, counted, holds_of, locks_of
from tests.support.slices import first

TEXT_FLAG = "-DMEASURED_TEXTS"
FULL = "string: 40, sequence: 8"
SMALLER = ("string: 40, sequence: 4", "string: 20, sequence: 8", "string: 20, sequence: 4")
CLOSE = 3
"""How far above the fullest message its bound may be: each copy supposes the worst addresses."""
NAMES = ("control", "worker", "session")


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    return built_tasks(tmp_path_factory.mktemp("texts"), application=TEXTS)


@pytest.fixture(scope="module")
def image(built: Built) -> Path:
    return built.link(C_FILES / "measured_tasks.c", built.out.parent / "texts.elf", TEXT_FLAG)


@pytest.fixture(scope="module")
def held(built: Built, image: Path) -> Mapping[str, Any]:
    """What the tool says of each task of the image."""
    return holds_of(built, image)


def publishing(held: Mapping[str, Any]) -> int:
    """Return the bound of a publish of the task `control`."""
    return int(
        {hold["function"]: hold["instructions"] for hold in held["control"]["holds"]}["rmw_publisher_write"]
    )


@pytest.mark.system
def test_no_hold_with_texts_and_sequences_is_longer_than_the_call_graph_says(
    built: Built, image: Path, held: Mapping[str, Any]
) -> None:
    """JointState, LaserScan and String, as full as their limits allow."""
    rows = held
    assert all(row["open"] == [] for row in rows.values()), rows
    measured = {
        name: max(counted(built, TEXT_FLAG, f"-DMEASURED_HOLDS=RCLC_TASK_{name.upper()}")[0::2])
        for name in NAMES
    }
    for name, most in measured.items():
        assert 100 < most <= rows[name]["instructions"], (measured, rows)
    most = publishing(rows)
    assert measured["control"] <= most < CLOSE * measured["control"], (measured, most)
    assert locks_of(built, image, "--port", "0").returncode == 0


@pytest.mark.system
@pytest.mark.parametrize("limits", first(SMALLER))
def test_the_bound_grows_with_the_limits(held: Mapping[str, Any], tmp_path: Path, limits: str) -> None:
    smaller = built_tasks(tmp_path, application=TEXTS.replace(FULL, limits))
    image = smaller.link(C_FILES / "measured_tasks.c", tmp_path / "texts.elf", TEXT_FLAG)
    bounds = [publishing(holds) for holds in (holds_of(smaller, image), held)]
    assert bounds[0] < bounds[1] < 5 * bounds[0], bounds
