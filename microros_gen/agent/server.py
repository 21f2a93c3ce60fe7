# SPDX-License-Identifier: Apache-2.0
"""The loop: waits for transports, feeds the agent, ends cleanly on SIGINT and SIGTERM."""

from __future__ import annotations

import selectors
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

from microros_gen.agent.core import Agent
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.base import Transport

TICK_S = 0.05
"""Seconds between two looks at time-outs, and the longest that a signal waits."""


class Server:
    """Serves some transports until it is told to stop."""

    def __init__(self, agent: Agent, transports: Sequence[Transport], log: EventLog) -> None:
        self._agent = agent
        self._transports = transports
        self._log = log
        self._stop = False

    def stop(self) -> None:
        """End `run` soon; may be called from a signal handler or another thread."""
        self._stop = True

    def run(self, ready: Callable[[Transport], None], clock: Callable[[], float]) -> None:
        """Serve; `ready` is called once for each transport, when its messages are taken.

        Afterwards all clients are gone.
        """
        try:
            with selectors.DefaultSelector() as selector:
                watched = [_Watched(transport, selector, ready) for transport in self._transports]
                self._serve(selector, watched, clock)
        finally:
            self._close()

    def _serve(
        self, selector: selectors.BaseSelector, watched: Sequence[_Watched], clock: Callable[[], float]
    ) -> None:
        next_tick = clock()
        while not self._stop:
            for one in watched:  # all first: a descriptor that one gave back may be another's by now
                one.release()
            for one in watched:
                one.watch()
            for key, _ in _select(selector):
                key.data.pump(self._agent.receive)
                self._agent.flush()
            now = clock()
            if now >= next_tick:
                self._agent.tick()
                for transport in self._transports:
                    transport.tick(now)
                next_tick = now + TICK_S

    def _close(self) -> None:
        clients = len(self._agent.clients)
        self._agent.close()
        for transport in self._transports:
            transport.close()
        faults = sum(self._log.counters.values())
        self._log.emit(
            Level.INFO,
            "stopped",
            "agent stopped: {samples} samples, {clients} clients at the end, {faults} faults of input",
            samples=self._agent.samples,
            clients=clients,
            faults=faults,
            **{f"fault_{kind}": count for kind, count in sorted(self._log.counters.items())},
        )


class _Watched:
    """A transport and what the selector knows of it."""

    def __init__(
        self, transport: Transport, selector: selectors.BaseSelector, ready: Callable[[Transport], None]
    ) -> None:
        self._transport = transport
        self._selector = selector
        self._ready = ready
        self._was_ready = False
        self._known = (-1, 0)

    def release(self) -> None:
        """Let the selector forget what is not so any more."""
        if self._known[0] >= 0 and self._known != self._wanted():
            self._selector.unregister(self._known[0])
            self._known = (-1, 0)

    def watch(self) -> None:
        """Tell the selector which descriptor the transport has now, and what is waited for."""
        wanted = self._wanted()
        if wanted[0] < 0 or wanted == self._known:
            return
        self._selector.register(*wanted, self._transport)
        self._known = wanted
        if not self._was_ready:
            self._was_ready = True
            self._ready(self._transport)

    def _wanted(self) -> tuple[int, int]:
        events = selectors.EVENT_READ | (selectors.EVENT_WRITE if self._transport.writing else 0)
        return self._transport.fileno(), events


def _select(selector: selectors.BaseSelector) -> list[tuple[selectors.SelectorKey, int]]:
    if selector.get_map():
        return selector.select(TICK_S)
    time.sleep(TICK_S)  # no transport has a descriptor, and not every selector waits for nothing
    return []


@contextmanager
def stopped_by_signals(server: Server) -> Iterator[None]:
    """Let SIGINT and SIGTERM stop `server` while this lasts."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        server.stop()

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
