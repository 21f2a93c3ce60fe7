# SPDX-License-Identifier: Apache-2.0
"""Who is served next: of those that have something to do, whoever cost least; and for how long at most.

The agent has one thread. What a client makes it do is measured in seconds of that thread, waiting for ROS 2 included,
and charged to the client's account. Accounts run on a common clock of work (start-time fair queueing): who had nothing
to do for a while begins where the least served one is, with a small credit. So a client that asks for less than its
share is served before all who ask for more, whatever the number and size of their messages; and while nobody else
wants anything, one client has all of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeVar

CREDIT_S = 0.005
"""How far a client that comes with something to do may stand before those that are being served."""
TURN_S = 0.004
"""Seconds for all clients of one descriptor, and of one round, before what else there is gets its turn."""


@dataclass(eq=False, slots=True)
class Account:
    """What one client, or all strangers together, cost."""

    used: float = 0.0
    """Seconds of work, on the common clock."""
    busy: bool = False
    """Its client has work that was begun and goes on by itself: no further messages are read meanwhile."""
    graph_s: float = 0.0
    """Seconds that changes of the ROS graph took lately (see `graph_work`)."""
    graph_at: float = 0.0
    """When that was counted last."""


class Billed(Protocol):
    """Something that is done for the owner of an account."""

    @property
    def account(self) -> Account:
        """Who pays."""


B = TypeVar("B", bound=Billed)


class Fairness:
    """The common clock of work of one agent."""

    def __init__(self) -> None:
        self._floor = 0.0
        """Where the least served one was that had something to do."""

    def order(self, items: list[B]) -> None:
        """Sort what is to be done now: the account that cost least first."""
        least = self._floor - CREDIT_S
        for item in items:
            if item.account.used < least:
                item.account.used = least
        if len(items) > 1:
            items.sort(key=_used)
        if items and items[0].account.used > self._floor:
            self._floor = items[0].account.used


class Accounts:
    """Of each key one, also after its client has gone, so that to come again is no way round; at most `limit`."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._by_key: dict[bytes, Account] = {}

    def of(self, key: bytes) -> Account:
        """Return the account of a key."""
        account = self._by_key.pop(key, None) or Account()
        self._by_key[key] = account
        if len(self._by_key) > self._limit:
            del self._by_key[next(iter(self._by_key))]
        return account


def _used(item: Billed) -> float:
    return item.account.used
