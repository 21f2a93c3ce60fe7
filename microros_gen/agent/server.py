# SPDX-License-Identifier: Apache-2.0
"""The loop: waits for transports, feeds the agent, ends cleanly on SIGINT and SIGTERM."""

from __future__ import annotations

import selectors
import signal
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

    def run(self, ready: Callable[[], None], clock: Callable[[], float]) -> None:
        """Serve; `ready` is called once, when messages are taken. Afterwards all clients are gone."""
        try:
            with selectors.DefaultSelector() as selector:
                for transport in self._transports:
                    selector.register(transport.fileno(), selectors.EVENT_READ, transport)
                ready()
                self._serve(selector, clock)
        finally:
            self._close()

    def _serve(self, selector: selectors.BaseSelector, clock: Callable[[], float]) -> None:
        next_tick = clock()
        while not self._stop:
            for key, _ in selector.select(TICK_S):
                key.data.pump(self._agent.receive)
                self._agent.flush()
            if clock() >= next_tick:
                self._agent.tick()
                next_tick = clock() + TICK_S

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
