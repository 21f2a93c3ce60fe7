# SPDX-License-Identifier: Apache-2.0
"""The memory of the agent's process: held below its limit by what is seen of it, whatever the budgets have counted.

Budgets bound what the agent knows of. What it does not see (samples that nobody reads, in DDS; gaps on the heap) is in
what the system says. Near the limit nothing more is made. Beyond that the client that takes most is sent away; and what
is freed is returned to the system, as the C library keeps it otherwise.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from enum import IntEnum
from pathlib import Path

from microros_gen.agent.budgets import Gate
from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.log import EventLog, Level

TIGHT_PART, OVER_PART = 0.75, 0.85
"""Of the limit: from here on nothing more is made, and from here on clients are sent away."""
FREED_BYTES = 8 << 20
"""When clients gave back so much, the system gets it."""
TRIM_EVERY_S = 2.0
"""Least time between two times that this is done: it takes milliseconds."""
UNREAD_BYTES = 4_096
"""What a sample is taken to have that waits in DDS and that nobody saw."""
_STATM = Path("/proc/self/statm")


class Pressure(IntEnum):
    """How much of the memory is in use."""

    LOW = 0
    TIGHT = 1
    OVER = 2


class MemoryGuard:
    """Checks the memory of this process some ten times a second."""

    def __init__(
        self, limit: int, used: Callable[[], int] | None = None, trim: Callable[[], object] | None = None
    ) -> None:
        """Use `used`, which returns the used bytes, and `trim`, which returns free memory to the system."""
        self.limit = limit
        self._used = used or resident_bytes
        self._trim = trim or (lambda: None)
        self._trimmed_at = float("-inf")
        self._most_held = 0

    def look(self, held: int, now: float) -> Pressure:
        """Return the pressure, after returning free memory where that helps; clients hold `held` bytes."""
        self._most_held = max(self._most_held, held)
        pressure = self._pressure()
        freed = self._most_held - held >= FREED_BYTES
        if (freed or pressure) and now >= self._trimmed_at + TRIM_EVERY_S:
            self._trimmed_at, self._most_held = now, held
            self._trim()
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
    """Return the client with the most memory, by estimate; None without clients."""
    return max(clients, key=weight_of, default=None)


def weight_of(client: Client) -> int:
    """Return the estimated bytes of a client, including its unread samples in DDS."""
    unread = sum(entity.source.unread() for entity in client.objects if entity.source is not None)
    return client.shares.held + client.session.held + UNREAD_BYTES * unread


class Relief:
    """Relieves the memory: stops creating objects, and disconnects the client with the most memory."""

    def __init__(
        self,
        guard: MemoryGuard | None,
        clients: ClientTable,
        gate: Gate,
        dismiss: Callable[[Client, str], None],
        log: EventLog,
    ) -> None:
        """Close `gate` while nothing may be created; without a guard nothing is ever done."""
        self._guard = guard
        self._clients = clients
        self._gate = gate
        self._dismiss = dismiss
        self._log = log

    def look(self, now: float) -> None:
        """Check the memory and act."""
        if self._guard is None:
            return
        pressure = self._guard.look(sum(client.shares.held for client in self._clients), now)
        closed = pressure is not Pressure.LOW
        if closed and not self._gate.closed:
            text = "{limit} bytes of memory are nearly all taken: nothing more is made for clients until some are free"
            self._log.emit(Level.WARNING, "memory_tight", text, limit=self._guard.limit)
        self._gate.closed = closed
        if pressure is Pressure.OVER:
            self._send_away()

    def _send_away(self) -> None:
        client = heaviest(self._clients)
        if client is None:
            return
        text = "client {client} takes most of the agent's memory, {bytes} bytes and more: it is sent away"
        self._log.emit(Level.WARNING, "memory_relieved", text, client=client.name, bytes=weight_of(client))
        self._dismiss(client, "sent away: the agent's memory is taken")
