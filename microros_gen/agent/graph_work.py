# SPDX-License-Identifier: Apache-2.0
"""How much of the agent's time goes into changes of the ROS graph: nodes and endpoints that come and go.

They cost much more than samples, here and at every other participant of the graph. All clients together have so many
milliseconds of a second; what was not used may be used later, up to `BURST_S` seconds of it. A client may change the
graph while more is left than it took itself in the last `MEMORY_S` seconds. So those who took most wait first, who
begins is served at once while others flood, and one alone never gets more than half. What may come at once is spread:
the other participants have to follow, and what they do for others waits meanwhile.
"""

from __future__ import annotations

from math import exp

from microros_gen.agent.fairness import Account

BURST_S = 3.0
"""Seconds whose work may come at once."""
PEAK, PEAK_S, LIGHT_S = 1.5, 0.25, 0.05
"""How fast it may come: so many times the share, after what the share has in `PEAK_S` seconds; who took less than what
it has in `LIGHT_S` is not held up by that."""
MEMORY_S = 6.0
"""Seconds after which about a third of what a client took still counts."""


MOST_S = 0.5
"""One change counts at most what the share has in so many seconds: on a slow machine, where a node alone may take more
than the share of a second, who has few entities gets them within the second that clients wait."""


class GraphWork:
    """Remaining time for changes."""

    def __init__(self, ms_per_second: float) -> None:
        self._share = ms_per_second / 1000
        self._most = self._left = self._share * BURST_S
        self._most_now = self._left_now = self._share * PEAK_S
        self._at = 0.0

    def allows(self, account: Account, now: float) -> bool:
        """Return whether a client may change the graph at `now`."""
        self._refill(now)
        took = _fade(account, now)
        return self._left > 0 and self._left >= took and (self._left_now > 0 or took < self._share * LIGHT_S)

    def charge(self, account: Account, seconds: float, now: float) -> None:
        """Charge a change to a client, in seconds."""
        self._refill(now)
        seconds = min(seconds, self._share * MOST_S)
        self._left -= seconds
        self._left_now -= seconds
        account.graph_s = _fade(account, now) + seconds

    def _refill(self, now: float) -> None:
        refill = max(0.0, now - self._at) * self._share
        self._left = min(self._most, self._left + refill)
        self._left_now = min(self._most_now, self._left_now + PEAK * refill)
        self._at = now


def _fade(account: Account, now: float) -> float:
    if now > account.graph_at:
        account.graph_s *= exp((account.graph_at - now) / MEMORY_S)
        account.graph_at = now
    return account.graph_s
