# SPDX-License-Identifier: Apache-2.0
"""The analysis as rows of a table and as data, in microseconds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from microros_gen.schedule.response import Blocker, Interference, Response
from microros_gen.schedule.task import BANDS, DECLARED, MIDDLE, SESSION, Task

HEAD = ("TASK", "BAND", "PRIORITY", "T", "C", "B", "R", "D", "SLACK", "C FROM", "B FROM", "BLOCKED BY")
UNKNOWN = "-"
"""In place of a response that has no bound."""


def schedule_rows(responses: Sequence[Response]) -> Iterator[tuple[str, ...]]:
    """Yield a row below HEAD for each task, the highest priority first."""
    for response in responses:
        task = response.task
        times = (task.period_us, task.time_us, response.blocking_us, response.response_us, task.due_us)
        shown = (UNKNOWN if time is None else str(time) for time in (*times, response.slack_us))
        sources = (task.time_from, blocking_from(response))
        yield (task.name, task.band, str(response.priority), *shown, *sources, blocked_by(response))


def blocking_from(response: Response) -> str:
    """Return what the numbers of B follow from, each once: `declared`, `call graph`, …; empty where B is 0."""
    outside = [DECLARED] if response.task.blocking_us else []
    return ", ".join(dict.fromkeys([*(b.source for b in response.blockers), *outside]))


def blocked_by(response: Response) -> str:
    """Return the chain that blocks a task: `log holds session for 40 us`; empty where nothing does."""
    chain = [f"{b.task} holds {b.lock} for {b.time_us} us" for b in response.blockers]
    outside = response.task.blocking_us
    return ", ".join([*chain, *([f"other code for {outside} us"] if outside else [])])


def schedule_data(responses: Sequence[Response]) -> list[dict[str, object]]:
    """Return what `--format json` prints: for each task the names of the table in lower case.

    `r` and `slack` are null where the response has no bound; then `overloaded` says whether the tasks take more time
    than there is. `blocked_by` and `delayed_by` are lists.
    """
    return [
        {
            "task": r.task.name,
            "band": r.task.band,
            "priority": r.priority,
            "t": r.task.period_us,
            "c": r.task.time_us,
            "c_from": r.task.time_from,
            "instructions_per_us": _ratio(r.task.instructions_per_us),
            "j": r.task.jitter_us,
            "b": r.blocking_us,
            "b_from": blocking_from(r),
            "r": r.response_us,
            "d": r.task.due_us,
            "slack": r.slack_us,
            "meets": r.meets,
            "overloaded": r.overloaded,
            "blocked_by": [
                {"task": b.task, "lock": b.lock, "time": b.time_us, "from": b.source} for b in r.blockers
            ],
            "delayed_by": [{"task": i.task, "times": i.times, "time": i.time_us} for i in r.interference],
        }
        for r in responses
    ]


def schedule_of(data: Sequence[Mapping[str, Any]]) -> tuple[Response, ...]:
    """Return the analysis whose schedule_data is `data`. KeyError, TypeError or ValueError: it is that of none.

    The tasks have no sections: what they block is in the responses.
    """
    return tuple(_response(row) for row in data)


def _ratio(ratio: Fraction | None) -> str | None:
    return None if ratio is None else str(ratio)


def _response(row: Mapping[str, Any]) -> Response:
    band = row["band"]
    if band not in (*BANDS, SESSION):
        raise ValueError(f"no band '{band}'")
    held = tuple(Blocker(b["task"], b["lock"], b["time"], b["from"]) for b in row["blocked_by"])
    task = Task(
        row["task"],
        row["t"],
        row["c"],
        MIDDLE if band == SESSION else band,
        deadline_us=row["d"],
        jitter_us=row["j"],
        blocking_us=row["b"] - sum(blocker.time_us for blocker in held),
        session=band == SESSION,
        instructions_per_us=None
        if row["instructions_per_us"] is None
        else Fraction(row["instructions_per_us"]),
    )
    delayed = tuple(Interference(i["task"], i["times"], i["time"]) for i in row["delayed_by"])
    return Response(task, row["priority"], row["b"], held, row["r"], row["overloaded"], delayed)
