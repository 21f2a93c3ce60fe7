# SPDX-License-Identifier: Apache-2.0
"""What the commands on a ROS graph share: their options, their node, and errors as diagnostics."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from microros_gen.cli.options import interface_path_option
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer
    from microros_gen.ros.qos import Qos
    from microros_gen.ros_tools.discovery import Discovery

F = TypeVar("F", bound=Callable[..., Any])
TURN_S = 0.1
_QOS = "qos_"
_PRESETS = (
    "default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
)

domain_option = click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)
stdin_option = click.option(
    "--stdin", "from_stdin", is_flag=True, help="Read the values from standard input."
)


def graph_options(function: F, *synonyms: str) -> F:
    """Add the options of every command on a graph; they are passed on as `**graph` to `on_graph`.

    `synonyms`: further names of --spin-time.
    """
    for option in (
        _without_effect("--no-daemon"),
        click.option(
            "--spin-time",
            *synonyms,
            "spin_time",
            type=click.FloatRange(0, 3600),
            metavar="SECONDS",
            default=3.0,
            show_default=True,
            help="Longest wait until nodes, topics and services are discovered.",
        ),
        domain_option,
        interface_path_option,
    ):
        function = option(function)
    return function


def node_options(function: F) -> F:
    """Add the options of a command on one node; a command of ros2 with all of its options has the same effect."""
    return _without_effect("--include-hidden-nodes")(graph_options(function))


def parameter_options(function: F) -> F:
    """Add the options of a command on the parameters of one node."""
    return _without_effect("--include-hidden-nodes")(graph_options(function, "--timeout"))


def _without_effect(name: str) -> Callable[[F], F]:
    """Return an option of ros2 that changes nothing here: hidden nodes are found, and there is no daemon."""
    return click.option(name, is_flag=True, hidden=True, expose_value=False)


def sim_time_option(function: F) -> F:
    """Add -s: the time of the graph is that of a simulation."""
    return click.option(
        "-s",
        "--use-sim-time",
        is_flag=True,
        help="Use the time of a simulation, which is published on /clock.",
    )(function)


def text_options(function: F) -> F:
    """Add the options for how much of a message is printed, and in which form."""
    for option in reversed(
        (
            click.option(
                "--csv",
                is_flag=True,
                help="Print the values of all members on one line, separated by commas.",
            ),
            click.option("-f", "--full-length", is_flag=True, help="Print arrays and texts of any length."),
            click.option(
                "-l",
                "--truncate-length",
                type=click.IntRange(0),
                default=128,
                show_default=True,
                metavar="N",
                help="Print at most so many elements and characters of each.",
            ),
            click.option("--no-arr", is_flag=True, help="Print type and length of arrays only."),
            click.option("--no-str", is_flag=True, help="Print the length of texts only."),
            click.option(
                "--flow-style", is_flag=True, help="Print each message on one line, as YAML with braces."
            ),
        )
    ):
        function = option(function)
    return function


def qos_options(preset: str) -> Callable[[F], F]:
    """Add the options for the QoS; `preset` is the default of --qos-profile."""

    def add(function: F) -> F:
        for option in reversed(
            (
                click.option(
                    "--qos-profile",
                    type=click.Choice(_PRESETS),
                    metavar="NAME",
                    help=f"Preset: {', '.join(_PRESETS)}. Default: {preset}.",
                ),
                click.option(
                    "--qos-depth", type=click.IntRange(1, 100_000), metavar="N", help="Samples to keep."
                ),
                click.option(
                    "--qos-history",
                    type=click.Choice(("keep_last", "keep_all")),
                    help="Overrides the preset.",
                ),
                click.option(
                    "--qos-reliability",
                    type=click.Choice(("reliable", "best_effort")),
                    help="Overrides the preset.",
                ),
                click.option(
                    "--qos-durability",
                    type=click.Choice(("volatile", "transient_local")),
                    help="Overrides the preset.",
                ),
                click.option(
                    "--qos-liveliness",
                    type=click.Choice(("automatic", "manual_by_topic")),
                    help="Overrides the preset.",
                ),
                click.option(
                    "--qos-liveliness-lease-duration-seconds",
                    type=click.FloatRange(0, min_open=True),
                    metavar="SECONDS",
                    help="Overrides the preset.",
                ),
            )
        ):
            function = option(function)
        return function

    return add


def chosen_qos(preset: str, options: dict[str, Any]) -> tuple[Qos, bool, dict[str, Any]]:
    """Return the QoS that the options of `qos_options` choose, whether any was chosen, and the other options."""
    from dataclasses import replace

    from microros_gen.ros_tools.quality import PRESETS

    others = {name: value for name, value in options.items() if not name.startswith(_QOS)}
    qos_values = {name.removeprefix(_QOS): options[name] for name in options.keys() - others.keys()}
    chosen = {name: value for name, value in qos_values.items() if value is not None}
    qos = PRESETS[chosen.get("profile", preset)]
    changes: dict[str, Any] = {}
    if "depth" in chosen:
        changes["depth"] = chosen["depth"]
    if chosen.get("history") == "keep_all":
        changes["depth"] = None
    if "reliability" in chosen:
        changes["reliable"] = chosen["reliability"] == "reliable"
    if "durability" in chosen:
        changes["transient_local"] = chosen["durability"] == "transient_local"
    if "liveliness" in chosen:
        changes["manual_liveliness"] = chosen["liveliness"] == "manual_by_topic"
    if "liveliness_lease_duration_seconds" in chosen:
        changes["lease_ms"] = max(1, round(chosen["liveliness_lease_duration_seconds"] * 1000))
    return replace(qos, **changes), bool(chosen), others


@contextmanager
def on_graph(
    spin_time: float, domain: int | None, interface_paths: tuple[Path, ...], node: str | None = None
) -> Iterator[tuple[Peer, Discovery]]:
    """Give the node of a command and what it discovers; `node` names it, else its name is a hidden one.

    Raises UserError without a usable ROS 2, and for what ROS 2 or a node refuses.
    """
    from microros_gen.cli.ros_node import node_of
    from microros_gen.ros.errors import CodecError, RosError
    from microros_gen.ros_tools.discovery import Discovery

    name = node or f"_microros_gen_{os.getpid()}"
    try:
        with node_of(name, domain, _unusable, interface_paths) as peer:
            yield peer, Discovery(peer, spin_time)
    except (RosError, CodecError) as error:
        raise UserError([Diagnostic(str(error), id="MG-9810")], status=1) from error


class Interrupted:
    """Becomes true when SIGINT or SIGTERM arrives within `until_interrupted`."""

    def __init__(self) -> None:
        self._event = threading.Event()

    def __bool__(self) -> bool:
        return self._event.is_set()

    def stop(self) -> None:
        """Become true."""
        self._event.set()

    def wait(self, seconds: float) -> bool:
        """Sleep, at most until it is true; return whether it is."""
        return self._event.wait(seconds)


@contextmanager
def until_interrupted() -> Iterator[Interrupted]:
    """Let SIGINT and SIGTERM end a loop instead of the program."""
    from microros_gen.agent.server import stopped_by_signals

    interrupted = Interrupted()
    with stopped_by_signals(interrupted):
        yield interrupted


def values_text(values: str | None, from_stdin: bool) -> str:
    """Return the text of the values; UsageError for both."""
    if from_stdin and values is not None:
        raise click.UsageError("--stdin takes the place of the values: give one of them.")
    return sys.stdin.read() if from_stdin else values or ""


def show(text: str) -> None:
    """Print lines at once, also into a pipe."""
    click.echo(text)
    sys.stdout.flush()


def _unusable(error: Any) -> Diagnostic:
    return Diagnostic(f"the command {error.reason}", hint=error.hint, id="MG-9817")
