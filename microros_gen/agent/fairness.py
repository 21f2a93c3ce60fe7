# SPDX-License-Identifier: Apache-2.0
"""Who is served next: of those that have something to do, whoever cost least lately; and for how long at most.

The agent has one thread. What a client makes it do is measured in seconds of that thread, waiting for ROS 2 included,
and charged to the client's account, where it fades: after `MEMORY_S` a third of it is left. So a client that asks for
less than its share is served before all who ask for more, whatever the number and size of their messages; what it did
not use for long is not its own; and while nobody else wants anything, one client has all of it.

What was refused counts `REFUSED` times: many clients that mostly ask for what they do not get have little of the agent,
and do not make the share small that each of the others has. Who is new has `START_S` on its account, so that nobody
comes before all others by coming again and again.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import exp
from typing import Protocol, TypeVar

MEMORY_S = 0.25
"""Seconds after which about a third of what a client cost still counts."""
START_S = 0.02
"""What counts as the cost of a client that nobody knew."""
REFUSED = 8
"""How often it counts what was refused in the end."""
TURN_S = 0.004
"""Seconds for all clients of one descriptor, and of one round, before what else there is gets its turn."""


@dataclass(eq=False, slots=True)
class Account:
    """What one client, or all senders without a session together, cost."""

    used: float = 0.0
    """Seconds of work lately, as of `used_at`."""
    used_at: float = 0.0
    refused: bool = False
    """What is done now is refused."""
    busy: bool = False
    """Its client has work that was begun and goes on by itself: no further messages are read meanwhile."""
    graph_s: float = 0.0
    """Seconds that changes of the ROS graph took lately (see `graph_work`)."""
    graph_at: float = 0.0
    """When that was counted last."""

    def bill(self, seconds: float, now: float) -> None:
        """Charge the time since the last call up to `now`, in seconds."""
        if self.refused:
            self.refused = False
            seconds *= REFUSED
        self.fade(now)
        self.used += seconds

    def fade(self, now: float) -> None:
        """Reduce the cost by its age."""
        if now > self.used_at:
            self.used *= exp((self.used_at - now) / MEMORY_S)
            self.used_at = now


class Billed(Protocol):
    """Work that is done for the owner of an account."""

    @property
    def account(self) -> Account:
        """The account that is charged."""


B = TypeVar("B", bound=Billed)


class Fairness:
    """The order of one agent's work."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock

    def order(self, items: list[B]) -> None:
        """Sort pending work: the account with the lowest recent cost first."""
        now = self._clock()
        for item in items:
            item.account.fade(now)
        if len(items) > 1:
            items.sort(key=_used)


class Accounts:
    """Accounts by key, kept after the client has left, so that reconnecting does not help; at most `limit`."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._limit = limit
        self._clock = clock
        self._by_key: dict[bytes, Account] = {}

    def of(self, key: bytes) -> Account:
        """Return the account of a key."""
        account = self._by_key.pop(key, None) or Account(START_S, self._clock())
        self._by_key[key] = account
        if len(self._by_key) > self._limit:
            del self._by_key[next(iter(self._by_key))]
        return account


def _used(item: Billed) -> float:
    return item.account.used
