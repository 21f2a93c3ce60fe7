# SPDX-License-Identifier: Apache-2.0
"""The worst phasing of a task as a time line (SVG): a lane for each task, the highest priority at the top.

The picture needs no font or program, follows the reader's light or dark theme, and is the same in every run.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from microros_gen.schedule.phasing import Phasing, worst_phasing
from microros_gen.schedule.response import Response

MOST_RUNS = 4000
"""Runs that a picture shows."""

_WIDTH, _LANE, _BAR, _CHAR, _MARGIN, _AXIS, _TICKS = 900, 34, 18, 7.3, 12, 30, 10
_STYLE = """\
.schedule text { font: 12px monospace; fill: #1c2733; }
.schedule .run { fill: #5b7fd1; }
.schedule .blocks { fill: #c7622b; }
.schedule .due { stroke: #1c2733; fill: none; }
.schedule .late { stroke: #b00020; fill: none; stroke-width: 2; }
.schedule .lane { stroke: #c3ccd8; fill: none; }
@media (prefers-color-scheme: dark) {
.schedule text { fill: #e2e8f0; }
.schedule .run { fill: #8fabef; }
.schedule .blocks { fill: #ffb787; }
.schedule .due { stroke: #e2e8f0; }
.schedule .late { stroke: #ff8a9a; }
.schedule .lane { stroke: #45525f; }
}"""


def shown_us(responses: Sequence[Response], name: str) -> int:
    """Return how long the picture of a task lasts: to its longest response, its deadline and the next release."""
    response = next(r for r in responses if r.task.name == name)
    return max(response.response_us or 0, response.task.due_us, response.task.period_us)


def draw(responses: Sequence[Response], name: str) -> str:
    """Return the picture of the worst phasing of the task `name`.

    Bars are where a task runs, in another color where it holds a lock that blocks; a line through the lane is a
    deadline, doubled in width where it is missed.
    """
    phasing = worst_phasing(responses, name, shown_us(responses, name))
    left = _MARGIN + max(len(r.task.name) for r in responses) * _CHAR + _MARGIN
    scale = (_WIDTH - left - _MARGIN) / phasing.end_us
    height = _MARGIN + len(responses) * _LANE + _AXIS
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" class="schedule" role="img" width="{_WIDTH}" height="{height}"'
        f' viewBox="0 0 {_WIDTH} {height}">',
        f"<title>Worst phasing of {escape(name)}</title>",
        f"<style>\n{_STYLE}\n</style>",
        *_lanes(responses, left),
        *_bars(responses, phasing, left, scale),
        *_deadlines(responses, phasing, left, scale),
        *_axis(phasing.end_us, left, scale, _MARGIN + len(responses) * _LANE),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _lanes(responses: Sequence[Response], left: float) -> Iterator[str]:
    for level, response in enumerate(responses):
        bottom = _bottom(level)
        yield f'<text x="{_MARGIN}" y="{bottom - 4}">{escape(response.task.name)}</text>'
        yield f'<path class="lane" d="M{left:.1f} {bottom}H{_WIDTH - _MARGIN}"/>'


def _bars(responses: Sequence[Response], phasing: Phasing, left: float, scale: float) -> Iterator[str]:
    levels = {response.task.name: level for level, response in enumerate(responses)}
    for run in phasing.runs[:MOST_RUNS]:
        if run.task not in levels:
            continue  # what blocks is no task
        x, width = left + run.begin_us * scale, (min(run.end_us, phasing.end_us) - run.begin_us) * scale
        style = "blocks" if run.blocks else "run"
        text = f"{run.task} {run.begin_us} to {run.end_us} us"
        yield (
            f'<rect class="{style}" x="{x:.2f}" y="{_bottom(levels[run.task]) - _BAR}" width="{width:.2f}"'
            f' height="{_BAR}"><title>{escape(text)}</title></rect>'
        )


def _deadlines(responses: Sequence[Response], phasing: Phasing, left: float, scale: float) -> Iterator[str]:
    """Yield a mark for the deadline of each release that is due in the picture."""
    ends = {(c.task, c.number): c.end_us for c in phasing.completions}
    for level, response in enumerate(responses):
        task = response.task
        deadline, number = task.due_us - task.jitter_us, 0
        while deadline <= phasing.end_us and number < MOST_RUNS:
            late = ends.get((task.name, number), phasing.end_us + 1) > deadline
            if deadline >= 0:
                bottom = _bottom(level)
                x = left + deadline * scale
                yield f'<path class="{"late" if late else "due"}" d="M{x:.2f} {bottom + 4}V{bottom - _BAR - 6}"/>'
            deadline, number = deadline + task.period_us, number + 1


def _axis(end_us: int, left: float, scale: float, top: float) -> Iterator[str]:
    step = _step(end_us)
    for time in range(0, end_us + 1, step):
        x = left + time * scale
        yield f'<path class="lane" d="M{x:.2f} {_MARGIN}V{top:.1f}"/>'
        yield f'<text x="{x:.2f}" y="{top + 18:.1f}" text-anchor="middle">{_time(time)}</text>'


def _step(end_us: int) -> int:
    """Return the distance of marks: 1, 2 or 5 times a power of ten, at most _TICKS of them."""
    power = 1
    while True:
        for factor in (1, 2, 5):
            if end_us <= _TICKS * factor * power:
                return factor * power
        power *= 10


def _time(time_us: int) -> str:
    if time_us % 1000 or not time_us:
        return f"{time_us} us"
    return f"{time_us // 1000} ms"


def _bottom(level: int) -> int:
    return _MARGIN + (level + 1) * _LANE - 8
