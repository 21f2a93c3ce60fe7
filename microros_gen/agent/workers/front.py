# SPDX-License-Identifier: Apache-2.0
"""The front of an agent with several workers: what the main loop (`server.Server`) calls in place of an `Agent`.

It has the transports, passes messages between them and the workers, starts workers that ended again, and joins what
they report. Over UDP only messages outside of sessions pass through it: a worker opens a socket for each client in
session.
"""

from __future__ import annotations

import pickle
import select
import time
from collections.abc import Callable, Hashable, Sequence
from functools import partial

from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.states import ClientState
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.outbox import Refusal, SealedRecord, SealedSample
from microros_gen.agent.transport.tcp import Connection, Tcp
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.workers.addresses import AddressBook
from microros_gen.agent.workers.adoption import Adoption
from microros_gen.agent.workers.channel import WAITING_BYTES, Kind, message_frame, message_of
from microros_gen.agent.workers.report import Report, Totals
from microros_gen.agent.workers.routing import Place, Router
from microros_gen.agent.workers.views import Views
from microros_gen.agent.workers.worker_process import WorkerProcess
from microros_gen.diagnostics import Diagnostic, UserError

ASK_S = 1.0
"""Seconds between two questions to all workers, which show that they run."""
SWEEP_S = 1.0
"""Seconds between two looks for closed connections."""
MOST_ROUNDS = 64
"""Reads of a UDP socket until a new client is read by its worker: each takes up to 64 datagrams."""
LATE_S = 5.0
"""Seconds that workers have to end beyond the time that they give to readers."""
_FORMS: dict[Kind, Callable[[bytes], bytes]] = {
    Kind.MESSAGE: bytes,
    Kind.SEALED: SealedRecord,
    Kind.SEALED_SAMPLE: SealedSample,
    Kind.REFUSAL: Refusal,
}
"""Messages to clients, as their transports distinguish them."""


