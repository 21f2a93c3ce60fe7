# SPDX-License-Identifier: Apache-2.0
"""Reports the agent's state to a service manager (sd_notify(3), sd_watchdog_enabled(3)); does nothing without one."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Mapping


def is_service(environ: Mapping[str, str] = os.environ) -> bool:
    """Return whether a service manager started this process and receives its state."""
    return bool(environ.get("NOTIFY_SOCKET"))


def notify(state: str, environ: Mapping[str, str] = os.environ) -> None:
    """Send `state`, such as `READY=1`, to the socket that NOTIFY_SOCKET names; errors are ignored."""
    place = environ.get("NOTIFY_SOCKET", "")
    if not place.startswith(("/", "@")):
        return
    if place.startswith("@"):
        place = "\0" + place[1:]
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) as channel:
            channel.sendto(state.encode(), place)
    except OSError:
        return


def watchdog(
    environ: Mapping[str, str] = os.environ, send: Callable[[str], None] = notify
) -> Callable[[float], None]:
    """Return a function for the main loop that sends `WATCHDOG=1` when a half of WATCHDOG_USEC is over.

    It takes the time in seconds. It does nothing without that variable, with a malformed one, or if WATCHDOG_PID names
    another process.
    """
    period_us, process = environ.get("WATCHDOG_USEC", ""), environ.get("WATCHDOG_PID", "")
    if not period_us.isdecimal() or int(period_us) == 0 or process not in ("", str(os.getpid())):
        return unwatched
    return _Watchdog(int(period_us) / 2e6, send).care


class _Watchdog:
    def __init__(self, period_s: float, send: Callable[[str], None]) -> None:
        self._period_s = period_s
        self._send = send
        self._due = 0.0

    def care(self, now: float) -> None:
        if now >= self._due:
            self._due = now + self._period_s
            self._send("WATCHDOG=1")


def unwatched(_now: float) -> None:
    """Tell nobody that the main loop runs: no service manager watches it."""
