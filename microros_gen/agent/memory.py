# SPDX-License-Identifier: Apache-2.0
"""The memory of the agent's process, measured and kept below its limit, independent of the budgets.

Budgets bound the memory that the agent knows of. The measured memory also includes the rest: unread samples in DDS, and
gaps on the heap. Near the limit, no objects are created. Above it, the client with the most memory is removed. Freed
memory is returned to the system, since the C library would keep it.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable
from enum import IntEnum
from pathlib import Path

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.log import EventLog, Level

TIGHT_PART, OVER_PART = 0.75, 0.85
"""Fractions of the limit from which no objects are created, and from which clients are removed."""
FREED_BYTES = 8 << 20
"""Bytes that clients must have freed before memory is returned to the system."""
TRIM_EVERY_S = 2.0
"""Minimum seconds between two such returns, which take milliseconds."""
SETTLE_S = 60.0
"""Seconds for which memory is returned after clients have freed some: DDS frees the history of a writer some time after
the writer is destroyed, and the writers of a client that has left are destroyed one after the other."""
TRIM_PAUSE = 50
"""Times the duration of such a return until the next one without need: clients that come and go all the time would
otherwise let it delay all others every two seconds."""
RELIEVE_EVERY_S = 2 * TRIM_EVERY_S
"""Minimum seconds between two removals of clients."""
UNREAD_BYTES = 4_096
"""Assumed bytes of an unread sample in DDS."""
_STATM = Path("/proc/self/statm")


class Pressure(IntEnum):
    """How close the memory is to its limit."""

    LOW = 0
    TIGHT = 1
    OVER = 2


class MemoryGuard:
    """Watch over the memory of this process, checked some ten times a second."""

    def __init__(
        self,
        limit: int,
        used: Callable[[], int] | None = None,
        trim: Callable[[], object] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Keep memory below `limit` bytes. `used` returns the used bytes, `trim` returns free memory to the system.

        `clock` measures how long `trim` takes.
        """
        self.limit = limit
        self._used = used or resident_bytes
        self._trim = trim or (lambda: None)
        self._clock = clock
        self._trimmed_at = float("-inf")
        self._pause_s = 0.0
        """Seconds until memory is returned again without need."""
        self._most_held = 0
        self._settled_at = float("-inf")

    def look(self, held: int, now: float) -> Pressure:
        """Return the pressure, after returning free memory if that helps; clients hold `held` bytes."""
        self._most_held = max(self._most_held, held)
        if self._most_held - held >= FREED_BYTES:
            self._most_held, self._settled_at = held, now + SETTLE_S
        pressure = self._pressure()
        settles = now < self._settled_at and now >= self._trimmed_at + self._pause_s
        if (pressure or settles) and now >= self._trimmed_at + TRIM_EVERY_S:
            self._trimmed_at, began = now, self._clock()
            self._trim()
            self._pause_s = TRIM_PAUSE * (self._clock() - began)
            pressure = self._pressure()
        return pressure

    def _pressure(self) -> Pressure:
        used = self._used()
        if used < TIGHT_PART * self.limit:
            return Pressure.LOW
        return Pressure.TIGHT if used < OVER_PART * self.limit else Pressure.OVER


def resident_bytes() -> int:
    """Return the resident bytes of this process."""
    return int(_STATM.read_bytes().split()[1]) * os.sysconf("SC_PAGESIZE")


def heaviest(clients: Iterable[Client]) -> Client | None:
    """Return the client with the most memory by estimate, or None without clients."""
    return max(clients, key=weight_of, default=None)


def weight_of(client: Client) -> int:
    """Return the estimated bytes of a client, including its unread samples in DDS."""
    unread = sum(entity.source.unread() for entity in client.objects if entity.source is not None)
    return client.shares.held + client.session.held + UNREAD_BYTES * unread


class Relief:
    """Relief of memory pressure: stops the creation of objects and disconnects the client with the most memory."""

    def __init__(
        self,
        guard: MemoryGuard | None,
        clients: ClientTable,
        budgets: Budgets,
        dismiss: Callable[[Client, str], None],
        log: EventLog,
    ) -> None:
        """Close the gate of `budgets` while no objects may be created; without a guard, do nothing."""
        self._guard = guard
        self._clients = clients
        self._budgets = budgets
        self._gate = budgets.gate
        self._relieved_at = float("-inf")
        self._dismiss = dismiss
        self._log = log

    def look(self, now: float) -> None:
        """Check the memory and act."""
        if self._guard is None:
            return
        pressure = self._guard.look(self._budgets.held, now)
        closed = pressure is not Pressure.LOW
        if closed and not self._gate.closed:
            text = "{limit} bytes of memory are nearly all taken: nothing more is made for clients until some are free"
            self._log.emit(Level.WARNING, "memory_tight", text, limit=self._guard.limit)
        self._gate.closed = closed
        # Entities are destroyed in turns, and free memory returns some time later: until then no other has to go.
        if pressure is Pressure.OVER and now >= self._relieved_at + RELIEVE_EVERY_S:
            self._relieved_at = now
            self._send_away()

    def _send_away(self) -> None:
        client = heaviest(self._clients)
        if client is None:
            return
        text = "client {client} uses most of the agent's memory, at least {bytes} bytes: it is disconnected"
        self._log.emit(Level.WARNING, "memory_relieved", text, client=client.name, bytes=weight_of(client))
        self._dismiss(client, "disconnected: the agent's memory is exhausted")
