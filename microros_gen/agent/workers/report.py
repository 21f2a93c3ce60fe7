# SPDX-License-Identifier: Apache-2.0
"""What workers report, and one view of it: that of an agent with one process."""

from __future__ import annotations

import pickle
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import field, replace

from microros_gen.agent.states import ClientState, Presence
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Report:
    """What a worker has done since it started, and its view of its clients, if it was asked for."""

    samples: int = 0
    delivered: int = 0
    faults: dict[str, int] = field(default_factory=dict)
    clients: tuple[ClientState, ...] | None = None
    connected: int = 0
    """Number of its clients."""

    def encode(self) -> bytes:
        """Return it for the channel. Both sides are the same program of the same user."""
        return pickle.dumps(self)

    @staticmethod
    def decode(content: bytes) -> Report:
        """Return what `encode` was called for."""
        report: Report = pickle.loads(content)
        return report


class Totals:
    """The counts of all workers, also of those that have ended."""

    def __init__(self) -> None:
        self.samples = 0
        self.delivered = 0
        self.faults: Counter[str] = Counter()

    def add(self, report: Report) -> None:
        """Add the counts of a worker."""
        self.samples += report.samples
        self.delivered += report.delivered
        self.faults.update(report.faults)


class Orphans:
    """The last known states of clients whose worker ended, until another one knows them.

    They are `most` at most, and each is forgotten after `expire_s` seconds of silence.
    """

    def __init__(self, most: int, expire_s: float) -> None:
        self._most = most
        self._expire_s = expire_s
        self._states: dict[str, tuple[ClientState, float]] = {}

    def add(self, states: Iterable[ClientState], worker: int, now: float) -> None:
        """Take the clients of a worker that ended at `now` (seconds, monotonic)."""
        for state in states:
            if state.presence in (Presence.CONNECTED, Presence.SILENT):
                left = replace(state, presence=Presence.SILENT, last_error=f"worker {worker} ended")
                self._states[state.key] = left, now
        while len(self._states) > self._most:
            del self._states[next(iter(self._states))]

    def with_those_of(self, workers: Sequence[Iterable[ClientState]], now: float) -> tuple[ClientState, ...]:
        """Return the clients of all workers, each once, and those that no worker has."""
        known = [state for states in workers for state in states]
        for state in known:
            self._states.pop(state.key, None)
        orphans = [
            replace(state, silent_s=state.silent_s + now - since) for state, since in self._states.values()
        ]
        for state in orphans:
            if state.silent_s > self._expire_s:
                del self._states[state.key]
        return (*known, *(state for state in orphans if state.key in self._states))
