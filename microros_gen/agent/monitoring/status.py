# SPDX-License-Identifier: Apache-2.0
"""The status of an agent at one moment, taken by the agent's thread when another thread asks for it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import field

from microros_gen.agent.states import ClientState
from microros_gen.records import dataclass

FRESH_S = 0.25
"""Seconds for which a status answers further questions."""
WAIT_S = 3.0
"""Seconds after which an agent that has not taken its status does not respond."""


@dataclass(frozen=True)
class TransportState:
    """A transport, as in the ready line, and whether it accepts messages."""

    kind: str
    address: str
    ready: bool


@dataclass(frozen=True)
class WorkerState:
    """A worker process: its number, its process (0: none runs), whether it serves, how often it was started again."""

    number: int
    pid: int
    ready: bool
    restarts: int


@dataclass(frozen=True)
class AgentStatus:
    """An agent and its clients. Counts are those since it started."""

    pid: int
    version: str
    core: str
    """`python` or `compiled` (see `core_kind`)."""
    started: float
    """When it started, in seconds since 1970."""
    now: float
    """When the status was taken, in seconds since 1970."""
    uptime_s: float
    domain: int | None
    """The ROS domain of all clients; None: each client chooses its own."""
    transports: tuple[TransportState, ...]
    clients_max: int
    from_clients: int
    """Number of samples, requests and replies from clients that were passed to ROS 2."""
    to_clients: int
    """Number of samples, requests and replies that were sent to clients."""
    clients: tuple[ClientState, ...]
    faults: Mapping[str, int] = field(default_factory=dict)
    """Number of faults in input by kind, as in the log."""
    workers: tuple[WorkerState, ...] = ()
    """Those of an agent with several processes."""

    @property
    def late(self) -> list[str]:
        """A line for each transport and worker that is not ready."""
        transports = [f"{each.kind} {each.address}" for each in self.transports if not each.ready]
        workers = [f"worker {each.number}" for each in self.workers if not each.ready]
        return [f"{name} is not ready" for name in (*transports, *workers)]


class StatusBoard:
    """Hands the status from the agent's thread to others, at most four times a second."""

    def __init__(
        self, take: Callable[[], AgentStatus | None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`take` is called in the agent's thread, and again later if it returns None.

        `clock` returns seconds of a monotonic clock in any thread.
        """
        self._take = take
        self._clock = clock
        self._changed = threading.Condition()
        self._is_wanted = False
        self._latest: AgentStatus | None = None
        self._taken_at = float("-inf")

    def look(self, _now: float) -> None:
        """Take the status if it is wanted; called in the agent's thread, some ten times a second."""
        if not self._is_wanted:
            return
        status = self._take()
        if status is None:
            return
        self._is_wanted = False
        with self._changed:
            self._latest, self._taken_at = status, self._clock()
            self._changed.notify_all()

    def ask(self, wait_s: float = WAIT_S) -> AgentStatus | None:
        """Return a status that is not older than `FRESH_S`; None: the agent does not respond within `wait_s`."""
        with self._changed:
            fresh_from = self._clock() - FRESH_S
            if self._taken_at < fresh_from:
                self._is_wanted = True
                self._changed.wait_for(lambda: self._taken_at >= fresh_from, wait_s)
            return self._latest if self._taken_at >= fresh_from else None
