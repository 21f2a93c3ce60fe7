# SPDX-License-Identifier: Apache-2.0
"""`microros-gen param`: the parameters of nodes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.ros_tools import graph_options, on_graph, parameter_options
from microros_gen.diagnostics import Diagnostic, UserError, nearest

if TYPE_CHECKING:
    from microros_gen.parameter_server.values import ParameterValue
    from microros_gen.ros.peer import Peer
    from microros_gen.ros_tools.discovery import Discovery
    from microros_gen.ros_tools.parameters import NodeParameters

_LIST_SERVICE = "/list_parameters"


@click.group(cls=CommandGroup)
def command() -> None:
    """Show, set and delete parameters of nodes, as `ros2 param` does. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen param list /arm
    microros-gen param get /arm gain
    microros-gen param set /arm gain 2.5
    microros-gen param delete /arm gain
    microros-gen param dump /arm > arm.yaml
    microros-gen param load /arm arm.yaml
    """


@command.command("list")
@click.argument("node", required=False)
@click.option("--include-hidden-nodes", is_flag=True, help="Also nodes whose name begins with `_`.")
@click.option("--param-type", is_flag=True, help="With the types.")
@click.option(
    "--param-prefixes", multiple=True, metavar="PREFIX", help="Only those below this prefix; repeatable."
)
@click.option(
    "--filter", "expression", metavar="EXPRESSION", help="Only names that begin with this expression."
)
@graph_options
def list_command(
    node: str | None,
    include_hidden_nodes: bool,
    param_type: bool,
    param_prefixes: tuple[str, ...],
    expression: str | None,
    **graph: Any,
) -> int:
    """List the parameters of a node, or of all nodes.

    \b
    microros-gen param list /arm
    """
    from microros_gen.ros.errors import RosError
    from microros_gen.ros_tools.parameters import NodeParameters, type_text

    pattern = _pattern(expression)
    status = 0
    with on_graph(**graph) as (peer, discovery):
        for name in _nodes(discovery, node, include_hidden_nodes):
            parameters = NodeParameters(peer, name)
            try:
                names = [
                    found for found in parameters.names(param_prefixes) if not pattern or pattern.match(found)
                ]
                described = parameters.describe(names) if param_type and names else []
            except RosError as error:
                if node is not None:
                    raise
                click.echo(f"{name}: {error}", err=True)
                status = 1
                continue
            types = {d["name"]: f" (type: {type_text(d['type'])})" for d in described}
            if node is None and names:
                click.echo(f"{name}:")
            for found in names:
                click.echo(f"  {found}{types.get(found, '')}")
    return status


def _nodes(discovery: Discovery, node: str | None, hidden: bool) -> tuple[str, ...]:
    """Return the node, or all nodes with parameters."""
    from microros_gen.ros_tools.discovery import absolute, is_hidden

    if node is not None:
        discovery.require_node(absolute(node))
        return (absolute(node),)
    names = [name for name, _ in discovery.services(hidden=True) if name.endswith(_LIST_SERVICE)]
    found = sorted({name.removesuffix(_LIST_SERVICE) for name in names})
    return tuple(name for name in found if hidden or not is_hidden(name))


def _pattern(expression: str | None) -> re.Pattern[str] | None:
    try:
        return None if expression is None else re.compile(expression)
    except re.error as error:
        message = f"--filter: {error}"
        raise UserError([Diagnostic(message, hint="Example: 'limit.*'", id="MG-9826")]) from error


@command.command("get")
@click.argument("node")
@click.argument("parameter")
@click.option("--hide-type", is_flag=True, help="Print the value alone.")
@parameter_options
def get_command(node: str, parameter: str, hide_type: bool, **graph: Any) -> None:
    """Print the value of a parameter.

    \b
    microros-gen param get /arm gain
    """
    from microros_gen.ros_tools.parameters import value_label

    with on_graph(**graph) as (peer, discovery):
        parameters = _parameters(peer, discovery, node)
        values = parameters.values([parameter])
        if not values:
            raise _unknown(parameters, parameter)
    value = values[0]
    if value.type == 0:
        click.echo("None" if hide_type else value_label(value))
    else:
        click.echo(_value_text(value) if hide_type else f"{value_label(value)} {_value_text(value)}")


def _value_text(value: ParameterValue) -> str:
    return str(value.to_json())


@command.command("set", context_settings={"ignore_unknown_options": True})
@click.argument("node")
@click.argument("parameter")
@click.argument("value")
@parameter_options
def set_command(node: str, parameter: str, value: str, **graph: Any) -> int:
    """Set a parameter; VALUE is YAML: `2.5`, `true`, `fast`, `[1, 2]`. Quotes make a text of a number: `'"2"'`.

    \b
    microros-gen param set /arm gain 2.5
    """
    from microros_gen.ros_tools.parameters import value_from_text

    chosen = value_from_text(value)
    with on_graph(**graph) as (peer, discovery):
        ((successful, reason),) = _parameters(peer, discovery, node).set([(parameter, chosen)])
    ending = f": {reason}" if reason else ""
    if successful:
        click.echo(f"Set parameter successful{ending}")
        return 0
    click.echo(f"Setting parameter failed{ending}", err=True)
    return 1


@command.command("delete")
@click.argument("node")
@click.argument("parameter")
@parameter_options
def delete_command(node: str, parameter: str, **graph: Any) -> int:
    """Delete a parameter, which its node must allow: one of dynamic type that is not read-only.

    \b
    microros-gen param delete /arm gain
    """
    from microros_gen.parameter_server.values import NOTHING

    with on_graph(**graph) as (peer, discovery):
        parameters = _parameters(peer, discovery, node)
        if parameter not in parameters.names():
            raise _unknown(parameters, parameter)
        ((successful, reason),) = parameters.set([(parameter, NOTHING)])
    ending = f": {reason}" if reason else ""
    if successful:
        click.echo(f"Deleted parameter successfully{ending}")
        return 0
    click.echo(f"Deleting parameter failed{ending}", err=True)
    return 1


@command.command("describe")
@click.argument("node")
@click.argument("parameters", nargs=-1, required=True)
@parameter_options
def describe_command(node: str, parameters: tuple[str, ...], **graph: Any) -> None:
    """Show type, description and limits of parameters.

    \b
    microros-gen param describe /arm gain
    """
    from microros_gen.ros_tools.parameters import descriptor_lines

    with on_graph(**graph) as (peer, discovery):
        node_parameters = _parameters(peer, discovery, node)
        known = node_parameters.names()
        for name in parameters:
            if name not in known:
                raise _unknown(node_parameters, name)
        described = node_parameters.describe(parameters)
    for descriptor in described:
        click.echo("\n".join(descriptor_lines(descriptor)))


@command.command("dump")
@click.argument("node")
@parameter_options
def dump_command(node: str, **graph: Any) -> None:
    """Print all parameters of a node as a parameter file.

    \b
    microros-gen param dump /arm > arm.yaml
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.parameters import dumped
    from microros_gen.ros_tools.texts import dump

    with on_graph(**graph) as (peer, discovery):
        parameters = _parameters(peer, discovery, node)
        names = parameters.names()
        values = parameters.values(names)
    click.echo(dump(dumped(absolute(node), zip(names, values, strict=True))), nl=False)


