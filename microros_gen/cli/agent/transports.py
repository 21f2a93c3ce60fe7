# SPDX-License-Identifier: Apache-2.0
"""Opens the transports of an agent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from microros_gen.agent.configuration.model import (
    CanChoice,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Shared:
    """What the agent and its transports have in common.

    What all hold of messages that are not complete counts in `pool`, what waits to be sent in `output`; `fair` says
    whose turn it is; `strangers` pays for clients without a session.
    """

    pool: InputPool
    output: InputPool
    fair: Fairness
    strangers: Account


def open_transports(
    choices: Sequence[TransportChoice], discovery: int | None, log: EventLog, shared: Shared
) -> list[Transport]:
    """Return open transports, and discovery of them at port `discovery`; UserError names all that fail."""
    opened: list[Transport] = []
    diagnostics = Diagnostics()
    for choice in dict.fromkeys(choices):
        try:
            opened.append(_open(choice, log, shared))
        except UserError as error:
            diagnostics.extend(replace(d, span=d.span or choice.span) for d in error.diagnostics)
    try:
        diagnostics.check()
        if discovery is not None:
            opened.append(_discovery(opened, log, discovery))
    except UserError:
        close_all(opened)
        raise
    return opened


def connections(choices: Sequence[TransportChoice]) -> int:
    """Return how many TCP connections transports may have together."""
    from microros_gen.agent.transport.tcp import TcpLimits

    streams = [c for c in choices if isinstance(c, SocketChoice) and PROTOCOLS[c.kind].stream]
    return sum(int(dict(c.limits).get("connections", TcpLimits.connections)) for c in streams)


def _open(choice: TransportChoice, log: EventLog, shared: Shared) -> Transport:
    from microros_gen.agent.transport.canfd import CanFd
    from microros_gen.agent.transport.serial import Pty, serial_line
    from microros_gen.agent.transport.tcp import Tcp, TcpLimits
    from microros_gen.agent.transport.udp import Udp

    if isinstance(choice, SerialChoice):
        return serial_line(choice.device, choice.baud, log)
    if isinstance(choice, CanChoice):
        return CanFd(choice.device, log)
    if isinstance(choice, PtyChoice):
        return Pty(log, Path(choice.link) if choice.link else None, choice.baud)
    protocol = PROTOCOLS[choice.kind]
    host = choice.bind or protocol.loopback
    if not protocol.stream:
        return Udp(protocol, host, choice.port, shared.fair, shared.strangers)
    limits: dict[str, Any] = dict(choice.limits)
    tcp_limits = replace(TcpLimits(), **limits)
    return Tcp(
        protocol,
        host,
        choice.port,
        log,
        tcp_limits,
        shared.pool,
        shared.output,
        shared.fair,
        shared.strangers,
    )


def _discovery(opened: Sequence[Transport], log: EventLog, port: int) -> Transport:
    from microros_gen.agent.transport.discovery import Discovery
    from microros_gen.agent.transport.tcp import Tcp
    from microros_gen.agent.transport.udp import Udp

    return Discovery([t for t in opened if isinstance(t, Udp | Tcp)], log, port)


def close_all(transports: Sequence[Transport]) -> None:
    """Close transports."""
    for transport in transports:
        transport.close()
