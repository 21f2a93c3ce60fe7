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
    text_options,
    until_interrupted,
)
from microros_gen.cli.topic.subscribing import topic_qos, topic_type
from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from microros_gen.ros.known_types import KnownType
    from microros_gen.ros_tools.texts import Texts

_PRESET = "sensor_data"
_CLEAR = "\x1b[H\x1b[2J"


@click.command()
@click.argument("topic")
@click.argument("message_type", metavar="[TYPE]", required=False)
@click.option("--field", metavar="PATH", help="Print one member only: `pose.position`.")
@click.option("--raw", is_flag=True, help="Print the bytes: encapsulation and CDR.")
@click.option(
    "--filter", "expression", metavar="EXPRESSION", help="Print only messages `m` for which this holds."
)
@click.option("--no-lost-messages", is_flag=True, help="Do not report lost messages, on standard error.")
@click.option("--once", is_flag=True, help="End after the first message that is printed.")
@click.option(
    "--timeout", type=click.FloatRange(0, min_open=True), metavar="SECONDS", help="End after this time."
)
@click.option(
    "-i", "--include-message-info", is_flag=True, help="Print times and sequence numbers before each."
)
@click.option("-c", "--clear", is_flag=True, help="Clear a terminal before each message.")
@click.option("-n", "--node-name", metavar="NAME", help="Name of the node. Default: a hidden one.")
@text_options
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
    expression: str | None,
    no_lost_messages: bool,
    once: bool,
    timeout: float | None,
    include_message_info: bool,
    clear: bool,
    node_name: str | None,
    **options: Any,
) -> None:
    """Print the messages of a topic as YAML.

    Without TYPE, the topic must exist. Without QoS options, reliability and durability are those that all its
    publishers offer. EXPRESSION is one of Python: comparisons, arithmetic, `any(x > 2 for x in m.ranges)`. `m` is the
    message, or what --field names of it.

    \b
    microros-gen topic echo /chatter
    microros-gen topic echo --once --field pose.position /odom
    microros-gen topic echo --filter 'm.twist.twist.linear.x > 0.5' /odom
    microros-gen topic echo --interface-path robot_msgs /state robot_msgs/msg/State
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.expressions import Filter
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
        chosen = _Chosen.of(known, field)
        holds = None if expression is None else Filter(expression, chosen.kind, known.interfaces.messages)
        to_text = _printer(chosen, Texts(known.interfaces.messages, style), csv, flow_style)
        received = 0

        def receive(data: bytes, info: Mapping[str, Any]) -> None:
            nonlocal received
            if once and received:
                return
            value = None if raw and holds is None else chosen.value(known.codec.decode(known.name, data))
            if holds is not None and not holds(value):
                return
            received += 1
            if clear:
                click.echo(_CLEAR, nl=False)
            if include_message_info:
                show(f"{dump(dict(sorted(info.items())))}---")
            show(f"{data!r}\n---" if raw else to_text(value))

        subscription = peer.subscribe_raw(name, known.name, known.type_hash(known.name), receive, qos)
        if not no_lost_messages:
            peer.on_lost(subscription, _report_lost)
        end = None if timeout is None else time.monotonic() + timeout
        while not interrupted and not (once and received) and (end is None or time.monotonic() < end):
            peer.spin_once(TURN_S if end is None else max(0.0, min(TURN_S, end - time.monotonic())))


def _report_lost(change: int, total: int) -> None:
    click.echo(f"A message was lost!!!\n\ttotal count change:{change}\n\ttotal count: {total}", err=True)


@dataclass(frozen=True)
class _Chosen:
    """What --field names of a message, or the whole one: the names on the way to it, and its type."""

    path: tuple[str, ...]
    kind: Any

    @staticmethod
    def of(known: KnownType, field: str | None) -> _Chosen:
        """Return what `field` names. UserError for a member that the type lacks."""
        path = tuple(part for part in (field or "").split(".") if part)
        return _Chosen(path, known.name if field is None else _type_of_member(known, field, path))

    def value(self, message: dict[str, Any]) -> Any:
        """Return it from a message."""
        value: Any = message
        for part in self.path:
            value = value[part]
        return value


def _printer(chosen: _Chosen, texts: Texts, csv: bool, flow: bool) -> Callable[[Any], str]:
    """Return what turns what was chosen into the text that is printed."""

    def text(value: Any) -> str:
        if not hasattr(chosen.kind, "package"):
            return f"{value}\n---"
        return texts.csv(chosen.kind, value) if csv else f"{texts.yaml(chosen.kind, value, flow)}---"

    return text


def _type_of_member(known: KnownType, field: str, path: tuple[str, ...]) -> Any:
    from microros_gen.interfaces.types import NamedType

    kind: Any = known.name
    for part in path or ("",):
        fields = known.interfaces.messages[kind].fields if kind in known.interfaces.messages else ()
        member = next((field for field in fields if field.name == part), None)
        if member is None:
            names = [field.name for field in fields]
            hint = nearest(part, names) or f"Members here: {', '.join(names) or 'none'}"
            message = f"{known.name} has no member '{field}'"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9819")])
        kind = member.type.name if isinstance(member.type, NamedType) else member.type
    return kind
