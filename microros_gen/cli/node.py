# SPDX-License-Identifier: Apache-2.0
"""`microros-gen node`: the nodes of a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.ros_tools import graph_options, on_graph

if TYPE_CHECKING:
    from microros_gen.ros.graph import Names


@click.group(cls=CommandGroup)
def command() -> None:
    """List nodes and show what they have, as `ros2 node` does. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen node list
    microros-gen node info /imu
    """


@command.command("list")
@click.option("-a", "--all", "hidden", is_flag=True, help="Also nodes whose name begins with `_`.")
@click.option("-c", "--count-nodes", is_flag=True, help="Print the number of nodes only.")
@graph_options
def list_command(hidden: bool, count_nodes: bool, **graph: Any) -> None:
    """List the nodes.

    \b
    microros-gen node list
    """
    with on_graph(**graph) as (_, discovery):
        nodes = discovery.nodes(hidden)
    if count_nodes:
        click.echo(len(nodes))
        return
    if len(set(nodes)) < len(nodes):
        click.echo("WARNING: several nodes share a name, which can have unintended effects", err=True)
    click.echo("".join(f"{name}\n" for name in nodes), nl=False)


@command.command("info")
@click.argument("node")
@click.option("--include-hidden", is_flag=True, help="Also topics, services and actions that are hidden.")
@graph_options
def info_command(node: str, include_hidden: bool, **graph: Any) -> None:
    """Show the topics, services and actions of a node.

    \b
    microros-gen node info /imu
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.graph_data import node_view

    name = absolute(node)
    with on_graph(**graph) as (_, discovery):
        discovery.require_node(name)
        discovery.settle()
        if discovery.graph.nodes().count(name) > 1:
            click.echo(f"WARNING: several nodes are named {name}: this is one of them", err=True)
        view = node_view(discovery.graph, name)
    shown = view.shown(include_hidden)
    click.echo(name)
    for title, names in (
        ("Subscribers", shown.subscriptions),
        ("Publishers", shown.publishers),
        ("Service Servers", shown.service_servers),
        ("Service Clients", shown.service_clients),
        ("Action Servers", view.action_servers),
        ("Action Clients", view.action_clients),
    ):
        click.echo(f"  {title}:\n{_lines(names)}")


def _lines(names: Names) -> str:
    return "\n".join(f"    {name}: {', '.join(types)}" for name, types in names)
