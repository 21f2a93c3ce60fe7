# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock with texts and sequences: bounded by the limits of the application file, and above what runs."""

from __future__ import annotations

import pytest

from tests.support.firmware.board import C_FILES, Built
from tests.support.firmware.tasks import TEXTS, built_tasks, counted, holds_of, locks_of

TEXT_FLAG = "-DMEASURED_TEXTS"
FULL = "string: 40, sequence: 8"
CLOSE = 3
"""How far above the fullest message its bound may be: each copy supposes the worst addresses."""
NAMES = ("control", "worker", "session")


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    return built_tasks(tmp_path_factory.mktemp("texts"), application=TEXTS)


@pytest.mark.system
def test_no_hold_with_texts_and_sequences_is_longer_than_the_call_graph_says(built: Built) -> None:
    """JointState, LaserScan and String, as full as their limits allow."""
    image = built.link(C_FILES / "measured_tasks.c", built.out.parent / "texts.elf", TEXT_FLAG)
    rows = holds_of(built, image)
    assert all(row["open"] == [] for row in rows.values()), rows
    measured = {
        name: max(counted(built, TEXT_FLAG, f"-DMEASURED_HOLDS=RCLC_TASK_{name.upper()}")[0::2])
        for name in NAMES
    }
    for name, most in measured.items():
        assert 100 < most <= rows[name]["instructions"], (measured, rows)
    publishing = {hold["function"]: hold["instructions"] for hold in rows["control"]["holds"]}[
        "rmw_publisher_write"
    ]
    assert measured["control"] <= publishing < CLOSE * measured["control"], (measured, publishing)
    assert locks_of(built, image, "--port", "0").returncode == 0


@pytest.mark.system
def test_the_bound_grows_with_the_limits(built: Built, tmp_path_factory: pytest.TempPathFactory) -> None:
    bounds = []
    for number, limits in enumerate(("string: 20, sequence: 4", "string: 40, sequence: 4", FULL)):
        home = tmp_path_factory.mktemp(f"limits{number}")
        again = built if limits == FULL else built_tasks(home, application=TEXTS.replace(FULL, limits))
        image = again.link(C_FILES / "measured_tasks.c", home / "texts.elf", TEXT_FLAG)
        held = {hold["function"]: hold["instructions"] for hold in holds_of(again, image)["control"]["holds"]}
        bounds.append(held["rmw_publisher_write"])
    assert bounds[0] < bounds[1] < bounds[2] < 5 * bounds[0], bounds