class Front:
    """Passes messages to workers and back, and looks after the workers."""

    def __init__(
        self,
        workers: Sequence[WorkerProcess],
        transports: Sequence[Transport],
        log: EventLog,
        limits: Limits,
        clock: Callable[[], float] = time.monotonic,
        is_sealed: bool = False,
        adopted: frozenset[bytes] = frozenset(),
    ) -> None:
        """`transports`: in the order in which workers number them. `limits`: those of each worker.

        `is_sealed`: messages of clients are sealed. `adopted`: keys of the clients to adopt.
        """
        self.workers = workers
        self._log = log
        self._clock = clock
        self._stop_s = limits.stop_s
        self._transports = tuple(transports)
        self._numbers = {id(transport): number for number, transport in enumerate(transports)}
        self._books = tuple(AddressBook(transport) for transport in transports)
        self._router = Router(len(workers), is_sealed)
        self._adoption = Adoption(workers, adopted)
        self._epoll = select.epoll()
        self._by_descriptor: dict[int, WorkerProcess] = {}
        self._before = Totals()
        """The counts of workers that have ended."""
        self._welcomes: dict[Place, tuple[int, bytes]] = {}
        """Answers to newcomers, and their worker, until another one has removed its client at that address."""
        self._views = Views(workers, limits, clock)
        self._views.on_complete = self._viewed
        self._ask_at = self._sweep_at = clock()
        self._ends = False
        self._failure: list[Diagnostic] = []
        self._has_started = False
        self.on_care: Callable[[float], None] | None = None
        """See Agent."""
        self.on_type: Callable[[str], object] = _ignore
        """Called with the type of each endpoint of a client that workers report."""

    # What the main loop calls

    @property
    def clients(self) -> range:
        """One number for each client of all workers, as they last said."""
        return range(sum(worker.report.connected for worker in self.workers))

    @property
    def samples(self) -> int:
        """See Agent: the sum of all workers."""
        return self._before.samples + sum(worker.report.samples for worker in self.workers)

    @property
    def delivered(self) -> int:
        """See Agent: the sum of all workers."""
        return self._before.delivered + sum(worker.report.delivered for worker in self.workers)

    @property
    def faults(self) -> dict[str, int]:
        """The number of faults of input by kind, of the front and all workers."""
        found = self._before.faults + self._log.counters
        for worker in self.workers:
            found.update(worker.report.faults)
        return dict(found)

    def fileno(self) -> int:
        """See Agent: readable when a worker has sent something."""
        return self._epoll.fileno()

    def due(self) -> float | None:
        """See Agent: what it does is done by `care`."""
        return None

    def tick(self) -> None:
        """See Agent."""

    def flush(self) -> None:
        """See Agent."""
        for worker in self.workers:
            if worker.channel is not None:
                worker.channel.flush()

    def receive(self, data: bytes, address: Hashable, transport: Transport) -> None:
        """Pass a message on. Never raises."""
        number = self._numbers[id(transport)]
        known = self._books[number].known(address)
        worker = self.workers[self._router.worker_for(data, (number, known.code), self._adoption.worker)]
        channel = worker.channel
        if channel is None or not worker.ready:
            text = "a message from {peer} is lost: worker {worker} does not run"
            self._log.count("worker_down", text, peer=transport.name_of(address), worker=worker.number)
            return
        if (
            not known.may_send(len(data), worker.number, channel.drained, channel.waiting)
            or channel.waiting > WAITING_BYTES
        ):
            text = "a message from {peer} is lost: worker {worker} has too much to do"
            self._log.count("worker_full", text, peer=transport.name_of(address), worker=worker.number)
            return
        channel.send(Kind.MESSAGE, message_frame(number, known.code, data))

    def take(self) -> None:
        """Do what workers have sent. Never raises."""
        for descriptor, _ in self._epoll.poll(0):
            worker = self._by_descriptor.get(descriptor)
            if worker is None or worker.channel is None:
                continue
            channel = worker.channel
            for kind, content in channel.receive():
                self._guarded(partial(self._do, worker, kind, content))
            if channel.closed:
                self._lost(worker, descriptor)

    def care(self, now: float) -> None:
        """Look after the workers, and ask them. Never raises."""
        for worker in self.workers:
            worker.look(now)
            if worker.is_due(now) and not self._ends:
                self._start(worker)
        if now >= self._sweep_at:
            self._sweep_at = now + SWEEP_S
            for book in self._books:
                book.forget_closed()
        if now >= self._ask_at:
            self._ask_at = now + ASK_S
            for worker in self.workers:
                worker.ask(now, states=False)
        self._views.look(now)
        if self.on_care is not None:
            self._guarded(partial(self.on_care, now))

    def close(self) -> None:
        """Let the workers end in order, and pass on what they still send. Never raises."""
        self._ends = True
        for worker in self.workers:
            if not worker.ready:
                worker.kill()  # it has no clients
            elif worker.channel is not None:
                worker.channel.send(Kind.STOP)
        self.flush()
        end = self._clock() + self._stop_s + LATE_S
        while any(worker.channel is not None for worker in self.workers) and self._clock() < end:
            self._epoll.poll(0.05)
            self.take()
            for transport in self._transports:
                transport.flush()
        for worker in self.workers:
            if worker.channel is not None:
                text = "worker {worker} did not end in time: it is ended"
                self._log.emit(Level.WARNING, "worker_stuck", text, worker=worker.number, seconds=LATE_S)
            worker.kill()
        for kind, count in self._before.faults.items():
            self._log.counters[kind] += count
        self._epoll.close()

    # Start, and what the front asks

    def start(self, wait_s: float, stops: Callable[[], bool] = bool) -> None:
        """Start all workers; return when each serves, or `stops` returns True.

        Raises UserError if one does not serve within `wait_s`.
        """
        for worker in self.workers:
            self._start(worker)
        end = self._clock() + wait_s
        while not all(worker.ready for worker in self.workers) and not stops():
            self._epoll.poll(0.05)
            self.take()
            late = next((worker for worker in self.workers if worker.pid == 0), None)
            if self._failure:
                raise UserError(self._failure)
            if late is not None or self._clock() > end:
                number = (late or next(w for w in self.workers if not w.ready)).number
                hint = "Its log is above; --workers 1 is an agent of one process"
                raise UserError([_not_started(number, "", hint)])
        self._has_started = True

    def tell(self, kind: Kind, content: bytes) -> None:
        """Send all workers that run what is in force now. Others get it by their `start_data`."""
        for worker in self.workers:
            if worker.channel is not None:
                worker.channel.send(kind, content)

    def has_new_view(self) -> bool:
        """Ask for a view of the clients with the first call, and return whether it is there; then begin again."""
        return self._views.has_new()

    def client_states(self) -> tuple[ClientState, ...]:
        """See Agent: the last view."""
        return self._views.states

    def latest_client_states(self) -> tuple[ClientState, ...]:
        """See Agent: the last view, and another one is taken soon. May be called in any thread."""
        self._views.wish()
        return self._views.states

    def _viewed(self) -> None:
        if self.on_care is not None:
            self._guarded(partial(self.on_care, self._clock()))

    # Workers

    def _start(self, worker: WorkerProcess) -> None:
        try:
            channel = worker.start()
            self._epoll.register(channel.fileno(), select.EPOLLIN)
        except OSError as error:
            worker.put_off(self._clock())
            hint = "Give the agent more memory, processes or descriptors (ulimit -n -u), or fewer --workers"
            self._failed(worker, [_not_started(worker.number, f": {error.strerror or error}", hint)])
            return
        self._by_descriptor[channel.fileno()] = worker

    def _failed(self, worker: WorkerProcess, why: list[Diagnostic]) -> None:
        """Note why a worker does not start; log it once if the agent serves already."""
        if not self._has_started:
            self._failure = self._failure or why
            return
        reason = "; ".join(diagnostic.message for diagnostic in why)
        if reason != worker.failure:
            worker.failure = reason
            text = "worker {worker} cannot start, and is tried again: {reason}"
            self._log.emit(Level.ERROR, "worker_failed", text, worker=worker.number, reason=reason)

    def _lost(self, worker: WorkerProcess, descriptor: int) -> None:
        """Let a worker that has ended be started again, and its clients find out."""
        del self._by_descriptor[descriptor]  # the epoll has forgotten the descriptor that was closed
        number, now = worker.number, self._clock()
        self._before.add(worker.report)
        was_ready, report = worker.ready, worker.report
        how = worker.ended(now)
        worker.report = Report()
        if was_ready and not self._ends:
            text = "worker {worker} ended ({how}) and is started again; its clients must open new sessions"
            self._log.emit(Level.ERROR, "worker_ended", text, worker=number, how=how)
        for place in [place for place, (of, _) in self._welcomes.items() if of == number - 1]:
            del self._welcomes[place]  # its client asks the next process
        for place in self._router.forget(number - 1):
            self._hang_up(*place)
            self._welcome(place)
        self._adoption.ended(worker)
        self._views.ended(number, report, keeps=not self._ends)

    def _hang_up(self, number: int, code: bytes) -> None:
        transport, address = self._transports[number], self._books[number].address(code)
        if isinstance(transport, Tcp) and isinstance(address, Connection) and not address.closed:
            transport.drop(address, "its worker ended")

    def _do(self, worker: WorkerProcess, kind: Kind, content: bytes) -> None:
        form = _FORMS.get(kind)
        if form is not None:
            number, code, data = message_of(content)
            address = self._books[number].address(code)
            if address is not None:
                self._transports[number].send(form(data), address)
        elif kind is Kind.BACK:
            self._again(content)
        elif kind in (Kind.CLAIMED, Kind.RELEASED):
            self._note(worker, kind, content)
        elif kind is Kind.NEWCOMER:
            self._make_way(worker, content)
        elif kind is Kind.STATUS:
            self._views.answered(worker, Report.decode(content))
        elif kind is Kind.MISSING:
            self._adoption.reported(worker, content)
        elif kind is Kind.TYPE:
            self.on_type(content.decode())
        elif kind is Kind.FAILED:
            self._failed(worker, pickle.loads(content))
        elif kind is Kind.READY:
            worker.ready = True
            worker.failure = ""
            if worker.restarts:
                text = "worker {worker} serves again (process {pid})"
                self._log.emit(Level.INFO, "worker_back", text, worker=worker.number, pid=worker.pid)

    def _guarded(self, do: Callable[[], object]) -> None:
        """Do one thing; a fault in it does not end the agent."""
        try:
            do()
        except Exception as error:
            text = "internal error in the first process: {error}; please report it"
            self._log.count(f"internal_{type(error).__name__}", text, error=repr(error))

    def _again(self, content: bytes) -> None:
        number, code, data = message_of(content)
        address = self._books[number].address(code)
        if address is not None:
            self.receive(data, address, self._transports[number])

    def _note(self, worker: WorkerProcess, kind: Kind, content: bytes) -> None:
        number, code, _ = message_of(content)
        place: Place = (number, code)
        if kind is Kind.RELEASED:
            self._router.release(place, worker.number - 1)
            if self._router.other_at(place, -1) is None:
                self._welcome(place)
            return
        self._welcome(place)
        before = self._router.claim(place, worker.number - 1)
        other = self.workers[before].channel if before is not None else None
        if other is not None:
            other.send(Kind.LEFT, content)
        transport = self._transports[number]
        if isinstance(transport, Udp) and worker.channel is not None:
            # What its client sent before the worker had a socket for it comes first.
            for _ in range(MOST_ROUNDS):
                if not transport.waits:
                    break
                transport.pump(self.receive)
            worker.channel.send(Kind.DIRECT, content)

    def _make_way(self, worker: WorkerProcess, content: bytes) -> None:
        """Let another worker remove its client where one of `worker` is to be; then that one gets its answer.

        Messages in a session from 0x80 on name no key: the other worker would process them for its client.
        """
        number, code, data = message_of(content)
        place: Place = (number, code)
        before = self._router.other_at(place, worker.number - 1)
        self._welcomes[place] = worker.number - 1, data
        other = self.workers[before].channel if before is not None else None
        if other is None:
            self._welcome(place)
        else:
            other.send(Kind.LEFT, message_frame(number, code))

    def _welcome(self, place: Place) -> None:
        """Send the answer that waits for a newcomer, if any; what comes from there then is for its worker."""
        found = self._welcomes.pop(place, None)
        if found is None:
            return
        worker, data = found
        number, code = place
        self._router.admit(place, worker, data[0])
        address = self._books[number].address(code)
        if address is not None:
            self._transports[number].send(data, address)


def _not_started(number: int, why: str, hint: str) -> Diagnostic:
    return Diagnostic(f"worker {number} does not start{why}", hint=hint, id="MG-9841")


def _ignore(_value: object) -> None:
    """Do nothing."""
