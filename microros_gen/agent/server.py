# SPDX-License-Identifier: Apache-2.0
"""The main loop: waits for transports and ROS 2, calls the agent, and ends cleanly on SIGINT and SIGTERM.

One thread and one epoll descriptor (Linux; a transport with several descriptors nests its own in it, as ROS 2 does). A
round reads a batch from each readable transport, takes data from ROS 2, and sends due acknowledgements. Descriptors are
registered once, so that a round costs one system call and a question to the agent when it is due.
"""

from __future__ import annotations

import os
import select
import signal
from collections import deque
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence, Sized
from contextlib import contextmanager
from functools import partial
from types import FrameType
from typing import Protocol

from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.readiness import unwatched
from microros_gen.agent.transport.base import Transport

TICK_S = 0.1
"""Seconds between two calls of the transports' `tick`: for missing devices and silent connections."""

Ready = Callable[[Transport], None]


class Served(Protocol):
    """What the loop serves: an agent, or the front of its workers. See `Agent` for the methods."""

    @property
    def clients(self) -> Sized:
        """The clients."""

    @property
    def samples(self) -> int:
        """Number of samples from clients."""

    @property
    def delivered(self) -> int:
        """Number of samples to clients."""

    def fileno(self) -> int:
        """Return the descriptor that is readable when `take` has something to do."""

    def due(self) -> float | None:
        """Return when `tick` is due."""

    def receive(self, data: bytes, address: Hashable, transport: Transport) -> None:
        """Process a message."""

    def take(self) -> None:
        """Do what the descriptor is readable for."""

    def tick(self) -> None:
        """Do what is due."""

    def care(self, now: float) -> None:
        """Look after everything; called some ten times a second."""

    def flush(self) -> None:
        """Send what was collected."""

    def close(self) -> None:
        """End in order."""


class Server:
    """A server of several transports that runs until `stop`.

    It calls `alive` with the time about every TICK_S while its loop runs.
    """

    def __init__(
        self,
        agent: Served,
        transports: Sequence[Transport],
        log: EventLog,
        alive: Callable[[float], None] = unwatched,
    ) -> None:
        self._agent = agent
        self._transports = transports
        self._log = log
        self._alive = alive
        self._waiting = list(transports)
        self._stop = False
        self._calls: deque[Callable[[], object]] = deque()
        # Open as long as this object: a signal may come after the end of `run`.
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)

    def __del__(self) -> None:
        os.close(self._wake)

    def stop(self) -> None:
        """End `run` at once; may be called from a signal handler or another thread."""
        self._stop = True
        os.eventfd_write(self._wake, 1)

    @property
    def stops(self) -> bool:
        """Whether `stop` was called."""
        return self._stop

    def soon(self, do: Callable[[], object]) -> None:
        """Call `do` in `run`, between two messages; may be called from a signal handler or another thread."""
        self._calls.append(do)
        os.eventfd_write(self._wake, 1)

    def run(self, ready: Ready, clock: Callable[[], float]) -> None:
        """Serve clients until `stop`; call `ready` for each transport once it accepts messages.

        Afterwards all clients are removed.
        """
        try:
            with select.epoll() as epoll:
                self._serve(epoll, ready, clock)
        finally:
            self._close()

    def _serve(self, epoll: select.epoll, ready: Ready, clock: Callable[[], float]) -> None:
        handlers = self._register(epoll)
        poll, due = epoll.poll, self._agent.due
        flush_all = [self._agent.flush, *(transport.flush for transport in self._transports)]
        care_at = clock()
        while not self._stop:
            now = clock()
            cares = now >= care_at
            if cares:
                care_at = now + TICK_S
                self._care(now, ready)
            wanted = due()
            if wanted is not None and wanted <= now:
                self._agent.tick()
                cares = True
            if cares:  # what this sends does not wait for input
                for flush in flush_all:
                    flush()
                wanted = due()
            wait = (care_at if wanted is None or wanted > care_at else wanted) - now
            for descriptor, _ in poll(wait if wait > 0 else 0):
                handlers[descriptor]()
            for flush in flush_all:
                flush()

    def _register(self, epoll: select.epoll) -> dict[int, Callable[[], object]]:
        """Watch every descriptor; return the function to call when one is readable."""
        handlers: dict[int, Callable[[], object]] = {self._wake: self._noted}
        for transport in self._transports:
            handlers[transport.fileno()] = partial(transport.pump, self._agent.receive)
        handlers[self._agent.fileno()] = self._agent.take
        for descriptor in handlers:
            epoll.register(descriptor, select.EPOLLIN)
        return handlers

    def _noted(self) -> None:
        """Do what `soon` got; if it is to end, the descriptor stays readable."""
        if not self._stop:
            os.eventfd_read(self._wake)
        while self._calls:
            self._calls.popleft()()

    def _care(self, now: float, ready: Ready) -> None:
        self._alive(now)
        self._agent.care(now)
        for transport in self._transports:
            transport.tick(now)
        if self._waiting:
            now_ready = [transport for transport in self._waiting if transport.ready]
            self._waiting = [transport for transport in self._waiting if transport not in now_ready]
            for transport in now_ready:
                ready(transport)

    def _close(self) -> None:
        clients = len(self._agent.clients)
        self._agent.close()
        for transport in self._transports:
            transport.close()
        self._log.finish()
        faults = sum(self._log.counters.values())
        self._log.emit(
            Level.INFO,
            "stopped",
            "agent stopped: {samples} samples in, {delivered} out, {clients} clients, {faults} faults of input",
            samples=self._agent.samples,
            delivered=self._agent.delivered,
            clients=clients,
            faults=faults,
            **{f"fault_{kind}": count for kind, count in sorted(self._log.counters.items())},
        )


@contextmanager
def reloaded_by_signal(server: Server, reloads: Iterable[Callable[[], object] | None]) -> Iterator[None]:
    """Let SIGHUP call all of `reloads` in the loop of `server` within the context; without any it does what it did."""
    wanted = [reload for reload in reloads if reload is not None]
    if not wanted:
        yield
        return

    def reload_all(_number: int, _frame: FrameType | None) -> None:
        for reload in wanted:
            server.soon(reload)

    before = signal.signal(signal.SIGHUP, reload_all)
    try:
        yield
    finally:
        signal.signal(signal.SIGHUP, before)


class Stoppable(Protocol):
    """A program that a signal can stop."""

    def stop(self) -> None:
        """End soon; called from a signal handler."""


@contextmanager
def stopped_by_signals(server: Stoppable) -> Iterator[None]:
    """Let SIGINT and SIGTERM stop `server` within the context."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        server.stop()

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
