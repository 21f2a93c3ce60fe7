# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic list | info | type | find`."""

from __future__ import annotations

from typing import Any

import click

from microros_gen.cli.ros_tools import graph_options, on_graph


@click.command()
@click.option("-t", "--show-types", is_flag=True, help="With the types.")
@click.option("-c", "--count-topics", is_flag=True, help="Print the number of topics only.")
@click.option("--include-hidden-topics", is_flag=True, help="Also topics with a part that begins with `_`.")
@click.option(
    "-v", "--verbose", is_flag=True, help="With types and the numbers of publishers and subscriptions."
)
@graph_options
def list_command(
    show_types: bool, count_topics: bool, include_hidden_topics: bool, verbose: bool, **graph: Any
) -> None:
    """List the topics.

    \b
    microros-gen topic list -t
    """
    with on_graph(**graph) as (_, discovery):
        topics = discovery.topics(include_hidden_topics)
        if count_topics:
            click.echo(len(topics))
        elif verbose:
            counts = [
                (name, types, len(discovery.publishers(name)), len(discovery.graph.subscriptions(name)))
                for name, types in topics
            ]
            click.echo(_counted("Published", "publisher", [(n, t, p) for n, t, p, _ in counts]))
            click.echo(_counted("Subscribed", "subscriber", [(n, t, s) for n, t, _, s in counts]))
        else:
            for name, types in topics:
                click.echo(f"{name} [{', '.join(types)}]" if show_types else name)


def _counted(title: str, end: str, counts: list[tuple[str, tuple[str, ...], int]]) -> str:
    lines = [
        f" * {name} [{', '.join(types)}] {count} {end}{'s' if count > 1 else ''}\n"
        for name, types, count in counts
        if count
    ]
    return "".join((f"{title} topics:\n", *lines))


@click.command()
@click.argument("topic")
@click.option("-v", "--verbose", is_flag=True, help="With node, type hash, GID and QoS of each endpoint.")
@graph_options
def info_command(topic: str, verbose: bool, **graph: Any) -> None:
    """Show the type and the endpoints of a topic.

    \b
    microros-gen topic info -v /chatter
    """
    from microros_gen.ros_tools.discovery import absolute, unknown_topic
    from microros_gen.ros_tools.quality import endpoint_lines

    name = absolute(topic)
    with on_graph(**graph) as (_, discovery):
        types = discovery.topic_types(name)
        discovery.settle()
        if types is None:
            raise unknown_topic(name, dict(discovery.topics(hidden=True)))
        publishers, subscriptions = discovery.publishers(name), discovery.graph.subscriptions(name)
    parts = [f"Type: {types[0] if len(types) == 1 else list(types)}"]
    for kind, label, endpoints in (
        ("PUBLISHER", "Publisher", publishers),
        ("SUBSCRIPTION", "Subscription", subscriptions),
    ):
        parts.append(f"{label} count: {len(endpoints)}")
        if verbose:
            parts += ["\n".join(endpoint_lines(endpoint, kind)) for endpoint in endpoints]
    click.echo("\n\n".join(parts) + "\n" if verbose else "\n".join(parts))


@click.command()
@click.argument("topic")
@graph_options
def type_command(topic: str, **graph: Any) -> None:
    """Print the type of a topic.

    \b
    microros-gen topic type /chatter
    """
    from microros_gen.ros_tools.discovery import absolute, unknown_topic

    name = absolute(topic)
    with on_graph(**graph) as (_, discovery):
        types = discovery.topic_types(name)
        if types is None:
            raise unknown_topic(name, dict(discovery.topics(hidden=True)))
    click.echo("\n".join(types))


@click.command()
@click.argument("topic_type", metavar="TYPE")
@click.option("-c", "--count-topics", is_flag=True, help="Print the number of topics only.")
@click.option("--include-hidden-topics", is_flag=True, help="Also topics with a part that begins with `_`.")
@graph_options
def find_command(topic_type: str, count_topics: bool, include_hidden_topics: bool, **graph: Any) -> None:
    """List the topics of a type.

    \b
    microros-gen topic find std_msgs/msg/Int32
    """
    with on_graph(**graph) as (_, discovery):
        found = [name for name, types in discovery.topics(include_hidden_topics) if topic_type in types]
    click.echo(len(found) if count_topics else "".join(f"{name}\n" for name in found), nl=count_topics)
