# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic record`: records topics to an MCAP file."""

from __future__ import annotations

import re
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import click

from microros_gen import __version__
from microros_gen.cli.ros_tools import TURN_S, graph_options, on_graph, until_interrupted
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.ros_tools.discovery import Discovery
    from microros_gen.ros_tools.recording import Recorder

_LOOK_S = 0.5
"""How often new topics are looked for."""


@click.command()
@click.argument("topics", nargs=-1)
@click.option(
    "-a", "--all", "every", is_flag=True, help="Record all topics that are not hidden, new ones too."
)
@click.option("-e", "--regex", metavar="EXPRESSION", help="Record the topics that match, new ones too.")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="The file. Default: recording_DATE-TIME.mcap.",
)
@click.option(
    "-d",
    "--duration",
    type=click.FloatRange(0, min_open=True),
    metavar="SECONDS",
    help="End after this time. Default: at Ctrl-C.",
)
@graph_options
def record_command(
    topics: tuple[str, ...],
    every: bool,
    regex: str | None,
    output: Path | None,
    duration: float | None,
    **graph: Any,
) -> None:
    """Record topics to an MCAP file, which `ros2 bag play` and Foxglove read.

    Topics that do not exist yet are recorded once they do. Each has the QoS that all its publishers match.

    \b
    microros-gen topic record /odom /scan
    microros-gen topic record -a -o drive.mcap
    """
    from microros_gen.ros_tools.discovery import absolute
    from microros_gen.ros_tools.mcap import McapWriter
    from microros_gen.ros_tools.recording import Recorder

    if not (topics or every or regex):
        raise click.UsageError("Name topics, or --all, or --regex.")
    pattern = _pattern(regex)
    path = output or Path(time.strftime("recording_%Y%m%d-%H%M%S.mcap"))
    if path.exists():
        raise _refused(path, "it exists already")
    names = {absolute(topic) for topic in topics}
    with on_graph(**graph) as (peer, discovery), until_interrupted() as interrupted, _created(path) as file:
        writer = McapWriter(file, f"microros-gen {__version__}")
        recorder = Recorder(peer, writer, lambda line: click.echo(line, err=True))
        click.echo(f"recording to {path}", err=True)
        end = None if duration is None else time.monotonic() + duration
        look = 0.0
        try:
            while not interrupted and (end is None or time.monotonic() < end):
                if time.monotonic() >= look:
                    look = time.monotonic() + _LOOK_S
                    _add_new(recorder, discovery, names, every, pattern)
                peer.spin_once(TURN_S)
        finally:
            writer.close()
    click.echo(
        f"recorded {recorder.messages} messages ({recorder.size} bytes) of {len(recorder.topics)} topics"
    )


def _created(path: Path) -> BinaryIO:
    """Return a new file; UserError where there is one, also one that appeared meanwhile, or none can be."""
    try:
        return path.open("xb")
    except FileExistsError as error:
        raise _refused(path, "it exists already") from error
    except OSError as error:
        raise _refused(path, error.strerror or str(error)) from error


def _refused(path: Path, why: str) -> UserError:
    other = path.with_name(f"{path.stem}_2{path.suffix}")
    hint = f"Choose another one: -o {other if path.parent.is_dir() else other.name}"
    return UserError([Diagnostic(f"{path} cannot be recorded to: {why}", hint=hint, id="MG-9822")])


def _pattern(regex: str | None) -> re.Pattern[str] | None:
    try:
        return None if regex is None else re.compile(regex)
    except re.error as error:
        message = f"--regex: {error}"
        raise UserError([Diagnostic(message, hint="Example: '/arm/.*'", id="MG-9823")]) from error


def _add_new(
    recorder: Recorder, discovery: Discovery, names: set[str], every: bool, pattern: re.Pattern[str] | None
) -> None:
    from microros_gen.ros_tools.discovery import is_hidden

    for name, types in discovery.graph.topics():
        chosen = name in names or (every and not is_hidden(name)) or bool(pattern and pattern.search(name))
        if chosen and name not in recorder.topics and discovery.publishers(name):
            if len(types) > 1:
                recorder.topics.add(name)
                click.echo(f"{name}: not recorded, it has several types: {', '.join(types)}", err=True)
            else:
                recorder.add(name, types[0])
