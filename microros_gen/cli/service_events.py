# SPDX-License-Identifier: Apache-2.0
"""`microros-gen service echo`: what clients and servers of a service send and receive, where they publish it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.ros_tools import TURN_S, graph_options, on_graph, show, text_options, until_interrupted

if TYPE_CHECKING:
    from microros_gen.ros_tools.discovery import Discovery

_ENDING = "/_service_event"
_NAMES = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")
"""By their numbers in service_msgs/msg/ServiceEventInfo."""


@click.command()
@click.argument("service")
@click.argument("service_type", metavar="[TYPE]", required=False)
@text_options
@graph_options
def echo_command(
    service: str,
    service_type: str | None,
    csv: bool,
    full_length: bool,
    truncate_length: int,
    no_arr: bool,
    no_str: bool,
    flow_style: bool,
    **graph: Any,
) -> None:
    """Print requests and replies of a service, of clients and servers with service introspection (REP-2012).

    Without TYPE, the service must exist.

    \b
    microros-gen service echo /enable
    microros-gen service echo --flow-style /enable std_srvs/srv/SetBool
    """
    from microros_gen.interfaces.derived import derived_name
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.quality import PRESETS
    from microros_gen.ros_tools.texts import Style, Texts

    name = absolute(service)
    with on_graph(**graph) as (peer, discovery), until_interrupted() as interrupted:
        known = peer.types.service(service_type or _type_of(discovery, name))
        event = derived_name(known.name, "Event")
        style = Style(None if full_length else truncate_length, not no_arr, not no_str)
        texts = Texts(known.interfaces.messages, style)

        def receive(data: bytes, _info: Mapping[str, Any]) -> None:
            value = known.codec.decode(event, data)
            if csv:
                show(texts.csv(event, value))
                return
            info = value["info"]
            value["info"] = {**info, "event_type": _event_name(info["event_type"])}
            show(f"{texts.yaml(event, value, flow_style)}---")

        topic = f"{name}{_ENDING}"
        peer.subscribe_raw(topic, event, known.type_hash(event), receive, PRESETS["services_default"])
        published = discovery.find(lambda: discovery.publishers(topic) or (() if interrupted else None))
        if not published and not interrupted:
            text = (
                f"No publishers on topic '{topic}'; is service introspection on the client or server enabled?"
            )
            click.echo(text, err=True)
        reported: set[bytes] = set()
        while not interrupted:
            _tell_unheard(discovery, topic, reported)
            peer.spin_once(TURN_S)


def _tell_unheard(discovery: Discovery, topic: str, reported: set[bytes]) -> None:
    """Report new publishers of events that the command, which is a reliable subscriber, does not get."""
    from microros_gen.ros_tools.quality import BEST_EFFORT

    for publisher in discovery.publishers(topic):
        if publisher.reliability == BEST_EFFORT and publisher.gid not in reported:
            reported.add(publisher.gid)
            text = f"A publisher of '{topic}' is best effort: its events are not printed."
            click.echo(text, err=True)


def _type_of(discovery: Discovery, service: str) -> str:
    """Return the one type of a service. UserError if it is unknown or has several."""
    from microros_gen.diagnostics import Diagnostic, UserError
    from microros_gen.ros_tools.discovery import unknown_service

    types = discovery.service_types(service)
    if types is None:
        raise unknown_service(service, dict(discovery.services(hidden=True)))
    if len(types) > 1:
        hint = f"Name one of them: {', '.join(types)}"
        message = f"service '{service}' has several types"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9839")], status=1)
    return types[0]


def _event_name(number: int) -> str | int:
    return _NAMES[number] if number < len(_NAMES) else number
