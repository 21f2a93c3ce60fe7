# SPDX-License-Identifier: Apache-2.0
"""Signals that come before the agent serves, which takes seconds: they wait until it can do what they mean."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # the server imports all that serves; the command line, which imports this, completes words
    from microros_gen.agent.server import Server

Reloads = Sequence[Callable[[], object] | None]


class EarlySignals:
    """What came so far. A second SIGINT or SIGTERM ends the process at once, should its start hang."""

    def __init__(self) -> None:
        self._stops = False
        self._reloads = False
        self._before: dict[int, Any] = {}

    @property
    def stops(self) -> bool:
        """Whether the agent is to end before it serves."""
        return self._stops

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note SIGINT, SIGTERM and SIGHUP within the context."""
        self._before = {
            signal.SIGINT: signal.signal(signal.SIGINT, self._stop),
            signal.SIGTERM: signal.signal(signal.SIGTERM, self._stop),
            signal.SIGHUP: signal.signal(signal.SIGHUP, self._reload),
        }
        try:
            yield
        finally:
            for number, handler in self._before.items():
                signal.signal(number, handler)

    def nothing_to_reload(self) -> None:
        """Let SIGHUP do what it did before `noted`, also one that came meanwhile: the end, when a terminal closes."""
        signal.signal(signal.SIGHUP, self._before[signal.SIGHUP])
        if self._reloads:
            signal.raise_signal(signal.SIGHUP)

    @contextmanager
    def stopping(self, server: Server) -> Iterator[None]:
        """Let SIGINT and SIGTERM stop `server` within the context, also those that came before."""
        from microros_gen.agent.server import stopped_by_signals

        with stopped_by_signals(server):
            if self._stops:
                server.stop()
            yield

    @contextmanager
    def reloading(self, server: Server, reloads: Reloads) -> Iterator[None]:
        """Let SIGHUP call all of `reloads` in the loop of `server`, also one that came before."""
        from microros_gen.agent.server import reloaded_by_signal

        with reloaded_by_signal(server, reloads):
            if self._reloads:
                signal.raise_signal(signal.SIGHUP)
            yield

    def _stop(self, number: int, _frame: FrameType | None) -> None:
        if self._stops:
            signal.signal(number, self._before[number])
            signal.raise_signal(number)
        self._stops = True

    def _reload(self, _number: int, _frame: FrameType | None) -> None:
        self._reloads = True
