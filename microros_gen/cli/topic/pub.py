# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic pub`: publishes messages."""

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
    stdin_option,
    until_interrupted,
    values_text,
)
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.cli.ros_tools import Interrupted
    from microros_gen.ros.endpoints import Publisher
    from microros_gen.ros.peer import Peer

_PRESET = "default"


@click.command()
@click.argument("topic")
@click.argument("message_type", metavar="TYPE")
@click.argument("values", required=False)
@stdin_option
@click.option(
    "-r",
    "--rate",
    type=click.FloatRange(0, min_open=True),
    default=1.0,
    show_default=True,
    metavar="HZ",
    help="Messages in a second.",
)
@click.option(
    "-p",
    "--print",
    "print_every",
    type=click.IntRange(0),
    default=1,
    show_default=True,
    metavar="N",
    help="Print every N-th message only, 0 none.",
)
@click.option("-1", "--once", is_flag=True, help="Publish one message.")
@click.option(
    "-t",
    "--times",
    type=click.IntRange(0),
    default=0,
    metavar="N",
    help="Publish N messages. Default: no end.",
)
@click.option(
    "-w",
    "--wait-matching-subscriptions",
    type=click.IntRange(0),
    metavar="N",
    help="Wait for N subscriptions first. Default: 1 with --once or --times, else 0.",
)
@click.option(
    "--max-wait-time-secs",
    type=click.FloatRange(0, min_open=True),
    metavar="SECONDS",
    help="The longest wait for subscriptions; without it there is no limit.",
)
@click.option(
    "--keep-alive",
    type=click.FloatRange(0),
    default=0.1,
    show_default=True,
    metavar="SECONDS",
    help="Time for delivery after the last message.",
)
@click.option("-n", "--node-name", metavar="NAME", help="Name of the node. Default: a hidden one.")
@qos_options(_PRESET)
@graph_options
def pub_command(
    topic: str,
    message_type: str,
    values: str | None,
    from_stdin: bool,
    rate: float,
    print_every: int,
    once: bool,
    times: int,
    wait_matching_subscriptions: int | None,
    max_wait_time_secs: float | None,
    keep_alive: float,
    node_name: str | None,
    **options: Any,
) -> None:
    """Publish messages of TYPE; VALUES are YAML, members that it omits have their defaults.

    `now` as a time and `auto` as a std_msgs/msg/Header are the time at which each message is published.

    \b
    microros-gen topic pub --once /numbers std_msgs/msg/Int32 'data: 7'
    microros-gen topic pub -r 10 /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.2}, angular: {z: 0.1}}'
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.filling import fill
    from microros_gen.ros_tools.texts import Texts

    if once and times:
        raise click.UsageError("--once and --times exclude each other.")
    count = 1 if once else times
    wanted = int(count > 0) if wait_matching_subscriptions is None else wait_matching_subscriptions
    if max_wait_time_secs is not None and wanted == 0:
        raise click.UsageError("--max-wait-time-secs needs --wait-matching-subscriptions, --once or --times.")
    qos, _, graph = chosen_qos(_PRESET, options)
    text = values_text(values, from_stdin)
    with on_graph(**graph, node=node_name) as (peer, _discovery), until_interrupted() as interrupted:
        known = peer.types.message(message_type)
        filled = fill(text, known.name, known.interfaces.messages)
        publisher = peer.publisher(absolute(topic), message_type, qos)
        _wait_for_subscriptions(peer, publisher, wanted, max_wait_time_secs, interrupted)
        texts = Texts(known.interfaces.messages)
        if not interrupted:
            show("publisher: beginning loop")
        sent, due = 0, time.monotonic()
        while not interrupted and (not count or sent < count):
            seconds, nanoseconds = divmod(time.time_ns(), 1_000_000_000)
            filled.stamp({"sec": seconds, "nanosec": nanoseconds})
            publisher.publish(filled.value)
            sent += 1
            if print_every and sent % print_every == 0:
                complete = known.codec.decode(known.name, known.codec.encode(known.name, filled.value))
                show(f"publishing #{sent}: {texts.line(known.name, complete)}\n")
            due = max(due + 1 / rate, time.monotonic())
            if not count or sent < count:
                interrupted.wait(max(0.0, due - time.monotonic()))
        interrupted.wait(keep_alive)


def _wait_for_subscriptions(
    peer: Peer, publisher: Publisher, wanted: int, longest: float | None, interrupted: Interrupted
) -> None:
    """Wait for matching subscriptions; UserError after `longest` seconds."""
    began = reported = time.monotonic()
    if publisher.subscriptions() < wanted:
        show(f"Waiting for at least {wanted} matching subscription(s)...")
    while publisher.subscriptions() < wanted and not interrupted:
        now = time.monotonic()
        if longest is not None and now - began >= longest:
            message = f"{publisher.subscriptions()} of {wanted} subscriptions matched within {longest:g} s"
            hint = "Check topic and type with: microros-gen topic list -t"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9820")], status=1)
        if now - reported >= 1:
            reported = now
            show(f"Waiting for at least {wanted} matching subscription(s)...")
        peer.spin_once(TURN_S)
