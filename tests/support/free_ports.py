# SPDX-License-Identifier: Apache-2.0
"""Ports that a program of a test opens later.

Linux gives ports from `ip_local_port_range` (at most 60,999) to sockets without one, and tests run side by side: by the
time the program is compiled, a socket of DDS may have such a port. The ports from here on are in neither that range nor
that of a ROS domain that tests use.
"""

from __future__ import annotations

import random
import socket
from contextlib import ExitStack

_FIRST, _LAST = 61_000, 65_535


def free_ports(count: int, family: int = socket.AF_INET, kind: int = socket.SOCK_DGRAM) -> list[int]:
    """Return different ports that no socket has now."""
    with ExitStack() as stack:
        return [_hold(stack.enter_context(socket.socket(family, kind))) for _ in range(count)]


def free_port(kind: int = socket.SOCK_DGRAM) -> int:
    """Return a port that no socket of IPv4 has now."""
    return free_ports(1, kind=kind)[0]


def _hold(probe: socket.socket) -> int:
    for port in random.sample(range(_FIRST, _LAST + 1), 100):
        try:
            probe.bind(("", port))
        except OSError:
            continue
        return port
    raise AssertionError("no port is free")
