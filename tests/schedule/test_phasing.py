# SPDX-License-Identifier: Apache-2.0
"""What runs when, from the instant at which all tasks are released."""

from __future__ import annotations

from microros_gen.schedule.phasing import Completion, Run, worst_phasing
from microros_gen.schedule.response import analyze
from microros_gen.schedule.task import Section, Task

LOCK = (Section("session", 2),)


def test_what_blocks_runs_first_and_what_is_above_preempts() -> None:
    responses = analyze([Task("a", 6, 2, sections=LOCK), Task("b", 12, 4), Task("c", 24, 3, sections=LOCK)])
    phasing = worst_phasing(responses, "a", 14)
    assert phasing.runs == (
        Run("c", 0, 2, blocks=True),
        Run("a", 2, 4),
        Run("b", 4, 6),
        Run("a", 6, 8),
        Run("b", 8, 10),
        Run("c", 10, 12),
        Run("a", 12, 14),
    )
    assert phasing.completions[:2] == (Completion("a", 0, 0, 4), Completion("a", 1, 6, 8))


def test_the_first_release_is_as_late_as_the_jitter_allows() -> None:
    phasing = worst_phasing(analyze([Task("a", 10, 1, jitter_us=12)]), "a", 20)
    assert [(c.number, c.due_us, c.end_us, c.response_us) for c in phasing.completions] == [
        (0, -12, 1, 13),
        (1, -2, 2, 4),
        (2, 8, 9, 1),
        (3, 18, 19, 1),
    ]


def test_what_is_no_task_blocks_without_a_name() -> None:
    phasing = worst_phasing(analyze([Task("a", 10, 1, blocking_us=3)]), "a", 10)
    assert phasing.runs == (Run("", 0, 3, blocks=True), Run("a", 3, 4))
