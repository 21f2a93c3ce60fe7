# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent`: connects XRCE clients to ROS 2."""

from __future__ import annotations

import sys
import time
from dataclasses import replace

import click

from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.ros.rclpy_bridge import MAXIMUM_DOMAIN, open_bridge
from microros_gen.agent.server import Server, stopped_by_signals
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.udp4 import Udp4

_DEFAULTS = Limits()


@click.group()
def command() -> None:
    """Connect DDS-XRCE clients (this project's, micro-ROS's, any other) to ROS 2.

    Needs rclpy: pip install 'microros-gen[ros]', or a sourced ROS 2 installation.

    The protocol has no authentication and no encryption: whoever reaches the port can publish. So the agent
    listens on the loopback address unless --bind says otherwise; open it to trusted networks only.

    \b
    microros-gen agent udp4 --port 8888
    """


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
@click.option(
    "--domain",
    type=click.IntRange(0, MAXIMUM_DOMAIN),
    help="Put every client into this ROS domain. Default: the one that the client asks for.",
)
@click.option(
    "--client-timeout",
    type=click.FloatRange(min=0.1),
    default=_DEFAULTS.client_timeout_s,
    show_default=True,
    metavar="SECONDS",
    help="A client that is not heard for this long leaves the ROS graph; when it is heard again, its nodes"
    " and publishers return. Before that it is asked for a sign of life.",
)
@click.option(
    "--max-clients",
    type=click.IntRange(1, 65535),
    default=_DEFAULTS.clients,
    show_default=True,
    help="Further clients are refused.",
)
@click.option(
    "-v",
    "--verbose",
    count=True,
    help="-v: a line for each message; -vv: each message decoded and in hexadecimal.",
)
@click.option(
    "--log-format",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="Log for people, or one JSON object a line.",
)
def udp4(
    port: int,
    host: str,
    domain: int | None,
    client_timeout: float,
    max_clients: int,
    verbose: int,
    log_format: str,
) -> None:
    """Serve clients that send UDP over IPv4.

    Prints 'agent ready: udp4 ADDRESS:PORT' on stdout once clients are served (with --log-format json the
    event 'ready'); the log goes to stderr. SIGINT and SIGTERM end it with status 0, after all its nodes have
    left the ROS graph. Status 2: the port is in use, the address is not of this machine, or rclpy is missing.

    \b
    microros-gen agent udp4 --port 8888
    microros-gen agent udp4 --bind 0.0.0.0 --client-timeout 10 -v
    """
    log = EventLog(sys.stderr, log_format == "json", verbose)
    limits = replace(_DEFAULTS, clients=max_clients, client_timeout_s=client_timeout)
    transport: Transport = Udp4(host, port)
    if verbose:
        transport = TracedTransport(transport, log)
    agent = Agent(open_bridge(limits.domains, domain), log, limits)
    server = Server(agent, [transport], log)
    announcements = EventLog(sys.stdout, log_format == "json")
    with stopped_by_signals(server):
        server.run(lambda: _announce(announcements, transport), time.monotonic)


def _announce(announcements: EventLog, transport: Transport) -> None:
    kind, _, address = transport.label.partition(" ")
    text = "agent ready: {transport} {address}"
    announcements.emit(Level.INFO, "ready", text, transport=kind, address=address)
