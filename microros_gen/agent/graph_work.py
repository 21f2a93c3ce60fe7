# SPDX-License-Identifier: Apache-2.0
"""Limit of the agent's time for changes of the ROS graph: nodes and endpoints that are created and destroyed.

Such changes cost much more than samples, here and at every other participant of the graph. All clients together get a
share of each second in milliseconds; unused time can be used later, up to `BURST_S` seconds' worth. A client may change
the graph while more time is left than it used itself in the last `MEMORY_S` seconds. Clients that used most therefore
wait first, a new client is served at once while others flood the agent, and a single client never gets more than half.
Bursts are spread over time, because the other participants have to process each change as well.
"""

from __future__ import annotations

from math import exp

from microros_gen.agent.fairness import Account

BURST_S = 3.0
"""Seconds whose share may be used in one burst."""
PEAK, PEAK_S, LIGHT_S = 1.5, 0.25, 0.05
"""Maximum rate in a burst, as a multiple of the share, after the share of `PEAK_S` seconds.

A client that used less than the share of `LIGHT_S` seconds is exempt."""
MEMORY_S = 6.0
"""Seconds after which about a third of a client's use is left."""


MOST_S = 0.5
"""Maximum cost of one change: the share of so many seconds.

On a slow machine, where a node may take more than the share of a second, a client with few entities still gets them
within the second that clients wait."""


class GraphWork:
    """The remaining time for changes, in seconds."""

    def __init__(self, ms_per_second: float) -> None:
        self._share = ms_per_second / 1000
        self._most = self._left = self._share * BURST_S
        self._most_now = self._left_now = self._share * PEAK_S
        self._at = 0.0

    def allows(self, account: Account, now: float) -> bool:
        """Return whether a client may change the graph at `now`."""
        self._refill(now)
        recent_s = _fade(account, now)
        return (
            self._left > 0
            and self._left >= recent_s
            and (self._left_now > 0 or recent_s < self._share * LIGHT_S)
        )

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
