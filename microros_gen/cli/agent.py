# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent`: connects XRCE clients to ROS 2."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click

from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import References
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.agent.ros.rclpy_bridge import MAXIMUM_DOMAIN, open_bridge
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.agent.server import Server, stopped_by_signals
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.sockets import UDP4
from microros_gen.agent.transport.udp import Udp
from microros_gen.cli.type_hashes import type_hashes
from microros_gen.diagnostics import Diagnostic, Diagnostics, Source, UserError
from microros_gen.parse.preconfigured import parse_preconfigured

_DEFAULTS = Limits()


@click.group()
def command() -> None:
    """Connect DDS-XRCE clients (this project's, micro-ROS's, any other) to ROS 2.

    Needs rclpy: pip install 'microros-gen[ros]', or a sourced ROS 2 installation.

    The protocol has no authentication and no encryption: whoever reaches the port can publish. So the agent
    listens on the loopback address unless --bind says otherwise; open it to trusted networks only.

    \b
    microros-gen agent udp4 --port 8888
    microros-gen agent serial --dev /dev/ttyUSB0 --baud 115200
    microros-gen agent pty --link /tmp/board
    microros-gen agent udp4 --references build/x/agent/references.xml
    microros-gen agent serial --dev /dev/ttyUSB0 --entities build/y/agent/entities.json
    """


_COMMON = (
    click.option(
        "--domain",
        type=click.IntRange(0, MAXIMUM_DOMAIN),
        help="Put every client into this ROS domain. Default: the one that the client asks for.",
    ),
    click.option(
        "--client-timeout",
        type=click.FloatRange(min=0.1),
        default=_DEFAULTS.client_timeout_s,
        show_default=True,
        metavar="SECONDS",
        help="A client that is not heard for this long leaves the ROS graph; when it is heard again, its nodes"
        " and publishers return. Before that it is asked for a sign of life.",
    ),
    click.option(
        "--max-clients",
        type=click.IntRange(1, 65535),
        default=_DEFAULTS.clients,
        show_default=True,
        help="Further clients are refused.",
    ),
    click.option(
        "--references",
        multiple=True,
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="XML profiles that clients name instead of describing their entities, as the public agent takes them"
        " with -r; `build` writes OUT/agent/references.xml. May be given several times.",
    ),
    click.option(
        "--entities",
        multiple=True,
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Entities (JSON) to make for clients that create none, when they open their session; `build` writes"
        " OUT/agent/entities.json. May be given several times.",
    ),
    click.option(
        "--interface-path",
        "interface_paths",
        multiple=True,
        type=click.Path(path_type=Path),
        metavar="DIR",
        help="Interface files of the clients' types: a package, a folder of packages or a colcon workspace; searched"
        " before ament, pip and the shipped set. Any type is bridged; with its file, its type hash is announced too.",
    ),
    click.option(
        "-v",
        "--verbose",
        count=True,
        help="-v: a line for each message; -vv: each message decoded and in hexadecimal.",
    ),
    click.option(
        "--log-format",
        type=click.Choice(["text", "json"]),
        default="text",
        show_default=True,
        help="Log for people, or one JSON object a line.",
    ),
)


@dataclass(frozen=True)
class _Common:
    """What every transport's command takes; the names are those of the options."""

    domain: int | None
    client_timeout: float
    max_clients: int
    references: tuple[Path, ...]
    entities: tuple[Path, ...]
    interface_paths: tuple[Path, ...]
    verbose: int
    log_format: str

    def serve(self, open_transports: Callable[[EventLog], Sequence[Transport]]) -> None:
        """Serve until a signal comes; a ready line for each transport goes to stdout. Files are read first."""
        limits = replace(_DEFAULTS, clients=self.max_clients, client_timeout_s=self.client_timeout)
        references, preconfigured = self._files()
        hashes = type_hashes(self.interface_paths)
        log = EventLog(sys.stderr, self.log_format == "json", self.verbose)
        transports = open_transports(log)
        try:
            bridge = open_bridge(limits.domains, self.domain, hashes, graph_reporter(log))
        except UserError:
            for transport in transports:
                transport.close()
            raise
        agent = Agent(bridge, log, limits, references, preconfigured)
        if self.verbose:
            transports = [TracedTransport(transport, log) for transport in transports]
        server = Server(agent, transports, log)
        announcements = EventLog(sys.stdout, self.log_format == "json")
        with stopped_by_signals(server):
            server.run(lambda transport: _announce(announcements, transport), time.monotonic)

    def _files(self) -> tuple[References, Preconfigured]:
        """Return what the files say; UserError with the faults of all of them."""
        diagnostics = Diagnostics()
        references, preconfigured = References(), Preconfigured()
        profiles, entities = (_read(paths, diagnostics) for paths in (self.references, self.entities))
        try:
            references = read_references(profiles)
        except UserError as error:
            diagnostics.extend(error.diagnostics)
        try:
            preconfigured = Preconfigured(parse_preconfigured(entities, diagnostics))
        except UserError as error:
            diagnostics.extend(error.diagnostics)
        diagnostics.check()
        return references, preconfigured


