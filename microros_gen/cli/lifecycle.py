# SPDX-License-Identifier: Apache-2.0
"""`microros-gen lifecycle`: the nodes with a life cycle."""

from __future__ import annotations

from typing import Any

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.ros_tools import graph_options, node_options, on_graph
from microros_gen.diagnostics import Diagnostic, UserError, nearest


@click.group(cls=CommandGroup)
def command() -> None:
    """List nodes with a life cycle, show and change their state, as `ros2 lifecycle` does.

    Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen lifecycle nodes
    microros-gen lifecycle get /arm
    microros-gen lifecycle set /arm activate
    """


@command.command("nodes")
@click.option("-a", "--all", "hidden", is_flag=True, help="Also nodes whose name begins with `_`.")
@click.option("-c", "--count-nodes", is_flag=True, help="Print the number of nodes only.")
@graph_options
def nodes_command(hidden: bool, count_nodes: bool, **graph: Any) -> None:
    """List the nodes that have a life cycle.

    \b
    microros-gen lifecycle nodes
    """
    from microros_gen.ros_tools.lifecycle import lifecycle_nodes

    with on_graph(**graph) as (_, discovery):
        nodes = lifecycle_nodes(discovery.services(hidden))
    click.echo(len(nodes) if count_nodes else "".join(f"{name}\n" for name in nodes), nl=count_nodes)


@command.command("get")
@click.argument("node", required=False)
@click.option("--include-hidden-nodes", is_flag=True, help="Also nodes whose name begins with `_`.")
@graph_options
def get_command(node: str | None, include_hidden_nodes: bool, **graph: Any) -> int:
    """Show the state of a node, or of all nodes.

    \b
    microros-gen lifecycle get /arm
    """
    from microros_gen.ros.errors import RosError
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.lifecycle import NodeLifecycle, lifecycle_nodes

    status = 0
    with on_graph(**graph) as (peer, discovery):
        if node is not None:
            discovery.require_node(absolute(node))
            label, number = NodeLifecycle(peer, absolute(node)).state()
            click.echo(f"{label} [{number}]")
            return 0
        for name in lifecycle_nodes(discovery.services(include_hidden_nodes)):
            try:
                label, number = NodeLifecycle(peer, name).state()
                click.echo(f"{name}: {label} [{number}]")
            except RosError as error:
                click.echo(f"{name}: {error}", err=True)
                status = 1
    return status


@command.command("list")
@click.argument("node")
@click.option("-a", "--all", "all_states", is_flag=True, help="The transitions from all states.")
@node_options
def list_command(node: str, all_states: bool, **graph: Any) -> None:
    """List the transitions that a node has in its state, or in all states.

    \b
    microros-gen lifecycle list /arm
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.lifecycle import NodeLifecycle

    with on_graph(**graph) as (peer, discovery):
        discovery.require_node(absolute(node))
        transitions = NodeLifecycle(peer, absolute(node)).transitions(all_states)
    for found in transitions:
        transition = found["transition"]
        click.echo(
            f"- {transition['label']} [{transition['id']}]\n"
            f"\tStart: {found['start_state']['label']}\n\tGoal: {found['goal_state']['label']}"
        )


@command.command("set")
@click.argument("node")
@click.argument("transition")
@node_options
def set_command(node: str, transition: str, **graph: Any) -> int:
    """Trigger a transition of a node, by its label or number.

    \b
    microros-gen lifecycle set /arm activate
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.lifecycle import NodeLifecycle

    with on_graph(**graph) as (peer, discovery):
        discovery.require_node(absolute(node))
        lifecycle = NodeLifecycle(peer, absolute(node))
        available = [found["transition"] for found in lifecycle.transitions()]
        chosen = next((t for t in available if transition in (t["label"], str(t["id"]))), None)
        if chosen is None:
            labels = [found["label"] for found in available]
            hint = nearest(transition, labels) or f"Available now: {', '.join(labels) or 'none'}"
            message = f"{absolute(node)} has no transition '{transition}' in its state"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9825")], status=1)
        succeeded = lifecycle.change(chosen)
    if succeeded:
        click.echo("Transitioning successful")
        return 0
    click.echo("Transitioning failed", err=True)
    return 1
