# SPDX-License-Identifier: Apache-2.0
"""Streams and queues against memory.ram_budget: what makes them fit, planned before it is proposed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice

from microros_gen.application.model import Application
from microros_gen.client.plan.changed_lines import changed_lines
from microros_gen.client.plan.levers import Lever, history_lever, limit_levers, queue_levers
from microros_gen.client.plan.project import Project
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Capacities

_LIMITS = 24
_QUEUES = 6
_ALTERNATIVES = 4
_PARTS = 256


@dataclass(frozen=True)
class _Trial:
    """Plans an application again with other numbers; `plan` raises UserError where it cannot be planned."""

    plan: Callable[[Application], Project]
    budget: int

    def taken(self, application: Application) -> int | None:
        """Return what streams and queues take, bytes; None where there is no plan."""
        try:
            return stream_bytes(self.plan(application))
        except UserError:
            return None

    def fits(self, application: Application) -> bool:
        """Whether they are within the budget."""
        taken = self.taken(application)
        return taken is not None and taken <= self.budget


def stream_bytes(project: Project) -> int:
    """Return the static memory of streams and queues."""
    return project.streams.ram + project.runtime.input.queues_size


def check_stream_budget(
    project: Project,
    capacities: Capacities,
    plan: Callable[[Application], Project],
    diagnostics: Diagnostics,
) -> None:
    """Report streams and queues that are larger than the RAM budget, with lines that bring them below it.

    `plan` plans another application, with its own budget unchecked; it raises UserError where it cannot.
    """
    application, streams, queues = project.application, project.streams, project.runtime.input.queues_size
    budget, now = application.memory.ram_budget, stream_bytes(project)
    if budget is None or now <= budget:
        return
    message = (
        f"the streams alone take {now} bytes of RAM and memory.ram_budget is {budget}"
        f" (reliable {streams.reliable_slots} x {streams.reliable_slot_size}, best effort"
        f" {streams.best_effort_shown}, input {streams.input_size}{f', queues {queues}' if queues else ''})"
    )
    hint, block = _proposal(project, capacities, _Trial(plan, budget), now)
    diagnostics.add(Diagnostic(message, application.memory.ram_span, hint, block=block, id="MG-7022"))


def _proposal(
    project: Project, capacities: Capacities, trial: _Trial, now: int
) -> tuple[str, tuple[str, ...]]:
    """Return the hint and its lines: one number alone where that is enough, else several together."""
    application, history = project.application, history_lever(project)
    places = [*([history] if history is not None else []), *islice(queue_levers(project), _QUEUES)]
    places = _by_saving(application, places, trial, now)
    limits = _by_saving(application, islice(limit_levers(capacities), _LIMITS), trial, now)
    alone = [found for lever in (*places, *limits) if (found := _enough(application, lever, trial))]
    if alone:
        shown = alone[:_ALTERNATIVES]
        lines = [line for other in shown for line in _lines(application, other, trial)]
        return f"Set {'this' if len(shown) == 1 else 'one of these'}, or raise the budget:", tuple(lines)
    together = _together(application, places, limits, trial)
    if together is None:
        return f"Declare less, or set memory.ram_budget above {now}", ()
    return "Set all of these, or raise the budget:", tuple(_lines(application, together, trial))


def _by_saving(application: Application, levers: Iterable[Lever], trial: _Trial, now: int) -> list[Lever]:
    """Return the numbers that save something, the most first."""
    savings = []
    for index, lever in enumerate(levers):
        taken = trial.taken(lever.put(application, 1))
        if taken is not None and taken < now:
            savings.append((taken, index, lever))
    return [lever for _, _, lever in sorted(savings, key=lambda s: s[:2])]


def _enough(application: Application, lever: Lever, trial: _Trial) -> Application | None:
    """Return the application with the largest value of one number that is enough; None where none is."""
    return _largest(lever.now, lambda value: lever.put(application, value), trial)


def _together(
    application: Application, places: Iterable[Lever], limits: Sequence[Lever], trial: _Trial
) -> Application | None:
    """Return the application with places lowered until it fits, or all of them and every limit in proportion."""
    for lever in places:
        enough = _enough(application, lever, trial)
        if enough is not None:
            return enough
        application = lever.put(application, 1)

    def scaled(part: int) -> Application:
        found = application
        for lever in limits:
            found = lever.put(found, max(1, lever.now * part // _PARTS))
        return found

    return _largest(_PARTS, scaled, trial)


def _largest(end: int, make: Callable[[int], Application], trial: _Trial) -> Application | None:
    """Return what `make` gives for the largest number from 1 to below `end` that fits; None where 1 does not."""
    if not trial.fits(make(1)):
        return None
    fits, too_much = 1, end
    while too_much - fits > 1:
        middle = (fits + too_much) // 2
        fits, too_much = (middle, too_much) if trial.fits(make(middle)) else (fits, middle)
    return make(fits)


def _lines(before: Application, after: Application, trial: _Trial) -> Iterator[str]:
    """Yield the lines of the application file that make the one of the other, with what is taken then."""
    taken = f"then {trial.taken(after)} bytes"
    for line in changed_lines(before, after):
        yield line.text(taken)
