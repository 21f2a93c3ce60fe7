# SPDX-License-Identifier: Apache-2.0
"""Rates, sizes and delays from times that the tests choose."""

from __future__ import annotations

import statistics

import pytest

from microros_gen.ros_tools.rates import Bandwidth, Delays, Intervals

MS = 1_000_000
S = 1000 * MS


def test_the_rate_is_that_of_the_window() -> None:
    intervals = Intervals(3)
    assert intervals.text() is None
    times = [0, 500 * MS, 600 * MS, 700 * MS, 900 * MS]
    for time in times:
        intervals.add(time)
    last = [0.1, 0.1, 0.2]
    assert intervals.text() == (
        f"average rate: {1 / statistics.fmean(last):.3f}\n"
        f"\tmin: 0.100s max: 0.200s std dev: {statistics.pstdev(last):.5f}s window: 3"
    )


def test_a_clock_that_goes_back_starts_again() -> None:
    intervals = Intervals()
    for time in (5 * S, 6 * S, 1 * S):
        intervals.add(time)
    assert intervals.text() is None
    intervals.add(3 * S)
    assert intervals.text() == "average rate: 0.500\n\tmin: 2.000s max: 2.000s std dev: 0.00000s window: 1"


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        (100, "200 B/s from 2 messages\n\tMessage size mean: 100 B min: 100 B max: 100 B"),
        (5_000, "10.00 KB/s from 2 messages\n\tMessage size mean: 5.00 KB min: 5.00 KB max: 5.00 KB"),
        (2_000_000, "4.00 MB/s from 2 messages\n\tMessage size mean: 2.00 MB min: 2.00 MB max: 2.00 MB"),
    ],
)
def test_sizes_have_the_unit_of_the_rate(size: int, expected: str) -> None:
    bandwidth = Bandwidth()
    bandwidth.add(0, size)
    assert bandwidth.text(S) is None
    bandwidth.add(500 * MS, size)
    assert bandwidth.text(S) == expected


def test_delays_are_times_since_the_stamps() -> None:
    delays = Delays()
    assert delays.text() is None
    delays.add(10 * S, 9 * S)
    delays.add(11 * S, 11 * S - 500 * MS)
    assert delays.text() == "average delay: 0.750\n\tmin: 0.500s max: 1.000s std dev: 0.25000s window: 2"
