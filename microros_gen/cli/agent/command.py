# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent`: connects XRCE clients to ROS 2."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from microros_gen.agent.configuration.model import PtyChoice, SerialChoice, SocketChoice, TransportChoice
from microros_gen.agent.transport.sockets import PROTOCOLS, Protocol
from microros_gen.agent.transport.tcp import TcpLimits
from microros_gen.cli.agent.options import AgentOptions, common_options
from microros_gen.cli.agent.start import serve
from microros_gen.diagnostics import nearest
from microros_gen.records import dataclass


@dataclass(frozen=True)
class _Part:
    """What one transport's command said: its transports, and the options that hold for the whole agent."""

    transports: tuple[TransportChoice, ...]
    common: dict[str, Any]


class _Transports(click.Group):
    """Several transports in one command; a wrong name gets the nearest one."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and not args[0].startswith("-") and args[0] not in self.commands:
            both = [
                name for name in self.commands if name.rstrip("46") == args[0].rstrip("0123456789").lower()
            ]
            found = f"Choose {' or '.join(both)}" if len(both) > 1 else nearest(args[0], self.commands)
            hint = found or f"Available: {', '.join(self.commands)}"
            raise click.UsageError(f"unknown transport '{args[0]}'. {hint}", ctx)
        return super().resolve_command(ctx, args)


@click.group(
    cls=_Transports,
    chain=True,
    invoke_without_command=True,
    subcommand_metavar="TRANSPORT [OPTIONS] [TRANSPORT [OPTIONS]]…",
)
@common_options
def command(**common: Any) -> None:
    """Connect DDS-XRCE clients (this project's, micro-ROS's, any other) to ROS 2.

    Name one transport or several; or none, with a --config that does. Every option below may follow a transport
    as well, and holds for the whole agent. Needs ROS 2 Jazzy, sourced or in this Python: pip install
    ros-jazzy-rclpy ros-jazzy-rmw-fastrtps-cpp ros-jazzy-common-interfaces.

    The protocol has no authentication and no encryption: whoever reaches the port can publish. So the agent
    listens on the loopback address unless --bind says otherwise; open it to trusted networks only.

    \b
    microros-gen agent udp4 --port 8888
    microros-gen agent udp4 tcp4 --port 8889 serial --device /dev/ttyUSB0 --device /dev/ttyUSB1
    microros-gen agent udp4 --bind 0.0.0.0 --discovery
    microros-gen agent pty --link /tmp/board
    microros-gen agent --config agent.yaml -v

    Prints 'agent ready: TRANSPORT ADDRESS' on stdout for each transport once its clients are served (with --log-format
    json the event 'ready'); the log goes to stderr. SIGINT and SIGTERM end it with status 0, after all its nodes have
    left the ROS graph. Status 2: wrong use or input, a port in use, or ROS 2 is missing.
    """


@command.result_callback()
def _start(parts: list[_Part], **common: Any) -> None:
    transports = tuple(choice for part in parts for choice in part.transports)
    serve(AgentOptions.of([common, *(part.common for part in parts)], transports))


def _socket_command(protocol: Protocol) -> None:
    """Add the command of a UDP or TCP transport."""
    what = f"{protocol.title} over {protocol.version}"
    limits = (
        click.option(
            "--max-connections",
            type=click.IntRange(1, 65535),
            default=TcpLimits.connections,
            show_default=True,
            help="One more takes the place of a silent one, or is refused.",
        ),
    )

    @click.option(
        "--port",
        type=click.IntRange(0, 65535),
        default=SocketChoice.port,
        show_default=True,
        help=f"{protocol.title} port; 0: a free one.",
    )
    @click.option(
        "--bind",
        default=protocol.loopback,
        show_default=True,
        metavar="ADDRESS",
        help=f"Own {protocol.version} address to listen on; {protocol.everywhere} for all, so that boards in the"
        " network are served.",
    )
    def run(port: int, bind: str, max_connections: int | None = None, **common: Any) -> _Part:
        chosen = (("connections", max_connections),) if max_connections is not None else ()
        return _Part((SocketChoice(protocol.name, port, bind, chosen),), common)

    run.__doc__ = f"""Serve clients that speak {what}.

    \b
    microros-gen agent {protocol.name} --port 8888
    microros-gen agent {protocol.name} --bind {protocol.everywhere} --client-timeout 10 -v
    """
    decorated: Callable[..., Any] = common_options(run)
    for option in limits if protocol.stream else ():
        decorated = option(decorated)
    command.command(protocol.name, short_help=f"Clients that speak {what}.")(decorated)


for _protocol in PROTOCOLS.values():
    _socket_command(_protocol)


@command.command()
@click.option(
    "--device",
    "--dev",
    "devices",
    multiple=True,
    required=True,
    metavar="PATH",
    help="Serial device, as /dev/ttyUSB0, /dev/ttyACM0 or /dev/pts/3. May be repeated.",
)
@click.option(
    "--baud",
    type=click.IntRange(min=1),
    default=SerialChoice.baud,
    show_default=True,
    metavar="N",
    help="Speed of all of them in bit/s; 8 data bits, no parity, 1 stop bit, no flow control."
    " A pseudo-terminal ignores it.",
)
@common_options
def serial(devices: tuple[str, ...], baud: int, **common: Any) -> _Part:
    """Serve clients on serial lines: boards at a UART or USB, images in an emulator.

    A device that is not there yet, or is unplugged, is waited for; its clients go on when it is back. Each device is
    this process only. Several clients may share a line if each has its own source address in its
    frames. What is between frames (the messages of a boot loader) is counted and ignored.
    Status 2: a path is not a serial device, is in use, may not be opened, or has no such speed; or ROS 2 is missing.

    \b
    microros-gen agent serial --device /dev/ttyUSB0
    microros-gen agent serial --device /dev/ttyACM0 --device /dev/ttyACM1 --baud 921600
    microros-gen agent serial --device /dev/ttyACM0 serial --device /dev/ttyS1 --baud 9600
    """
    return _Part(tuple(SerialChoice(device, baud) for device in devices), common)


@command.command()
@click.option(
    "--link",
    type=click.Path(),
    metavar="PATH",
    help="Make a symbolic link to the pseudo-terminal, so that its name is known before; it goes with the agent.",
)
@common_options
def pty(link: str | None, **common: Any) -> _Part:
    """Make a pseudo-terminal and serve the clients that open it as their serial device.

    The path in the ready line is what the client opens. It stays the same, whichever clients come and go.

    \b
    microros-gen agent pty
    microros-gen agent pty --link /tmp/board
    """
    return _Part((PtyChoice(link),), common)
