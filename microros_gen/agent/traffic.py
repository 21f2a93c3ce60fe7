# SPDX-License-Identifier: Apache-2.0
"""The messages between a client and the agent: counts, and rates that are measured once a second."""

from __future__ import annotations

from microros_gen.agent.clients import Client
from microros_gen.records import dataclass

Counts = tuple[int, int, int, int]
"""Messages and bytes from a client, then messages and bytes to it."""


@dataclass(frozen=True)
class Direction:
    """The messages of one direction: DDS-XRCE messages with their headers, without the framing of the transport."""

    messages: int = 0
    bytes: int = 0
    messages_per_s: float = 0.0
    bytes_per_s: float = 0.0


class Meter:
    """Rates of the last interval between two measurements, per second."""

    def __init__(self) -> None:
        self._at: float | None = None
        self._counts: Counts = (0, 0, 0, 0)
        self.rates = (0.0, 0.0, 0.0, 0.0)

    def measure(self, counts: Counts, now: float) -> None:
        """End an interval at `now` (seconds of a monotonic clock); the first call only begins one."""
        if self._at is not None and now > self._at:
            if counts == self._counts:
                self.rates = (0.0, 0.0, 0.0, 0.0)
            else:
                a, b, c, d = counts
                e, f, g, h = self._counts
                per = 1.0 / (now - self._at)
                self.rates = ((a - e) * per, (b - f) * per, (c - g) * per, (d - h) * per)
        self._at, self._counts = now, counts


def counts_of(client: Client) -> Counts:
    """Return the counts of one client."""
    return client.received, client.received_bytes, client.sent, client.sent_bytes
