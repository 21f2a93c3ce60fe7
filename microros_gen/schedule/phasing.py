# SPDX-License-Identifier: Apache-2.0
"""The worst phasing of a set of tasks, played: which task runs when, from the instant at which all are released."""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from microros_gen.records import dataclass
from microros_gen.schedule.response import Response
from microros_gen.schedule.task import Task


@dataclass(frozen=True)
class Run:
    """A task runs from `begin_us` to before `end_us`; `blocks`: what is above it waits for a lock that it holds."""

    task: str
    begin_us: int
    end_us: int
    blocks: bool = False


@dataclass(frozen=True)
class Completion:
    """Release `number` of a task was due at `due_us`, below 0 where it was late, and is complete at `end_us`."""

    task: str
    number: int
    due_us: int
    end_us: int

    @property
    def response_us(self) -> int:
        """From the instant at which it was due."""
        return self.end_us - self.due_us


@dataclass(frozen=True)
class Phasing:
    """What happens until `end_us`."""

    end_us: int
    runs: tuple[Run, ...]
    completions: tuple[Completion, ...]


def worst_phasing(responses: Sequence[Response], name: str, end_us: int) -> Phasing:
    """Play the phasing that is the worst for the task `name`, until `end_us`.

    At 0 all tasks are released, each as late as its jitter allows, and from then on as early as possible. What blocks
    the task runs first, and nothing preempts it: it began just before 0. Tasks below `name` run in what is left.
    """
    order = [response.task for response in responses]
    blocked = next(response for response in responses if response.task.name == name)
    names = {task.name: level for level, task in enumerate(order)}
    runs: list[Run] = []
    now = 0
    for blocker in blocked.blockers:
        now = _append(runs, Run(blocker.task, now, now + blocker.time_us, blocks=True))
    if blocked.task.blocking_us:
        now = _append(runs, Run("", now, now + blocked.task.blocking_us, blocks=True))
    completions: list[Completion] = []
    releases = [(0, level, 0) for level in range(len(order))]
    heapq.heapify(releases)
    ready: list[tuple[int, int]] = []
    left = [0] * len(order)
    while now < end_us:
        while releases and releases[0][0] <= now:
            _, level, number = heapq.heappop(releases)
            heapq.heappush(ready, (level, number))
            heapq.heappush(releases, (_release_us(order[level], number + 1), level, number + 1))
        following = min(releases[0][0], end_us)
        if not ready:
            now = following
            continue
        level, number = ready[0]
        left[level] = left[level] or order[level].time_us
        end = min(now + left[level], following)
        left[level] -= end - now
        now = _append(runs, Run(order[level].name, now, end))
        if not left[level]:
            heapq.heappop(ready)
            completions.append(Completion(order[level].name, number, _due_us(order[level], number), now))
    completions.sort(key=lambda completion: (completion.end_us, names[completion.task]))
    return Phasing(end_us, tuple(runs), tuple(completions))


def _due_us(task: Task, number: int) -> int:
    return number * task.period_us - task.jitter_us


def _release_us(task: Task, number: int) -> int:
    return max(0, _due_us(task, number))


def _append(runs: list[Run], run: Run) -> int:
    """Append `run`, to the last one where the same task just goes on; return its end."""
    last = runs[-1] if runs else None
    if last and (last.task, last.end_us, last.blocks) == (run.task, run.begin_us, run.blocks):
        runs[-1] = Run(run.task, last.begin_us, run.end_us, run.blocks)
    else:
        runs.append(run)
    return run.end_us
