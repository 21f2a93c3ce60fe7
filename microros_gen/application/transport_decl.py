# SPDX-License-Identifier: Apache-2.0
"""The transport of an application, as data."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Transport:
    """How the firmware reaches its agent. `mtu`: largest datagram or frame payload, bytes; None: planned.

    `type_span` None and `type` udp: the application does not say, so a profile's or the target's choice holds.
    `device` and `baud` are the serial line's; `framing` None: a custom transport chooses at run time;
    `read_polls`: its read function returns at once with a time-out of 0.
    `send_buffer`: bytes that wait for a serial line; None: planned. `discover`: the agent is to be found by
    multicast to this port; None: `host` and `port` say where it is, or, where `agent_span` is None too, the
    selection decides. `agents`: address and port of each of several, of which `host` and `port` are the first; or none.
    `devices`: likewise the serial device of each of several, of which `device` is the first.
    `seal`: who has the cryptography of sealed messages, psa or application; empty: they are not sealed.
    `can_device`, `can_id` and `bitrate` are those of CAN FD; None: not said, and an identifier has no default.
    """

    type: str = "udp"
    host: str = "127.0.0.1"
    port: int = 8888
    mtu: int | None = None
    span: Span | None = None
    mtu_span: Span | None = None
    type_span: Span | None = None
    agent_span: Span | None = None
    device: str = "/dev/ttyUSB0"
    baud: int = 115_200
    framing: bool | None = None
    read_polls: bool = False
    discover: int | None = None
    send_buffer: int | None = None
    agents: tuple[tuple[str, int], ...] = ()
    devices: tuple[str, ...] = ()
    can_device: str = "can0"
    can_id: int | None = None
    bitrate: int | None = None
    seal: str = ""
