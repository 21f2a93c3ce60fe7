# SPDX-License-Identifier: Apache-2.0
"""Tasks as the analysis takes them. All times are whole microseconds."""

from __future__ import annotations

import math
from fractions import Fraction

from microros_gen.records import dataclass

HIGH, MIDDLE, LOW = "high", "middle", "low"
BANDS = (HIGH, MIDDLE, LOW)
"""Criticalities, the highest first. Every task of a band has a higher priority than those of the bands after it."""
SESSION = "session"
"""In place of a band where the session's task has its place by rule."""

TIME, INSTRUCTIONS = "time", "instructions"
"""What the execution time of a task follows from."""
DECLARED, CALL_GRAPH = "declared", "call graph"
"""What the time of a section follows from besides INSTRUCTIONS: a time of the application file, or the code of an
image. TIME: it is all of the task's."""

LONGEST_US = 1_000_000_000
"""Longest time that a task may have, and that is proposed: 1000 s."""


def time_of_instructions(count: int, instructions_per_us: Fraction) -> int:
    """Return the microseconds that `count` instructions take at most, rounded up."""
    return math.ceil(count / instructions_per_us)


@dataclass(frozen=True)
class Section:
    """`lock` is held for `time_us` at most, with priority inheritance; sections of a task are not nested.

    `instructions_per_us`: as that of a task. `source`: what the time follows from.
    """

    lock: str
    time_us: int
    instructions_per_us: Fraction | None = None
    source: str = DECLARED


@dataclass(frozen=True)
class Task:
    """A task that is released every `period_us` or more seldom, and runs for `time_us` at most each time.

    `deadline_us` counts from the instant at which the release is due, as `jitter_us` does, by which it may be late;
    None: the period is the deadline, and stays it if the period changes. `sections` are what it holds locks for.
    `blocking_us`: how long something that is no task of the set may keep it from running once for each release, such as
    code that runs with interrupts disabled. `priority`: where the application wants it in the table, 1 is the highest;
    None: by rule. `sporadic`: no clock releases it, but what the session's task receives. `session`: it runs the
    session, and has its place by the rule for that (by_priority); then `criticality` has no meaning.
    `instructions_per_us`: the time follows from a number of instructions at this rate; None: the application says it.

    Times from 1 to LONGEST_US, jitter and blocking from 0; ValueError for others.
    """

    name: str
    period_us: int
    time_us: int
    criticality: str = MIDDLE
    deadline_us: int | None = None
    jitter_us: int = 0
    sections: tuple[Section, ...] = ()
    blocking_us: int = 0
    priority: int | None = None
    sporadic: bool = False
    session: bool = False
    instructions_per_us: Fraction | None = None

    def __post_init__(self) -> None:
        """Refuse times that no task has."""
        positive = {"period": self.period_us, "time": self.time_us, "deadline": self.due_us}
        positive |= {f"section of {s.lock}": s.time_us for s in self.sections}
        other = {"jitter": self.jitter_us, "blocking": self.blocking_us}
        for least, times in ((1, positive), (0, other)):
            for what, time in times.items():
                if not least <= time <= LONGEST_US:
                    raise ValueError(f"the {what} of '{self.name}' is {time} us, not {least} to {LONGEST_US}")
        if self.criticality not in BANDS:
            raise ValueError(f"the criticality of '{self.name}' is '{self.criticality}'")
        if any(section.time_us > self.time_us for section in self.sections):
            raise ValueError(f"'{self.name}' holds a lock for longer than it runs")

    @property
    def due_us(self) -> int:
        """The deadline: the period where none is given."""
        return self.period_us if self.deadline_us is None else self.deadline_us

    @property
    def time_from(self) -> str:
        """What the time follows from: INSTRUCTIONS, or the application's own number."""
        return TIME if self.instructions_per_us is None else INSTRUCTIONS

    @property
    def band(self) -> str:
        """Its band, as the table has it."""
        return SESSION if self.session else self.criticality
