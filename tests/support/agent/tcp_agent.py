# SPDX-License-Identifier: Apache-2.0
"""An agent after a TCP port, in this process."""

from __future__ import annotations

import time

from microros_gen.agent.transport.sockets import TCP4, Protocol
from microros_gen.agent.transport.tcp import Connection, Tcp, TcpLimits
from tests.support.agent.fakes import Bench
from tests.support.patience import deadline


def tcp(bench: Bench, protocol: Protocol = TCP4, **limits: float) -> Tcp:
    return Tcp(protocol, protocol.loopback, 0, bench.log, TcpLimits(**limits))  # type: ignore[arg-type]


def _received(transport: Tcp) -> list[Connection]:
    """Let `transport` take what was received; return the connections that messages came from."""
    found: list[Connection] = []
    end = deadline(3)
    while not found and time.monotonic() < end:
        transport.pump(lambda _data, address, _transport: found.append(address))  # type: ignore[arg-type]
    return found
