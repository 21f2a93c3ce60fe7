# SPDX-License-Identifier: Apache-2.0
"""How many workers there are: numbers, and processors with the limit of a container."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from microros_gen.agent.workers.count import MOST, processors, worker_count


@pytest.mark.parametrize("text", ["0", "65", "-1", "1.5", "all", "", "\u0661"])
def test_no_number_of_workers(text: str) -> None:
    assert worker_count(text) is None


def test_numbers() -> None:
    assert [worker_count(text) for text in ("1", "64")] == [1, MOST]


@pytest.mark.parametrize(
    ("quota", "most"), [("max 100000", 8), ("150000 100000", 2), ("50000 100000", 1), ("x", 8), ("1 0", 8)]
)
def test_processors_of_a_container(
    quota: str, most: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(8)))
    file = tmp_path / "cpu.max"
    file.write_text(quota + "\n")
    assert processors(file) == worker_count("auto", file) == most
    assert processors(tmp_path / "none") == 8
