# SPDX-License-Identifier: Apache-2.0
"""An independent test of schedules: a processor that is played tick by tick, without any formula of the analysis."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from microros_gen.schedule.task import BANDS, Section, Task


def played_response(order: Sequence[Task], blocking: int, horizon: int) -> int | None:
    """Return the longest response of the last task of `order` in the busy period after the worst instant.

    The processor first does `blocking` ticks of something that cannot be preempted. None: it is still busy at
    `horizon`.
    """
    waiting: list[list[int]] = [[] for _ in order]
    numbers, left = [0] * len(order), [0] * len(order)
    longest, tick = 0, 0
    while tick < horizon:
        for level, task in enumerate(order):
            while numbers[level] * task.period_us - task.jitter_us <= tick:
                waiting[level].append(numbers[level] * task.period_us - task.jitter_us)
                numbers[level] += 1
        running = next((level for level, due in enumerate(waiting) if due), None)
        if tick >= blocking and running is None:
            return longest
        if tick >= blocking and running is not None:
            left[running] = (left[running] or order[running].time_us) - 1
            if not left[running]:
                due = waiting[running].pop(0)
                if running == len(order) - 1:
                    longest = max(longest, tick + 1 - due)
        tick += 1
    return None


def random_tasks(random: Random, most: int = 5) -> list[Task]:
    """Return up to `most` tasks of a few ticks each, with jitter, locks, and deadlines below and above the period."""
    count = random.randint(1, most)
    tasks = []
    for index in range(count):
        period = random.randint(3, 40)
        time = random.randint(1, max(1, 2 * period // (count + 1)))
        sections = [
            Section(lock, random.randint(1, time)) for lock in ("session", "memory") if random.random() < 0.4
        ]
        tasks.append(
            Task(
                f"t{index}",
                period,
                time,
                criticality=random.choice(BANDS),
                deadline_us=random.choice([None, random.randint(time, 3 * period)]),
                jitter_us=random.choice([0, 0, random.randint(0, period)]),
                sections=tuple(sections),
                blocking_us=random.choice([0, 0, 1, 2]),
                sporadic=random.random() < 0.5,
                session=index == 0 and random.random() < 0.5,
            )
        )
    return tasks