def _read(paths: Sequence[Path], diagnostics: Diagnostics) -> list[Source]:
    sources = []
    for path in dict.fromkeys(paths):
        try:
            sources.append(Source(str(path), path.read_text(encoding="utf-8-sig")))
        except OSError as error:
            diagnostics.error(f"{path} cannot be read: {error.strerror}")
        except UnicodeDecodeError as error:
            diagnostics.error(f"{path} is not UTF-8 (byte {error.start})", hint="Save it as UTF-8")
    return sources


def _common(function: Callable[..., None]) -> Callable[..., None]:
    for option in reversed(_COMMON):
        function = option(function)
    return function


@command.command()
@click.option(
    "--port", type=click.IntRange(0, 65535), default=8888, show_default=True, help="UDP port; 0: a free one."
)
@click.option(
    "--bind",
    "host",
    default="127.0.0.1",
    show_default=True,
    metavar="ADDRESS",
    help="Own IPv4 address to listen on; 0.0.0.0 for all, so that boards in the network are served.",
)
@_common
def udp4(port: int, host: str, **common: Any) -> None:
    """Serve clients that send UDP over IPv4.

    Prints 'agent ready: udp4 ADDRESS:PORT' on stdout once clients are served (with --log-format json the
    event 'ready'); the log goes to stderr. SIGINT and SIGTERM end it with status 0, after all its nodes have
    left the ROS graph. Status 2: the port is in use, the address is not of this machine, or rclpy is missing.

    \b
    microros-gen agent udp4 --port 8888
    microros-gen agent udp4 --bind 0.0.0.0 --client-timeout 10 -v
    """
    _Common(**common).serve(lambda _log: [Udp(UDP4, host, port)])


@command.command()
@click.option(
    "--dev",
    "devices",
    multiple=True,
    required=True,
    metavar="PATH",
    help="Serial device, as /dev/ttyUSB0, /dev/ttyACM0 or /dev/pts/3. May be given several times.",
)
@click.option(
    "--baud",
    type=click.IntRange(min=1),
    default=115_200,
    show_default=True,
    metavar="N",
    help="Speed of all of them in bit/s; 8 data bits, no parity, 1 stop bit, no flow control."
    " A pseudo-terminal ignores it.",
)
@_common
def serial(devices: tuple[str, ...], baud: int, **common: Any) -> None:
    """Serve clients on serial lines: boards at a UART or USB, images in an emulator.

    Prints 'agent ready: serial PATH' on stdout once the clients of a device are served; the log goes to
    stderr. A device that is not there yet, or is unplugged, is waited for; its clients go on when it is back. Each
    device is this process's alone. Several clients may share a line if each has a source address of its own in its
    frames. What is between frames (the messages of a boot loader) is counted and ignored. Ends as udp4 does.
    Status 2: a path is no serial device, is in use, may not be opened, or has no such speed; or rclpy is missing.

    \b
    microros-gen agent serial --dev /dev/ttyUSB0
    microros-gen agent serial --dev /dev/ttyACM0 --dev /dev/ttyACM1 --baud 921600
    """
    module = _serial_module()

    def open_lines(log: EventLog) -> Sequence[Transport]:
        lines: list[Transport] = []
        try:
            for device in dict.fromkeys(devices):
                lines.append(module.serial_line(device, baud, log))
        except UserError:
            for line in lines:
                line.close()
            raise
        return lines

    _Common(**common).serve(open_lines)


@command.command()
@click.option(
    "--link",
    type=click.Path(path_type=Path),
    metavar="PATH",
    help="Make a symbolic link to the pseudo-terminal, so that its name is known before; it goes with the agent.",
)
@_common
def pty(link: Path | None, **common: Any) -> None:
    """Make a pseudo-terminal and serve the clients that open it as their serial device.

    Prints 'agent ready: serial PATH' on stdout; PATH is what the client opens. It stays the same, whichever clients
    come and go. The log goes to stderr. Ends as udp4 does.

    \b
    microros-gen agent pty
    microros-gen agent pty --link /tmp/board
    """
    module = _serial_module()
    _Common(**common).serve(lambda log: [module.Pty(log, link)])


def _serial_module() -> Any:
    if os.name != "posix":
        raise UserError(
            [
                Diagnostic(
                    "serial lines need Linux, macOS or another POSIX system",
                    hint="Under Windows run the agent in WSL 2 and hand the device on to it (usbipd attach --wsl)",
                )
            ]
        )
    from microros_gen.agent.transport import serial as module

    return module


def _announce(announcements: EventLog, transport: Transport) -> None:
    kind, _, address = transport.label.partition(" ")
    text = "agent ready: {transport} {address}"
    announcements.emit(Level.INFO, "ready", text, transport=kind, address=address)
