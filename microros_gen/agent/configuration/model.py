# SPDX-License-Identifier: Apache-2.0
"""What a configuration file of the agent says. Paths are as written; whoever reads the file knows its folder."""

from __future__ import annotations

from dataclasses import field

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class SocketChoice:
    """A UDP or TCP transport: `kind` is udp4, udp6, tcp4 or tcp6; without `bind` it listens on the loopback address.

    `limits` are those of TCP connections, by name.
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
    """A pseudo-terminal, and the symbolic link to make to it."""

    link: str | None = None
    span: Span | None = field(default=None, compare=False, repr=False)


TransportChoice = SocketChoice | SerialChoice | PtyChoice


@dataclass(frozen=True)
class NamedPath:
    """A path as written, and where."""

    path: str
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class AgentFile:
    """Everything that the file may say; None and empty: nothing was said.

    `discovery` is a port. `limits` are those of the agent (microros_gen.agent.limits), by name.
    """

    transports: tuple[TransportChoice, ...] = ()
    discovery: int | None = None
    domain: int | None = None
    graph_server: bool = False
    limits: tuple[tuple[str, float], ...] = ()
    references: tuple[NamedPath, ...] = ()
    entities: tuple[NamedPath, ...] = ()
    manifests: tuple[NamedPath, ...] = ()
    interface_paths: tuple[NamedPath, ...] = ()
    log_format: str | None = None
    verbose: int | None = None
