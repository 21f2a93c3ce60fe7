# SPDX-License-Identifier: Apache-2.0
"""Priorities: bands, deadlines, the session's task, and priorities that the application gives."""

from __future__ import annotations

import pytest

from microros_gen.schedule.priorities import PriorityFault, by_priority, priority_faults
from microros_gen.schedule.task import HIGH, LOW, Task

CONTROL = Task("control", 10_000, 1, criticality=HIGH)
SESSION = Task("session", 5000, 1, session=True, criticality=LOW)
IMU = Task("imu", 1000, 1, sporadic=True)
SLOW = Task("slow", 100_000, 1, deadline_us=900)
LOG = Task("log", 100, 1, criticality=LOW)


def names(*tasks: Task) -> str:
    return " ".join(task.name for task in by_priority(tasks))


def test_bands_precede_deadlines() -> None:
    assert names(LOG, IMU, SLOW, SESSION, CONTROL) == "control slow session imu log"


def test_the_session_precedes_what_it_releases_and_is_the_last_where_clocks_release_all() -> None:
    command = Task("command", 50_000, 1, criticality=HIGH, sporadic=True)
    assert names(LOG, IMU, command, SESSION, CONTROL) == "control session command imu log"
    assert names(LOG, SLOW, SESSION, CONTROL) == "control slow log session"


def test_equal_deadlines_stay_as_they_are_written() -> None:
    other = Task("other", 1000, 1)
    assert (names(IMU, other), names(other, IMU)) == ("imu other", "other imu")


def test_a_priority_of_the_application_holds_and_the_others_fill_the_rest() -> None:
    first = Task("first", 1_000_000, 1, criticality=LOW, priority=1)
    last = Task("last", 1, 1, criticality=HIGH, priority=6)
    assert names(LOG, last, IMU, SESSION, CONTROL, first) == "first control session imu log last"


def test_priorities_that_cannot_be_are_named() -> None:
    zero, three = Task("zero", 1, 1, priority=0), Task("three", 1, 1, priority=3)
    first, second = Task("first", 1, 1, priority=1), Task("second", 1, 1, priority=1)
    assert priority_faults([zero, three]) == (PriorityFault(zero), PriorityFault(three))
    assert priority_faults([first, second]) == (PriorityFault(second, first),)
    assert priority_faults([first, IMU]) == ()
    with pytest.raises(ValueError, match="impossible priorities"):
        by_priority([first, second])
