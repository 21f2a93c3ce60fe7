# SPDX-License-Identifier: Apache-2.0
"""Topics that a command subscribes to: their type and QoS from the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from collections.abc import Callable

    from microros_gen.ros.qos import Qos
    from microros_gen.ros_tools.discovery import Discovery


def topic_type(discovery: Discovery, topic: str) -> str:
    """Return the one type of a topic; UserError if it is unknown or has several."""
    from microros_gen.ros_tools.discovery import unknown_topic

    types = discovery.topic_types(topic)
    if types is None:
        raise unknown_topic(topic, dict(discovery.topics(hidden=True)))
    return _only(topic, types)


def awaited_topic_type(discovery: Discovery, topic: str, given_up: Callable[[], object]) -> str | None:
    """Return the one type of a topic once it exists, None if `given_up()` is true before; UserError for several."""
    types = discovery.topic_types(topic)
    if types is None:
        click.echo(f"WARNING: topic [{topic}] does not appear to be published yet", err=True)
        types = discovery.topic_types(topic, given_up)
    return None if types is None else _only(topic, types)


def _only(topic: str, types: tuple[str, ...]) -> str:
    if len(types) > 1:
        hint = f"Name one of them: {', '.join(types)}"
        raise UserError([Diagnostic(f"topic '{topic}' has several types", hint=hint, id="MG-9818")], status=1)
    return types[0]


def topic_qos(discovery: Discovery, topic: str, preset: Qos) -> Qos:
    """Return the QoS that all publishers of a topic match; say what some of them would have offered."""
    from microros_gen.ros_tools.quality import matching

    qos, notes = matching(discovery.publishers(topic), preset)
    for note in notes:
        click.echo(f"{topic}: {note}", err=True)
    return qos
