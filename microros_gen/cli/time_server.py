# SPDX-License-Identifier: Apache-2.0
"""`microros-gen time-server`: the time of a simulation."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import click

from microros_gen.diagnostics import Diagnostic
from microros_gen.time_server.clock import FASTEST, LATEST_S, NS_PER_S, SLOWEST, SimulatedClock

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer


def time_peer(domain: int | None) -> Peer:
    """Return the node of a time server; UserError without a usable ROS 2."""
    from microros_gen.cli.ros_node import node_of
    from microros_gen.time_server.server import NODE

    return node_of(
        NODE,
        domain,
        lambda error: Diagnostic(f"the time server {error.reason}", hint=error.hint, id="MG-9732"),
    )


@click.command()
@click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)
@click.option(
    "--rate",
    type=click.FloatRange(0.1, 1000),
    metavar="HZ",
    default=100.0,
    help="Messages in a second of the system's time. Default: 100.",
)
@click.option(
    "--speed",
    type=click.FloatRange(SLOWEST, FASTEST),
    metavar="FACTOR",
    default=1.0,
    help="Seconds of the simulation in a second. Default: 1.",
)
@click.option(
    "--start",
    type=click.FloatRange(0, LATEST_S),
    metavar="SECONDS",
    default=0.0,
    help="The first time. Default: 0.",
)
@click.option("--paused", is_flag=True, help="Stand still at first.")
def command(domain: int | None, rate: float, speed: float, start: float, paused: bool) -> None:
    """Publish /clock for nodes with use_sim_time and for firmware with `clock: ros`.

    The node /microros_time has the parameters paused, speed and time, which any node and `microros-gen param set`
    can change: the time stands still, runs faster or slower, and jumps forward or back. It is published also while it
    stands still, so that nodes that start later get it. One server per domain. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen time-server --speed 0.5
    microros-gen param set /microros_time paused true
    microros-gen param set /microros_time time 12.5

    Prints 'time server ready: /microros_time' on stdout. SIGINT and SIGTERM end it with status 0.
    """
    from microros_gen.agent.server import stopped_by_signals
    from microros_gen.time_server.server import TimeServer

    clock = SimulatedClock(time.monotonic_ns, round(start * NS_PER_S), speed, paused)
    with time_peer(domain) as peer:
        server = TimeServer(peer, clock, rate, lambda line: click.echo(f"warning: {line}", err=True))
        with stopped_by_signals(server):
            click.echo(f"time server ready: {peer.name}")
            server.run()
