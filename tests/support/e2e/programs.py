# SPDX-License-Identifier: Apache-2.0
"""Runs a program until a text is seen."""

from __future__ import annotations

import time
from itertools import pairwise
from typing import Any

from tests.support.agent.observer import Observer
from tests.support.patience import deadline

HISTORY = 16
"""The largest history of an output stream."""


def until(observer: Observer, topics: list[str], last: int, timeout_s: float = 20.0) -> dict[str, list[Any]]:
    """Take samples until each of `topics` has the value `last` or a later one; return all samples by topic.

    A later one counts: a sample that came before the observer knew the writer does not come again.
    """
    found: dict[str, list[Any]] = {}
    end = deadline(timeout_s)
    missing = set(topics)
    while missing:
        assert time.monotonic() < end, f"{last} does not come on {missing}: {found.keys()}"
        for name, value in observer.ask(do="samples"):
            found.setdefault(name, []).append(value)
            if name in missing and value["data"] >= last:
                missing.discard(name)
        time.sleep(0.02)
    return found


def run_to(last: int, values: list[int]) -> None:
    """Check that `values` are consecutive up to `last`, and more than the end: discovery took the first."""
    assert values == list(range(values[0], last + 1))
    assert len(values) >= 5


def check_count(values: list[int], sessions_lost: int | None = None) -> None:
    """Check that `values` count up by one, but for one place for each session that was lost; None: nobody counts them.

    There, reliable messages that were sent and not acknowledged come again, a whole history of them at the most; and
    what was sent before ROS has found the new writer is missing.
    """
    breaks = [(before, after) for before, after in pairwise(values) if after != before + 1]
    assert sessions_lost is None or len(breaks) <= sessions_lost, (breaks, sessions_lost)
    assert all(before - after < HISTORY for before, after in breaks), breaks
