# SPDX-License-Identifier: Apache-2.0
"""The options that every command on a selection shares."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from microros_gen.cli.offers import component_changes, interface_names, profile_names, target_names

F = TypeVar("F", bound=Callable[..., Any])


interface_path_option = click.option(
    "--interface-path",
    "interface_paths",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Package, folder of packages or colcon workspace, searched before ament, pip and the included interfaces.",
)


def selection_options(function: F) -> F:
    """Add the options; the command gets them as keyword arguments of `Options`."""
    for option in reversed(
        [
            click.option(
                "-c",
                "--config",
                type=click.Path(path_type=Path),
                help="Application file. Default: microros.yaml in the current folder, if it exists.",
            ),
            click.option(
                "--profile",
                "profiles",
                multiple=True,
                metavar="NAME",
                shell_complete=profile_names,
                help="Profile, built-in or a file; can be repeated. Replaces `profiles` of the file.",
            ),
            click.option(
                "--component",
                "components",
                multiple=True,
                metavar="[+-]NAME",
                shell_complete=component_changes,
                help="Component to add, or to remove (-). Extends `components` of the file.",
            ),
            click.option(
                "--interface",
                "interfaces",
                multiple=True,
                metavar="PKG[/Type]",
                shell_complete=interface_names,
                help="Message, service, action, or whole package. Extends `interfaces` of the file."
                " Default: std_msgs/msg/Int32.",
            ),
            interface_path_option,
            click.option(
                "--target",
                metavar="NAME",
                shell_complete=target_names,
                help="Target, see `microros-gen targets`. Default: host.",
            ),
            click.option(
                "--agent",
                metavar="HOST:PORT[,…]|DEVICE",
                help="Address of the agent (default: 127.0.0.1:8888), several with commas, or a serial device"
                " (/dev/ttyACM0).",
            ),
        ]
    ):
        function = option(function)
    return function


selftest_option = click.option(
    "--selftest",
    is_flag=True,
    help="With OUT/selftest: a program that checks the port and each message type on the board itself.",
)


def output_option(function: F) -> F:
    """Add `-o OUT`."""
    return click.option(
        "-o",
        "--output",
        type=click.Path(path_type=Path),
        metavar="OUT",
        help="Output folder, managed by the tool. Default: build/<profiles joined by +>.",
    )(function)


format_option = click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json")),
    default="table",
    show_default=True,
    help="Lines for people, or JSON for programs.",
)

file_option = click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write to FILE instead of standard output.",
)


def write_result(text: str, output: Path | None) -> None:
    """Write what `file_option` is about: to the file, or to standard output."""
    if output is None:
        click.echo(text, nl=False)
    else:
        output.write_text(text, encoding="utf-8", newline="\n")


def image_option(words: str) -> Callable[[F], F]:
    """Add `--image FILE`; `words` are its help."""
    kind = click.Path(path_type=Path, dir_okay=False, exists=True)
    return click.option("--image", type=kind, metavar="FILE", help=words)


map_option = click.option(
    "--map",
    "linker_map",
    type=click.Path(path_type=Path, dir_okay=False, exists=True),
    metavar="FILE.map",
    help="Linker map of the image (-Wl,-Map=FILE.map). Default: the one next to the image.",
)


def check_map(image: Path | None, linker_map: Path | None) -> None:
    """Refuse a map without the image that it is of."""
    if linker_map is not None and image is None:
        raise click.UsageError("--map needs the --image that it belongs to.")


def json_text(data: dict[str, Any]) -> str:
    """Return data as JSON with a line end."""
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
