# SPDX-License-Identifier: Apache-2.0
"""The contents of the agent's configuration file. Paths are as written, relative to the file's folder."""

from __future__ import annotations

from dataclasses import field

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class SocketChoice:
    """A UDP or TCP transport: `kind` is udp4, udp6, tcp4 or tcp6; `port` is 0 to 65,535.

    Without `bind` it listens on the loopback address. `limits` are those of TCP connections, by name.
    """

    kind: str
    port: int = 8888
    bind: str | None = None
    limits: tuple[tuple[str, float], ...] = ()
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class SerialChoice:
    """A serial device and its speed in bit/s."""

    device: str
    baud: int = 115_200
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class PtyChoice:
    """A pseudo-terminal, the path of the symbolic link that points to it, and the speed in bit/s that it shows."""

    link: str | None = None
    baud: int = 115_200
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class CanChoice:
    """A CAN FD bus: a network interface such as can0, or unix:PATH, a socket of a program that plays the bus."""

    device: str
    span: Span | None = field(default=None, compare=False, repr=False)


TransportChoice = SocketChoice | SerialChoice | PtyChoice | CanChoice


@dataclass(frozen=True)
class NamedPath:
    """A path or address as written, and its position in the file."""

    path: str
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class AgentFile:
    """All contents of the file; keys that are not set are None, False or empty.

    `discovery` is a UDP port. `limits` are those of the agent (microros_gen.agent.limits), by name.
    """

    transports: tuple[TransportChoice, ...] = ()
    discovery: int | None = None
    domain: int | None = None
    graph_server: bool = False
    client_state: bool = False
    diagnostics: bool = False
    status_socket: str | None = None
    metrics: NamedPath | None = None
    page: NamedPath | None = None
    parameter_server: bool = True
    parameter_file: str | None = None
    limits: tuple[tuple[str, float], ...] = ()
    workers: int | None = None
    references: tuple[NamedPath, ...] = ()
    entities: tuple[NamedPath, ...] = ()
    policy: NamedPath | None = None
    psk_file: NamedPath | None = None
    manifests: tuple[NamedPath, ...] = ()
    interface_paths: tuple[NamedPath, ...] = ()
    record: NamedPath | None = None
    log_format: str | None = None
    verbose: int | None = None
