# SPDX-License-Identifier: Apache-2.0
"""`microros-gen action`: the actions of a graph."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.ros_tools import (
    TURN_S,
    graph_options,
    on_graph,
    show,
    stdin_option,
    until_interrupted,
    values_text,
)

if TYPE_CHECKING:
    from microros_gen.ros.graph import Graph, Names
    from microros_gen.ros_tools.actions import Goal


@click.group(cls=CommandGroup)
def command() -> None:
    """List actions and send goals, as `ros2 action` does.

    Types come from interface files, installed or in --interface-path, without a build. Needs ROS 2 Jazzy, like the
    agent.

    \b
    microros-gen action list -t
    microros-gen action send-goal --feedback /fibonacci example_interfaces/action/Fibonacci 'order: 5'
    """


@command.command("list")
@click.option("-t", "--show-types", is_flag=True, help="With the types.")
@click.option("-c", "--count-actions", is_flag=True, help="Print the number of actions only.")
@graph_options
def list_command(show_types: bool, count_actions: bool, **graph: Any) -> None:
    """List the actions.

    \b
    microros-gen action list -t
    """
    from microros_gen.ros_tools.discovery import action_names

    with on_graph(**graph) as (_, discovery):
        actions = action_names(discovery.services(hidden=True))
    if count_actions:
        click.echo(len(actions))
        return
    for name, types in actions:
        click.echo(f"{name} [{', '.join(types)}]" if show_types else name)


@command.command("type")
@click.argument("action")
@graph_options
def type_command(action: str, **graph: Any) -> None:
    """Print the type of an action.

    \b
    microros-gen action type /fibonacci
    """
    from microros_gen.ros_tools.discovery import absolute, action_names, unknown_action

    name = absolute(action)
    with on_graph(**graph) as (_, discovery):
        types = discovery.service_types(f"{name}/_action/send_goal")
        if types is None:
            raise unknown_action(name, dict(action_names(discovery.services(hidden=True))))
    click.echo("\n".join(kind.removesuffix("_SendGoal") for kind in types))


@command.command("info")
@click.argument("action")
@click.option("-t", "--show-types", is_flag=True, help="With the types.")
@click.option("-c", "--count", is_flag=True, help="Print the numbers of clients and servers only.")
@graph_options
def info_command(action: str, show_types: bool, count: bool, **graph: Any) -> None:
    """Show the nodes with clients and servers of an action.

    \b
    microros-gen action info /fibonacci
    """
    from microros_gen.ros_tools.discovery import absolute, action_names, unknown_action

    name = absolute(action)
    with on_graph(**graph) as (_, discovery):
        if discovery.service_types(f"{name}/_action/send_goal") is None:
            known = dict(action_names(discovery.services(hidden=True)))
            raise unknown_action(name, known)
        discovery.settle()
        clients, servers = _ends(discovery.graph, name)
    click.echo(f"Action: {name}")
    for title, nodes in (("clients", clients), ("servers", servers)):
        click.echo(f"Action {title}: {len(nodes)}")
        for node, types in () if count else nodes:
            click.echo(f"    {node} [{', '.join(types)}]" if show_types else f"    {node}")


def _ends(graph: Graph, action: str) -> tuple[Names, Names]:
    """Return the nodes with clients and with servers of an action, with its types there."""
    from microros_gen.ros_tools.graph_data import node_view

    views = [node_view(graph, node) for node in sorted(set(graph.nodes()))]
    clients = tuple(
        (v.name, dict(v.action_clients)[action]) for v in views if action in dict(v.action_clients)
    )
    servers = tuple(
        (v.name, dict(v.action_servers)[action]) for v in views if action in dict(v.action_servers)
    )
    return clients, servers


@click.command()
@click.argument("action")
@click.argument("action_type", metavar="TYPE")
@click.argument("values", metavar="[GOAL]", required=False)
@stdin_option
@click.option("-f", "--feedback", is_flag=True, help="Print the feedback of the goal.")
@graph_options
def send_goal_command(
    action: str, action_type: str, values: str | None, from_stdin: bool, feedback: bool, **graph: Any
) -> int:
    """Send a goal and wait for its result; GOAL is YAML. Ctrl-C cancels the goal.

    Ends with status 0 when the goal succeeded, else 1.

    \b
    microros-gen action send-goal --feedback /fibonacci example_interfaces/action/Fibonacci 'order: 5'
    """
    from microros_gen.ros_tools.actions import SUCCEEDED, Goal, status_name
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.filling import fill
    from microros_gen.ros_tools.texts import Texts

    text = values_text(values, from_stdin)
    with on_graph(**graph) as (peer, _), until_interrupted() as interrupted:
        known = peer.types.action(action_type)
        declared = known.interfaces.actions[known.name]
        filled = fill(text, declared.goal.name, known.interfaces.messages, "goal")
        texts = Texts(known.interfaces.messages)

        def print_feedback(value: dict[str, Any]) -> None:
            show(f"Feedback:\n{_indented(texts.yaml(declared.feedback.name, value))}")

        goal = Goal(peer, absolute(action), str(known.name), print_feedback if feedback else None)
        show("Waiting for an action server to become available...")
        while not goal.wait_for_server(TURN_S):
            if interrupted:
                return 1
        complete = known.codec.decode(
            declared.goal.name, known.codec.encode(declared.goal.name, filled.value)
        )
        show(f"Sending goal:\n{_indented(texts.yaml(declared.goal.name, complete))}")
        accepted = goal.send(filled.value, lambda: bool(interrupted))
        if accepted is None:
            return _cancel(goal)
        if not accepted:
            show("Goal was rejected.")
            return 1
        show(f"Goal accepted with ID: {goal.id}\n")
        ended = goal.result(lambda: bool(interrupted))
        if ended is None:
            return _cancel(goal)
        status, result = ended
        show(f"Result:\n{_indented(texts.yaml(declared.result.name, result))}")
        show(f"Goal finished with status: {status_name(status)}")
        return 0 if status == SUCCEEDED else 1


def _indented(text: str) -> str:
    return textwrap.indent(text, "    ")


def _cancel(goal: Goal) -> int:
    show("Canceling goal...")
    show("Goal canceled." if goal.cancel() else "The server did not cancel the goal.")
    return 1


command.add_command(send_goal_command, "send-goal")
command.add_command(send_goal_command, "send_goal")
