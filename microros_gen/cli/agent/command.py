# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent`: connects XRCE clients to ROS 2."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from microros_gen.agent.configuration.model import (
    CanChoice,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.early_signals import EarlySignals
from microros_gen.agent.transport.sockets import PROTOCOLS, Protocol
from microros_gen.agent.transport.tcp import TcpLimits
from microros_gen.cli.agent.compatible import translated
from microros_gen.cli.agent.devices import devices_of
from microros_gen.cli.agent.options import AgentOptions, common_options
from microros_gen.cli.agent.replay import replay
from microros_gen.cli.agent.status import status_command
from microros_gen.diagnostics import nearest
from microros_gen.records import dataclass


@dataclass(frozen=True)
class _Part:
    """What one transport's command said: its transports, and the options that hold for the whole agent."""

    transports: tuple[TransportChoice, ...]
    common: dict[str, Any]


class _Transports(click.Group):
    """Several transports in one command; a wrong name gets the nearest one."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        return super().parse_args(ctx, translated(args))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        _check_alone(ctx, args)
        if args and not args[0].startswith("-") and args[0] not in self.commands:
            both = [
                name for name in self.commands if name.rstrip("46") == args[0].rstrip("0123456789").lower()
            ]
            found = f"Choose {' or '.join(both)}" if len(both) > 1 else nearest(args[0], self.commands)
            hint = found or f"Available: {', '.join(self.commands)}"
            raise click.UsageError(f"unknown transport '{args[0]}'. {hint}", ctx)
        return super().resolve_command(ctx, args)


_ALONE = {
    "status": "asks a running agent and starts none",
    "replay": "plays a recording and starts no agent",
}
"""Commands that take neither a transport nor an option of an agent, and why."""
_NAMED = "microros_gen.agent.named"
"""Place in the context of the command for the words that were read as transports."""


def _check_alone(ctx: click.Context, args: list[str]) -> None:
    named = ctx.meta.setdefault(_NAMED, [])
    named.append(args[0] if args else "")
    options = [name for name in ctx.params if ctx.get_parameter_source(name) is ParameterSource.COMMANDLINE]
    alone = next((name for name in named if name in _ALONE), None)
    if alone is None or (len(named) == 1 and not options):
        return
    other = next((name for name in named if name != alone), None)
    what = f"'{other}'" if other else f"--{(options or [alone])[0].replace('_', '-')}"
    raise click.UsageError(f"'{alone}' {_ALONE[alone]}: remove {what}", ctx)


@click.group(
    cls=_Transports,
    chain=True,
    invoke_without_command=True,
    subcommand_metavar="TRANSPORT [OPTIONS] [TRANSPORT [OPTIONS]]…",
)
@common_options
def command(**common: Any) -> None:
    """Connect DDS-XRCE clients (this project's, micro-ROS's, any other) to ROS 2.

    Name one or more transports, or none with a --config that names them. Every option below can also follow a
    transport; it applies to the whole agent. Needs ROS 2 Jazzy, sourced or in this Python environment: pip install
    ros-jazzy-rclpy ros-jazzy-rmw-fastrtps-cpp ros-jazzy-common-interfaces.

    The protocol has no authentication and no encryption: everyone who can reach the port can publish. The agent
    therefore listens on the loopback address by default; use --bind only for trusted networks.

    \b
    microros-gen agent udp4 --port 8888
    microros-gen agent udp4 tcp4 --port 8889 serial --device /dev/ttyUSB0 --device /dev/ttyUSB1
    microros-gen agent udp4 --bind 0.0.0.0 --discovery
    microros-gen agent pty --link /tmp/board
    microros-gen agent --config agent.yaml -v

    Prints 'agent ready: TRANSPORT ADDRESS' on stdout for each transport that accepts clients (with --log-format json
    the event 'ready'). The log goes to stderr. SIGINT and SIGTERM end it with status 0, after all of its nodes have
    left the ROS graph. Status 2: invalid usage or input, a port in use, or no ROS 2.
    """


@command.result_callback()
def _start(parts: list[_Part], **common: Any) -> None:
    transports = tuple(choice for part in parts for choice in part.transports)
    signals = EarlySignals()
    with signals.noted():
        from microros_gen.cli.agent.start import serve

        serve(AgentOptions.of([common, *(part.common for part in parts)], transports), signals)


def _socket_command(protocol: Protocol) -> None:
    """Add the command of a UDP or TCP transport."""
    what = f"{protocol.title} over {protocol.version}"
    limits = (
        click.option(
            "--max-connections",
            type=click.IntRange(1, 65535),
            default=TcpLimits.connections,
            show_default=True,
            help="Maximum number of connections; a further one replaces a silent one or is refused.",
        ),
    )

    @click.option(
        "-p",
        "--port",
        type=click.IntRange(0, 65535),
        default=SocketChoice.port,
        show_default=True,
        help=f"{protocol.title} port; 0 selects a free one.",
    )
    @click.option(
        "--bind",
        default=protocol.loopback,
        show_default=True,
        metavar="ADDRESS",
        help=f"Local {protocol.version} address to listen on; {protocol.everywhere} for all, which serves boards in the"
        " network.",
    )
    def run(port: int, bind: str, max_connections: int | None = None, **common: Any) -> _Part:
        chosen = (("connections", max_connections),) if max_connections is not None else ()
        return _Part((SocketChoice(protocol.name, port, bind, chosen),), common)

    run.__doc__ = f"""Serve clients over {what}.

    \b
    microros-gen agent {protocol.name} --port 8888
    microros-gen agent {protocol.name} --bind {protocol.everywhere} --client-timeout 10 -v
    """
    decorated: Callable[..., Any] = common_options(run)
    for option in limits if protocol.stream else ():
        decorated = option(decorated)
    command.command(protocol.name, short_help=f"Serve clients over {what}.")(decorated)


for _protocol in PROTOCOLS.values():
    _socket_command(_protocol)


def _baud(function: Callable[..., Any]) -> Callable[..., Any]:
    return click.option(
        "-b",
        "--baud",
        "--baudrate",
        "baud",
        type=click.IntRange(min=1),
        default=SerialChoice.baud,
        show_default=True,
        metavar="N",
        help="Speed in bit/s; 8 data bits, no parity, 1 stop bit, no flow control. The bytes of a pseudo-terminal do"
        " not wait for it.",
    )(function)


_file = click.option(
    "-f",
    "--file",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="File with the paths of devices, one a line.",
)


@command.command()
@click.option(
    "-D",
    "--device",
    "--dev",
    "devices",
    multiple=True,
    metavar="PATH",
    help="Serial device, such as /dev/ttyUSB0, /dev/ttyACM0 or /dev/pts/3. Can be repeated.",
)
@_file
@_baud
@common_options
def serial(devices: tuple[str, ...], file: Path | None, baud: int, **common: Any) -> _Part:
    """Serve clients on serial lines: boards at a UART or USB, images in an emulator.

    The agent waits for a device that does not exist yet or was unplugged; its clients continue when it is back. No
    other process can use an open device. Several clients can share a line if each has its own source address in its
    frames. Bytes between frames (such as the output of a boot loader) are counted and ignored. Status 2: a path is
    not a serial device, is in use, cannot be opened or does not support the speed; or no ROS 2.

    \b
    microros-gen agent serial --device /dev/ttyUSB0
    microros-gen agent serial --device /dev/ttyACM0 --device /dev/ttyACM1 --baud 921600
    microros-gen agent serial --device /dev/ttyACM0 serial --device /dev/ttyS1 --baud 9600
    """
    return _lines(devices, file, baud, common)


@command.command()
@click.option(
    "-D",
    "--devs",
    "devices",
    metavar="PATHS",
    help="Serial devices in one argument, separated by spaces.",
)
@_file
@_baud
@common_options
def multiserial(devices: str | None, file: Path | None, baud: int, **common: Any) -> _Part:
    """Serve clients on several serial lines, named as for micro_ros_agent; otherwise like serial.

    \b
    microros-gen agent multiserial --devs "/dev/ttyACM0 /dev/ttyACM1" -b 921600
    microros-gen agent multiserial --file devices.txt
    """
    return _lines(tuple((devices or "").split()), file, baud, common)


def _lines(devices: tuple[str, ...], file: Path | None, baud: int, common: dict[str, Any]) -> _Part:
    return _Part(tuple(SerialChoice(device, baud) for device in devices_of(devices, file)), common)


@command.command()
@click.option(
    "-D",
    "--device",
    "--dev",
    "devices",
    multiple=True,
    required=True,
    metavar="NAME",
    help="Network interface with CAN FD, such as can0 or vcan0; or unix:PATH, a socket (SOCK_SEQPACKET) of a program"
    " that plays the bus. Can be repeated.",
)
@common_options
def canfd(devices: tuple[str, ...], **common: Any) -> _Part:
    """Serve clients on CAN FD buses.

    Each client of a bus has its own identifier, in its application file; the agent answers with the same. Frames are
    those of the public client and agent: extended identifiers, up to 63 bytes of message. The agent waits for an
    interface that does not exist yet or is down. Status 2: a device cannot be opened, or no ROS 2.

    \b
    ip link set can0 up type can bitrate 500000 dbitrate 2000000 fd on
    microros-gen agent canfd --device can0
    """
    return _Part(tuple(CanChoice(device) for device in devices), common)


@command.command(short_help="Record every message; transports follow.")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    required=True,
    metavar="FILE",
    help="File (pcapng); an existing one is replaced.",
)
@common_options
def record(output: Path, **common: Any) -> _Part:
    """Run an agent that records every message, as --record FILE does; transports follow.

    Wireshark, tshark and tcpdump read the file, and `agent replay` plays it. Each message is a UDP datagram there, with
    its time in nanoseconds and its direction; comments say keys and nodes of clients. The file is complete up to the
    last message at any time. If it cannot grow, the agent continues, and says how many messages are missing.

    \b
    microros-gen agent record -o failure.pcapng udp4 --port 8888
    microros-gen agent record -o failure.pcapng --config agent.yaml
    """
    return _Part((), {**common, "record": output})


@command.command()
@click.option(
    "--link",
    type=click.Path(),
    metavar="PATH",
    help="Create a symbolic link to the pseudo-terminal, so that its name is known in advance; removed at the end.",
)
@_baud
@common_options
def pty(link: str | None, baud: int, **common: Any) -> _Part:
    """Create a pseudo-terminal and serve the clients that open it as their serial device.

    The client opens the path in the ready line. The path stays the same while clients come and go.

    \b
    microros-gen agent pty
    microros-gen agent pty --link /tmp/board
    """
    return _Part((PtyChoice(link, baud),), common)


command.add_command(pty, "pseudoterminal")  # its name in micro_ros_agent
command.add_command(replay)
command.add_command(status_command, "status")
