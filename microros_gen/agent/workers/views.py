# SPDX-License-Identifier: Apache-2.0
"""The view of all clients, which the front joins from what its workers report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from microros_gen.agent.limits import Limits
from microros_gen.agent.states import ClientState
from microros_gen.agent.workers.report import Orphans, Report
from microros_gen.agent.workers.worker_process import WorkerProcess

VIEW_S = 0.25
"""Minimum seconds between two views of the clients."""
SLOW_S = 1.0
"""Seconds for which a view waits for a worker; what that one said last is used then."""


class Views:
    """Asks the workers for the states of their clients, and joins their answers."""

    def __init__(self, workers: Sequence[WorkerProcess], limits: Limits, clock: Callable[[], float]) -> None:
        """`limits`: those of each worker."""
        self._workers = workers
        self._clock = clock
        self._orphans = Orphans(limits.clients * len(workers), limits.sleep_timeout_s)
        self.states: tuple[ClientState, ...] = ()
        """The last view."""
        self._at = clock()
        self._late_at = self._at
        self._is_wanted = False
        self._open: set[int] = set()
        """Workers that have not answered the last question."""
        self._count = 0
        self._awaited: int | None = None
        """Number of views when one was asked for."""
        self.on_complete: Callable[[], object] = _nothing
        """Called after each view."""

    def wish(self) -> None:
        """Ask for a view, which is taken soon. May be called in any thread."""
        self._is_wanted = True

    def has_new(self) -> bool:
        """Ask for a view with the first call, and return whether it is there; then begin again."""
        if self._awaited is None:
            self._awaited = self._count
            self._is_wanted = True
        if self._count == self._awaited:
            return False
        self._awaited = None
        return True

    def look(self, now: float) -> None:
        """Begin a view if one is wanted, and do without workers that are slow."""
        if self._open and now >= self._late_at:
            for worker in self._workers:
                worker.late = worker.late or worker.number in self._open
            self._open.clear()
            self._complete()
        if self._is_wanted and not self._open and now >= self._at:
            self._is_wanted = False
            self._at, self._late_at = now + VIEW_S, now + SLOW_S
            self._open = {worker.number for worker in self._workers if worker.answers}
            for worker in self._workers:
                worker.ask(now, states=True)
            self._complete()

    def answered(self, worker: WorkerProcess, report: Report) -> None:
        """Take the report of a worker."""
        has_states = report.clients is not None
        worker.answered(report if has_states else replace(report, clients=worker.report.clients))
        if has_states and worker.number in self._open:
            self._open.discard(worker.number)
            self._complete()

    def ended(self, number: int, report: Report, keeps: bool) -> None:
        """Do without a worker that has ended, whose last report this is; its clients are silent if `keeps`."""
        if keeps:
            self._orphans.add(report.clients or (), number, self._clock())
        self._open.discard(number)
        self._complete()

    def _complete(self) -> None:
        """Take the view when all workers have answered."""
        if self._open:
            return
        states = [worker.report.clients or () for worker in self._workers]
        self.states = self._orphans.with_those_of(states, self._clock())
        self._count += 1
        self.on_complete()


def _nothing() -> None:
    """Do nothing; the default."""
