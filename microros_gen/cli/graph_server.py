# SPDX-License-Identifier: Apache-2.0
"""`microros-gen graph-server`: answers the graph queries of firmware."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from microros_gen.diagnostics import Diagnostic

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer


def graph_peer(domain: int | None) -> Peer:
    """Return the node of a graph server; UserError without a usable ROS 2."""
    from microros_gen.cli.ros_node import node_of
    from microros_gen.graph_server.server import NODE

    return node_of(
        NODE,
        domain,
        lambda error: Diagnostic(f"the graph server {error.reason}", hint=error.hint, id="MG-9724"),
    )


@click.command()
@click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)
def command(domain: int | None) -> None:
    """Answer queries of the ROS graph by service, and publish its changes.

    The node /microros_graph has the services list_names and list_endpoints and the topic changes, with types of
    microros_graph_msgs (`microros-gen interfaces microros_graph_msgs/srv/ListNames`). A request states how many
    names of which size the caller has room for, so a board with 2 KB of memory can query one topic in a system of
    500 nodes. One server per domain is enough, on any machine. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen graph-server
    microros-gen graph-server --domain 5

    Prints 'graph server ready: /microros_graph' on stdout. SIGINT and SIGTERM end it with status 0.
    """
    from microros_gen.agent.server import stopped_by_signals
    from microros_gen.graph_server.server import GraphServer

    with graph_peer(domain) as peer:
        server = GraphServer(peer, lambda line: click.echo(f"warning: {line}", err=True))
        with stopped_by_signals(server):
            click.echo(f"graph server ready: {peer.name}")
            server.run()
