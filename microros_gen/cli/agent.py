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
from microros_gen.agent.ros.rclpy_bridge import MAXIMUM_DOMAIN, open_bridge
from microros_gen.agent.server import Server, stopped_by_signals
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.udp4 import Udp4
from microros_gen.diagnostics import Diagnostic, UserError

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
    verbose: int
    log_format: str

    def log(self) -> EventLog:
        """Return the log, on stderr."""
        return EventLog(sys.stderr, self.log_format == "json", self.verbose)

    def serve(self, transports: Sequence[Transport], log: EventLog) -> None:
        """Serve until a signal comes; a ready line for each transport goes to stdout."""
        limits = replace(_DEFAULTS, clients=self.max_clients, client_timeout_s=self.client_timeout)
        try:
            agent = Agent(open_bridge(limits.domains, self.domain), log, limits)
        except UserError:
            for transport in transports:
                transport.close()
            raise
        if self.verbose:
            transports = [TracedTransport(transport, log) for transport in transports]
        server = Server(agent, transports, log)
        announcements = EventLog(sys.stdout, self.log_format == "json")
        with stopped_by_signals(server):
            server.run(lambda transport: _announce(announcements, transport), time.monotonic)


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
    options = _Common(**common)
    options.serve([Udp4(host, port)], options.log())


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
    options = _Common(**common)
    log = options.log()
    module = _serial_module()
    lines: list[Transport] = []
    try:
        for device in dict.fromkeys(devices):
            lines.append(module.serial_line(device, baud, log))
    except UserError:
        for line in lines:
            line.close()
        raise
    options.serve(lines, log)


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
    options = _Common(**common)
    log = options.log()
    options.serve([_serial_module().Pty(log, link)], log)


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
