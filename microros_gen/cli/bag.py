# SPDX-License-Identifier: Apache-2.0
"""`microros-gen bag`: recordings of topics."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.ros_tools import graph_options, on_graph, show, until_interrupted
from microros_gen.diagnostics import Diagnostic, UserError, nearest

if TYPE_CHECKING:
    from collections.abc import Mapping

    from microros_gen.cli.ros_tools import Interrupted
    from microros_gen.ros.endpoints import RawPublisher
    from microros_gen.ros.peer import Peer
    from microros_gen.ros_tools.mcap_reader import McapReader

_NS = 1_000_000_000
_DELIVERY_S = 0.5
"""Time for delivery after the last message."""
_UNITS = ((1 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB"))
_file = click.argument("file", type=click.Path(path_type=Path, exists=True, dir_okay=False))


@click.group(cls=CommandGroup)
def command() -> None:
    """Play and describe recordings of `microros-gen topic record`, as `ros2 bag` does.

    \b
    microros-gen bag info drive.mcap
    microros-gen bag play --rate 2 drive.mcap
    """


@command.command("info")
@_file
def info_command(file: Path) -> None:
    """Show duration, topics, types and numbers of messages of a recording. Needs no ROS 2.

    \b
    microros-gen bag info drive.mcap
    """
    reader = _read(file)
    lines = [
        ("Files:", str(file)),
        ("Bag size:", _size(file.stat().st_size)),
        ("Storage id:", "mcap"),
        ("Duration:", f"{(reader.last - reader.first) / _NS:.9f}s"),
        ("Start:", _time(reader.first)),
        ("End:", _time(reader.last)),
        ("Messages:", str(reader.counts.total())),
    ]
    if not reader.complete:
        lines.append(("Incomplete:", "its recorder did not end in order"))
    topics = [
        f"Topic: {channel.topic} | Type: {channel.type or 'unknown'} | Count: {reader.counts[number]}"
        f" | Serialization Format: {channel.encoding}"
        for number, channel in sorted(reader.channels.items(), key=lambda each: each[1].topic)
    ]
    lines += [("Topic information:" if not place else "", topic) for place, topic in enumerate(topics)]
    click.echo("".join(f"{name:<19}{text}\n" for name, text in lines), nl=False)


@command.command("play")
@_file
@click.option(
    "-r",
    "--rate",
    type=click.FloatRange(0, min_open=True),
    default=1.0,
    show_default=True,
    metavar="FACTOR",
    help="Play so many times as fast as recorded.",
)
@click.option("-l", "--loop", is_flag=True, help="Begin again at the end, until Ctrl-C.")
@click.option("--topics", multiple=True, metavar="TOPIC", help="Play only this topic; repeatable.")
@click.option(
    "--start-offset",
    type=click.FloatRange(0),
    default=0.0,
    metavar="SECONDS",
    help="Begin so many seconds after the start of the recording.",
)
@graph_options
def play_command(
    file: Path, rate: float, loop: bool, topics: tuple[str, ...], start_offset: float, **graph: Any
) -> None:
    """Publish the messages of a recording at their times, with the QoS of the recorded publishers.

    Types come from the file: no interface file is needed. Begins once the subscriptions that exist are discovered.

    \b
    microros-gen bag play drive.mcap
    microros-gen bag play --loop --rate 0.5 --topics /odom --topics /scan --start-offset 10 drive.mcap
    """
    if not math.isfinite(rate) or not math.isfinite(start_offset):
        raise click.BadParameter("it must be finite", param_hint="'--rate' and '--start-offset'")
    reader = _read(file)
    chosen = _chosen(reader, topics)
    begin = reader.first + round(start_offset * _NS)
    with on_graph(**graph) as (peer, discovery), until_interrupted() as interrupted:
        publishers = {number: _publisher(peer, reader, number) for number in chosen}
        discovery.settle()
        played = 0
        while True:
            with _readable(file):
                found = _play(reader, publishers, begin, rate, interrupted)
            played += found
            if interrupted or not loop or not found:
                break
        interrupted.wait(_DELIVERY_S)
    show(f"played {played} messages of {len({reader.channels[number].topic for number in chosen})} topics")


def _play(
    reader: McapReader,
    publishers: Mapping[int, RawPublisher],
    begin: int,
    rate: float,
    interrupted: Interrupted,
) -> int:
    """Publish from the time `begin` of the recording on, `rate` times as fast; return the number of messages."""
    played, started = 0, time.monotonic()
    for message in reader.messages(publishers, begin):
        due = started + (message.time - begin) / _NS / rate
        if interrupted.wait(max(0.0, due - time.monotonic())):
            break
        publishers[message.channel].publish(message.data)
        played += 1
    return played


def _publisher(peer: Peer, reader: McapReader, number: int) -> RawPublisher:
    from microros_gen.interfaces.types import TypeName
    from microros_gen.ros_tools.playing import offered_qos, type_hash_of

    channel = reader.channels[number]
    qos, differ = offered_qos(channel)
    if differ:
        click.echo(f"{channel.topic}: its publishers had different QoS: using the strongest", err=True)
    name = TypeName(*channel.type.split("/"))
    return peer.publisher_raw(channel.topic, name, type_hash_of(channel), qos)


def _chosen(reader: McapReader, topics: tuple[str, ...]) -> list[int]:
    """Return the channels to play. UserError for unknown topics and for messages that cannot be published."""
    from microros_gen.ros_tools.discovery import absolute

    wanted = {absolute(topic) for topic in topics}
    known = {channel.topic for channel in reader.channels.values()}
    found: list[Diagnostic] = []
    for topic in sorted(wanted - known):
        hint = nearest(topic, known) or f"Available: {', '.join(sorted(known)) or 'none'}"
        found.append(Diagnostic(f"the recording has no topic '{topic}'", hint=hint, id="MG-9800"))
    chosen = [number for number, channel in reader.channels.items() if not wanted or channel.topic in wanted]
    for channel in (reader.channels[number] for number in chosen):
        if channel.encoding != "cdr" or channel.type.count("/") != 2:
            what = f"{channel.encoding} of type '{channel.type}'"
            message = f"{channel.topic} cannot be played: its messages are {what}"
            hint = "Name the topics to play: --topics TOPIC"
            found.append(Diagnostic(message, hint=hint, id="MG-9829"))
    if found:
        raise UserError(found)
    return chosen


def _read(file: Path) -> McapReader:
    from microros_gen.ros_tools.mcap_reader import McapReader

    with _readable(file):
        return McapReader(file)


@contextmanager
def _readable(file: Path) -> Iterator[None]:
    """Turn what is wrong with a file into a diagnostic."""
    from microros_gen.ros_tools.mcap_reader import McapError

    try:
        yield
    except (McapError, OSError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        hint = "Record one: microros-gen topic record -a -o drive.mcap"
        raise UserError([Diagnostic(f"{file} cannot be read: {why}", hint=hint, id="MG-9828")]) from error


def _size(count: int) -> str:
    for factor, unit in _UNITS:
        if count >= factor:
            return f"{count / factor:.1f} {unit}"
    return f"{count} B"


def _time(nanoseconds: int) -> str:
    seconds, rest = divmod(nanoseconds, _NS)
    local = time.strftime("%b %d %Y %H:%M:%S", time.localtime(seconds))
    return f"{local}.{rest:09} ({seconds}.{rest:09})"
