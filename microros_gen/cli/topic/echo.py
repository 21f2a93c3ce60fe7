# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic echo`: prints the messages of a topic."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.ros_tools import (
    TURN_S,
    chosen_qos,
    graph_options,
    on_graph,
    qos_options,
    show,
    until_interrupted,
)
from microros_gen.cli.topic.subscribing import topic_qos, topic_type
from microros_gen.diagnostics import Diagnostic, UserError, nearest

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from microros_gen.ros.known_types import KnownType
    from microros_gen.ros_tools.texts import Texts

_PRESET = "sensor_data"


@click.command()
@click.argument("topic")
@click.argument("message_type", metavar="[TYPE]", required=False)
@click.option("--csv", is_flag=True, help="Print the values of all members on one line, separated by commas.")
@click.option("--field", metavar="PATH", help="Print one member only: `pose.position`.")
@click.option("-f", "--full-length", is_flag=True, help="Print arrays and texts of any length.")
@click.option(
    "-l",
    "--truncate-length",
    type=click.IntRange(0),
    default=128,
    show_default=True,
    metavar="N",
    help="Print at most so many elements and characters of each.",
)
@click.option("--no-arr", is_flag=True, help="Print type and length of arrays only.")
@click.option("--no-str", is_flag=True, help="Print the length of texts only.")
@click.option("--flow-style", is_flag=True, help="Print each message on one line, as YAML with braces.")
@click.option("--raw", is_flag=True, help="Print the bytes: encapsulation and CDR.")
@click.option("--once", is_flag=True, help="End after the first message.")
@click.option(
    "--timeout", type=click.FloatRange(0, min_open=True), metavar="SECONDS", help="End after this time."
)
@click.option(
    "-i", "--include-message-info", is_flag=True, help="Print times and sequence numbers before each."
)
@click.option("-n", "--node-name", metavar="NAME", help="Name of the node. Default: a hidden one.")
@qos_options(_PRESET)
@graph_options
def echo_command(
    topic: str,
    message_type: str | None,
    csv: bool,
    field: str | None,
    full_length: bool,
    truncate_length: int,
    no_arr: bool,
    no_str: bool,
    flow_style: bool,
    raw: bool,
    once: bool,
    timeout: float | None,
    include_message_info: bool,
    node_name: str | None,
    **options: Any,
) -> None:
    """Print the messages of a topic as YAML.

    Without TYPE, the topic must exist. Without QoS options, reliability and durability are those that all its
    publishers offer.

    \b
    microros-gen topic echo /chatter
    microros-gen topic echo --once --field pose.position /odom
    microros-gen topic echo --interface-path robot_msgs /state robot_msgs/msg/State
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.texts import Style, Texts, dump

    name = absolute(topic)
    qos, with_options, graph = chosen_qos(_PRESET, options)
    with on_graph(**graph, node=node_name) as (peer, discovery), until_interrupted() as interrupted:
        type_name = message_type or topic_type(discovery, name)
        known = peer.types.message(type_name)
        if not with_options:
            discovery.topic_types(name)
            qos = topic_qos(discovery, name, qos)
        style = Style(None if full_length else truncate_length, not no_arr, not no_str)
        to_text = _printer(known, Texts(known.interfaces.messages, style), field, csv, flow_style)
        received = 0

        def receive(data: bytes, info: Mapping[str, Any]) -> None:
            nonlocal received
            if once and received:
                return
            received += 1
            if include_message_info:
                show(f"{dump(dict(sorted(info.items())))}---")
            show(f"{data!r}\n---" if raw else to_text(known.codec.decode(known.name, data)))

        peer.subscribe_raw(name, known.name, known.type_hash(known.name), receive, qos)
        end = None if timeout is None else time.monotonic() + timeout
        while not interrupted and not (once and received) and (end is None or time.monotonic() < end):
            peer.spin_once(TURN_S if end is None else max(0.0, min(TURN_S, end - time.monotonic())))


def _printer(
    known: KnownType, texts: Texts, field: str | None, csv: bool, flow: bool
) -> Callable[[dict[str, Any]], str]:
    """Return what turns a message into the text that is printed. UserError for a member that the type lacks."""
    path = [part for part in (field or "").split(".") if part]
    kind: Any = known.name
    if field is not None:
        kind = _type_of_member(known, field, path)

    def text(message: dict[str, Any]) -> str:
        value: Any = message
        for part in path:
            value = value[part]
        if not hasattr(kind, "package"):
            return f"{value}\n---"
        return texts.csv(kind, value) if csv else f"{texts.yaml(kind, value, flow)}---"

    return text


def _type_of_member(known: KnownType, field: str, path: list[str]) -> Any:
    from microros_gen.interfaces.types import NamedType

    kind: Any = known.name
    for part in path or [""]:
        fields = known.interfaces.messages[kind].fields if kind in known.interfaces.messages else ()
        member = next((field for field in fields if field.name == part), None)
        if member is None:
            names = [field.name for field in fields]
            hint = nearest(part, names) or f"Members here: {', '.join(names) or 'none'}"
            message = f"{known.name} has no member '{field}'"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9819")])
        kind = member.type.name if isinstance(member.type, NamedType) else member.type
    return kind
