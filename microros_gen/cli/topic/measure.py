# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic hz | bw | delay`: rates, sizes and delays of the messages of a topic."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.ros_tools import (
    TURN_S,
    graph_options,
    on_graph,
    show,
    sim_time_option,
    until_interrupted,
)
from microros_gen.cli.topic.subscribing import awaited_topic_type, topic_qos
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.ros.known_types import KnownType
    from microros_gen.ros.peer import Peer
    from microros_gen.ros_tools.clocks import GraphClock

_PERIOD_S = 1.0


def _window_option(default: int) -> Callable[[Any], Any]:
    return click.option(
        "-w",
        "--window",
        type=click.IntRange(1, 10_000_000),
        default=default,
        show_default=True,
        metavar="N",
        help="Use the last N messages.",
    )


@click.command()
@click.argument("topic")
@_window_option(10_000)
@click.option(
    "--filter", "expression", metavar="EXPRESSION", help="Count only messages `m` for which this holds."
)
@sim_time_option
@click.option(
    "--wall-time", is_flag=True, help="Measure with the clock of this machine also with --use-sim-time."
)
@graph_options
def hz_command(
    topic: str, window: int, expression: str | None, use_sim_time: bool, wall_time: bool, **graph: Any
) -> None:
    """Print the rate of a topic each second. EXPRESSION is that of `topic echo`.

    With --use-sim-time it is the rate in the time of the simulation.

    \b
    microros-gen topic hz /imu
    microros-gen topic hz --filter 'm.data > 3' /count
    """
    from microros_gen.ros_tools.rates import Intervals

    intervals = Intervals(window)

    def receive(
        data: bytes, info: Mapping[str, Any], known: KnownType | None, clock: GraphClock | None
    ) -> None:
        now = time.monotonic_ns() if clock is None else clock.now_ns()
        if clock is None or now:  # nothing is measured before the first message of /clock
            intervals.add(now)

    _measure(
        topic,
        graph,
        receive,
        lambda: intervals.text(),
        expression=expression,
        simulated=use_sim_time and not wall_time,
    )


@click.command()
@click.argument("topic")
@_window_option(100)
@graph_options
def bw_command(topic: str, window: int, **graph: Any) -> None:
    """Print the bandwidth of a topic each second: its messages with their encapsulation, without headers of DDS.

    \b
    microros-gen topic bw /scan
    """
    from microros_gen.ros_tools.rates import Bandwidth

    bandwidth = Bandwidth(window)
    _measure(
        topic,
        graph,
        lambda data, info, known, clock: bandwidth.add(time.monotonic_ns(), len(data)),
        lambda: bandwidth.text(time.monotonic_ns()),
        subscribed=True,
    )


@click.command()
@click.argument("topic")
@_window_option(10_000)
@sim_time_option
@graph_options
def delay_command(topic: str, window: int, use_sim_time: bool, **graph: Any) -> None:
    """Print the delay of a topic each second: from the stamp in the header of its messages to their arrival.

    \b
    microros-gen topic delay /imu
    """
    from microros_gen.ros_tools.rates import Delays

    delays = Delays(window)

    def receive(
        data: bytes, info: Mapping[str, Any], known: KnownType | None, clock: GraphClock | None
    ) -> None:
        stamp = known and known.codec.decode(known.name, data).get("header", {}).get("stamp")
        if not stamp:
            message = f"the messages of {topic} have no header with a stamp"
            hint = "Measure their rate instead: microros-gen topic hz"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9821")], status=1)
        now = time.time_ns() if clock is None else clock.now_ns()
        if clock is None or now:
            delays.add(now, stamp["sec"] * 1_000_000_000 + stamp["nanosec"])

    _measure(topic, graph, receive, lambda: delays.text(), known_type=True, simulated=use_sim_time)


def _measure(
    topic: str,
    graph: dict[str, Any],
    receive: Callable[[bytes, Mapping[str, Any], KnownType | None, GraphClock | None], None],
    text: Callable[[], str | None],
    subscribed: bool = False,
    known_type: bool = False,
    expression: str | None = None,
    simulated: bool = False,
) -> None:
    """Pass the messages of a topic to `receive`, and print `text()` each second if any have arrived since.

    `expression`: only those for which it holds. UserError for one that is invalid. `simulated`: `receive` gets the
    clock of the graph.
    """
    from microros_gen.ros_tools.clocks import GraphClock
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.expressions import Filter
    from microros_gen.ros_tools.quality import PRESETS

    name = absolute(topic)
    with on_graph(**graph) as (peer, discovery), until_interrupted() as interrupted:
        type_name = awaited_topic_type(discovery, name, lambda: bool(interrupted))
        if type_name is None:
            return
        qos = topic_qos(discovery, name, PRESETS["sensor_data"])
        filtered = expression is not None
        known = peer.types.message(type_name) if known_type or filtered else None
        holds = (
            Filter(expression or "", known.name, known.interfaces.messages) if known and filtered else None
        )
        clock = GraphClock(peer) if simulated else None
        arrived = [0, 0]

        def count(data: bytes, info: Mapping[str, Any]) -> None:
            if known is not None and holds is not None and not holds(known.codec.decode(known.name, data)):
                return
            arrived[0] += 1
            receive(data, info, known, clock)

        _subscribe(peer, name, type_name, count, qos)
        if subscribed:
            show(f"Subscribed to [{name}]")
        due = time.monotonic() + _PERIOD_S
        while not interrupted:
            peer.spin_once(max(0.0, min(TURN_S, due - time.monotonic())))
            if time.monotonic() >= due:
                due += _PERIOD_S
                line = text() if arrived[0] > arrived[1] else None
                arrived[1] = arrived[0]
                if line is not None:
                    show(line)


def _subscribe(peer: Peer, topic: str, type_name: str, receive: Any, qos: Any) -> None:
    """Subscribe with the hash that the publishers announce: no interface file is needed."""
    from microros_gen.interfaces.types import TypeName
    from microros_gen.ros_tools.quality import hash_text

    hashes = [text for text in map(hash_text, peer.graph().publishers(topic)) if text]
    peer.subscribe_raw(topic, TypeName(*type_name.split("/")), hashes[0] if hashes else None, receive, qos)
