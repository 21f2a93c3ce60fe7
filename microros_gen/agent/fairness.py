# SPDX-License-Identifier: Apache-2.0
"""The order of work: of all clients with pending work, the one with the lowest recent cost is served first.

The agent has one thread. The time that this thread spends on a client, waiting for ROS 2 included and for a processor
not (see `own_time`), is charged to the client's account in seconds and decays: after `MEMORY_S` a third of it is left.
A client that needs less than its share is therefore served before all that need more, whatever the number and size of
their messages. Unused time is not saved up for long, and a client that is alone gets the whole agent.

Refused work counts `REFUSED` times, so many clients whose requests are mostly refused get little of the agent and leave
the others their share. A new account starts with `START_S`, so reconnecting does not help.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import exp
from typing import Final, Protocol, TypeVar

from microros_gen.agent.own_time import OwnTime
from microros_gen.agent.rates import WorkRate

MEMORY_S: Final = 0.25
"""Seconds after which about a third of a client's cost is left."""
START_S: Final = 0.02
"""Initial cost of an unknown client, in seconds."""
REFUSED: Final = 8
"""Factor for work that was refused in the end."""
FADE_S: Final = 0.0005
"""Seconds for which a cost is not reduced between two charges: a five-hundredth of MEMORY_S, 0.2 % of the cost."""
TURN_S: Final = 0.004
"""Maximum seconds for the clients of one descriptor, and for one round, before other work gets its turn."""


@dataclass(eq=False, slots=True)
class Account:
    """The cost of one client, or of all senders without a session together."""

    used: float = 0.0
    """Recent cost in seconds, as of `used_at`."""
    used_at: float = 0.0
    refused: bool = False
    """Whether the current work is refused."""
    busy: bool = False
    """Whether its client has unfinished work that continues by itself; meanwhile none of its messages are read."""
    graph_s: float = 0.0
    """Recent cost of changes of the ROS graph, in seconds (see `graph_work`)."""
    graph_at: float = 0.0
    """When that cost was last updated."""
    work: WorkRate | None = None
    """The time that the policy allows for it."""
    dropped: bool = False
    """Whether the current message is dropped because that time is used up; it does not count then."""
    second: float = 0.0
    """End of the second in which `messages` are counted: over all sessions, so reconnecting does not help."""
    messages: int = 0

    def bill(self, seconds: float, now: float) -> None:
        """Charge `seconds` of work that ended at `now`."""
        if self.work is not None and not self.dropped:
            self.work.charge(seconds, now)
        self.dropped = False
        if self.refused:
            self.refused = False
            seconds *= REFUSED
        if now > self.used_at + FADE_S:
            self.fade(now)
        self.used += seconds

    def fade(self, now: float) -> None:
        """Reduce the cost by its age."""
        if now > self.used_at:
            self.used *= exp((self.used_at - now) / MEMORY_S)
            self.used_at = now


class Billed(Protocol):
    """Work for the owner of an account."""

    @property
    def account(self) -> Account:
        """The account that is charged."""


B = TypeVar("B", bound=Billed)


class Fairness:
    """The order of one agent's work, by cost."""

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, waited: Callable[[], float] | None = None
    ) -> None:
        """Charge no time that `waited` counts: that in which other programs had the processor (see OwnTime)."""
        self._clock = clock
        own = OwnTime(waited or float)
        self.begin, self.own = own.begin, own.of
        """See OwnTime."""

    def order(self, items: list[B]) -> None:
        """Sort pending work: the account with the lowest recent cost first."""
        now = self._clock()
        for item in items:
            item.account.fade(now)
        if len(items) > 1:
            items.sort(key=_used)


class Accounts:
    """Accounts by client key, at most `limit`. They outlast the client's session, so reconnecting does not help."""

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
