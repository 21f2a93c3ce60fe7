# SPDX-License-Identifier: Apache-2.0
"""Times of the session: what the application says, and what follows from the round trip where it says nothing."""

from __future__ import annotations

from microros_gen.application.model import SessionTimes
from microros_gen.records import dataclass

ROUND_TRIP_MS = 100
RETRY_MAX_MS, RETRY_MAX_ROUND_TRIPS = 4000, 2
PERIOD_MS, PERIOD_ROUND_TRIPS = 1000, 4
SILENCE_MS, SILENCE_ROUND_TRIPS = 3000, 12
CALL_MS, CALL_ROUND_TRIPS = 1000, 10
CLOSE_MS, CLOSE_ROUND_TRIPS = 300, 3
"""Each is the time at least, and so many round trips."""
ATTEMPTS = 3
"""Questions of `liveliness: ping` until the session is lost."""

LINE_BITS_PER_BYTE = 10
FRAME_BYTES = 7
"""Around a message on a serial line."""


@dataclass(frozen=True)
class TimesPlan:
    """Milliseconds. `liveliness_wait_ms`: for the answer to each of `liveliness_attempts` questions."""

    retry_first_ms: int = ROUND_TRIP_MS
    retry_most_ms: int = RETRY_MAX_MS
    heartbeat_period_ms: int = ROUND_TRIP_MS
    liveliness_period_ms: int = PERIOD_MS
    liveliness_wait_ms: int = SILENCE_MS // ATTEMPTS
    liveliness_attempts: int = ATTEMPTS
    connect_timeout_ms: int = CALL_MS
    create_timeout_ms: int = CALL_MS
    close_timeout_ms: int = CLOSE_MS


def plan_times(settings: SessionTimes, baud: int | None, sent: int, received: int) -> TimesPlan:
    """Return the times of a session. `baud`: of its serial line, or None; `sent`, `received`: its largest messages."""
    first = settings.round_trip or max(ROUND_TRIP_MS, _line_ms(baud, sent + received))

    def of(configured: int | None, least: int, round_trips: int) -> int:
        return configured if configured is not None else max(least, round_trips * first)

    silence = of(settings.liveliness_timeout, SILENCE_MS, SILENCE_ROUND_TRIPS)
    return TimesPlan(
        retry_first_ms=first,
        retry_most_ms=max(first, of(settings.retry_max, RETRY_MAX_MS, RETRY_MAX_ROUND_TRIPS)),
        heartbeat_period_ms=settings.heartbeat or first,
        liveliness_period_ms=of(settings.liveliness_period, PERIOD_MS, PERIOD_ROUND_TRIPS),
        liveliness_wait_ms=silence // ATTEMPTS,
        connect_timeout_ms=of(settings.connect_timeout, CALL_MS, CALL_ROUND_TRIPS),
        create_timeout_ms=of(settings.create_timeout, CALL_MS, CALL_ROUND_TRIPS),
        close_timeout_ms=of(settings.close_timeout, CLOSE_MS, CLOSE_ROUND_TRIPS),
    )


def _line_ms(baud: int | None, messages: int) -> int:
    """Return how long the largest messages need on a line, one each way; rounded up to ten milliseconds."""
    if baud is None:
        return 0
    bits = (messages + 2 * FRAME_BYTES) * LINE_BITS_PER_BYTE
    return -(-bits * 100 // baud) * 10