@command.command("load")
@click.argument("node")
@click.argument("file", type=click.Path(path_type=Path, exists=True, dir_okay=False))
@click.option("--no-use-wildcard", is_flag=True, help="Without the parameters that the file has for `/**`.")
@parameter_options
def load_command(node: str, file: Path, no_use_wildcard: bool, **graph: Any) -> int:
    """Set the parameters of a node from a parameter file, each by itself.

    \b
    microros-gen param load /arm arm.yaml
    """
    from microros_gen.diagnostics import Source
    from microros_gen.documents.files import read_text
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.parameters import parameters_of_file

    source = Source(str(file), read_text(file))
    chosen = parameters_of_file(source, absolute(node), not no_use_wildcard)
    status = 0
    with on_graph(**graph) as (peer, discovery):
        results = _parameters(peer, discovery, node).set(chosen)
    for (name, _), (successful, reason) in zip(chosen, results, strict=True):
        ending = f": {reason}" if reason else ""
        if successful:
            click.echo(f"Set parameter {name} successful{ending}")
        else:
            click.echo(f"Set parameter {name} failed{ending}", err=True)
            status = 1
    return status


def _parameters(peer: Peer, discovery: Discovery, node: str) -> NodeParameters:
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.parameters import NodeParameters

    discovery.require_node(absolute(node))
    return NodeParameters(peer, absolute(node))


def _unknown(parameters: NodeParameters, name: str) -> UserError:
    hint = nearest(name, parameters.names()) or f"List them with: microros-gen param list {parameters.node}"
    return UserError(
        [Diagnostic(f"{parameters.node} has no parameter '{name}'", hint=hint, id="MG-9827")], status=1
    )
