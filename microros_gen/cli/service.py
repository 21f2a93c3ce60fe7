# SPDX-License-Identifier: Apache-2.0
"""`microros-gen service`: the services of a graph."""

from __future__ import annotations

import time
from typing import Any

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
from microros_gen.cli.service_events import echo_command

_PATIENCE_S = 1.0
"""A service that is there is discovered within this time, on most machines."""


@click.group(cls=CommandGroup)
def command() -> None:
    """List and call services, as `ros2 service` does.

    Types come from interface files, installed or in --interface-path, without a build. Needs ROS 2 Jazzy, like the
    agent.

    \b
    microros-gen service list -t
    microros-gen service call /enable std_srvs/srv/SetBool 'data: true'
    """


command.add_command(echo_command, "echo")


@command.command("list")
@click.option("-t", "--show-types", is_flag=True, help="With the types.")
@click.option("-c", "--count-services", is_flag=True, help="Print the number of services only.")
@click.option(
    "--include-hidden-services", is_flag=True, help="Also services with a part that begins with `_`."
)
@graph_options
def list_command(show_types: bool, count_services: bool, include_hidden_services: bool, **graph: Any) -> None:
    """List the services.

    \b
    microros-gen service list -t
    """
    with on_graph(**graph) as (_, discovery):
        services = discovery.services(include_hidden_services)
    if count_services:
        click.echo(len(services))
        return
    for name, types in services:
        click.echo(f"{name} [{', '.join(types)}]" if show_types else name)


@command.command("type")
@click.argument("service")
@graph_options
def type_command(service: str, **graph: Any) -> None:
    """Print the type of a service.

    \b
    microros-gen service type /enable
    """
    from microros_gen.ros_tools.discovery import absolute, unknown_service

    name = absolute(service)
    with on_graph(**graph) as (_, discovery):
        types = discovery.service_types(name)
        if types is None:
            raise unknown_service(name, dict(discovery.services(hidden=True)))
    click.echo("\n".join(types))


@command.command("find")
@click.argument("service_type", metavar="TYPE")
@click.option("-c", "--count-services", is_flag=True, help="Print the number of services only.")
@click.option(
    "--include-hidden-services", is_flag=True, help="Also services with a part that begins with `_`."
)
@graph_options
def find_command(
    service_type: str, count_services: bool, include_hidden_services: bool, **graph: Any
) -> None:
    """List the services of a type.

    \b
    microros-gen service find std_srvs/srv/SetBool
    """
    with on_graph(**graph) as (_, discovery):
        found = [name for name, types in discovery.services(include_hidden_services) if service_type in types]
    click.echo(len(found) if count_services else "".join(f"{name}\n" for name in found), nl=count_services)


@command.command("info")
@click.argument("service")
@graph_options
def info_command(service: str, **graph: Any) -> None:
    """Show the type of a service, and how many clients and servers it has.

    \b
    microros-gen service info /enable
    """
    from microros_gen.ros_tools.discovery import absolute, unknown_service

    name = absolute(service)
    with on_graph(**graph) as (_, discovery):
        types = discovery.service_types(name)
        discovery.settle()
        if types is None:
            raise unknown_service(name, dict(discovery.services(hidden=True)))
        clients, servers = discovery.graph.count_clients(name), discovery.graph.count_servers(name)
    click.echo(f"Type: {types[0] if len(types) == 1 else list(types)}")
    click.echo(f"Clients count: {clients}\nServices count: {servers}")


@command.command("call")
@click.argument("service")
@click.argument("service_type", metavar="TYPE")
@click.argument("values", required=False)
@stdin_option
@click.option(
    "-r",
    "--rate",
    type=click.FloatRange(0, min_open=True),
    metavar="HZ",
    help="Repeat the call at this rate until Ctrl-C.",
)
@graph_options
def call_command(
    service: str, service_type: str, values: str | None, from_stdin: bool, rate: float | None, **graph: Any
) -> None:
    """Call a service; VALUES are YAML, members that it omits have their defaults. Waits until it is available.

    \b
    microros-gen service call /enable std_srvs/srv/SetBool 'data: true'
    """
    from microros_gen.ros.names import ServiceName
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.filling import fill
    from microros_gen.ros_tools.texts import Texts

    text = values_text(values, from_stdin)
    with on_graph(**graph) as (peer, _), until_interrupted() as interrupted:
        known = peer.types.service(service_type)
        name = ServiceName(absolute(service), known.name)
        messages = known.interfaces.messages
        filled = fill(text, name.request, messages)
        texts = Texts(messages)
        client = peer.client(name.name, service_type)
        if not client.wait(_PATIENCE_S):
            show("waiting for service to become available...")
        while not interrupted:
            if not client.wait(TURN_S):
                continue
            complete = known.codec.decode(name.request, known.codec.encode(name.request, filled.value))
            show(f"requester: making request: {texts.line(name.request, complete)}\n")
            due = time.monotonic() + (1 / rate if rate else 0.0)
            responses: list[dict[str, Any]] = []
            client.send(filled.value, responses.append)
            while not responses and not interrupted:
                peer.spin_once(TURN_S)
            if responses:
                show(f"response:\n{texts.line(name.response, responses[0])}\n")
            if not rate:
                break
            interrupted.wait(max(0.0, due - time.monotonic()))
