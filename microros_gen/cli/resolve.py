# SPDX-License-Identifier: Apache-2.0
"""`microros-gen resolve`: what a selection brings, and why."""

from __future__ import annotations

from typing import Any

import click

from microros_gen.cli.options import selection_options


@click.command()
@selection_options
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "dot")),
    default="table",
    show_default=True,
    help="Tables, JSON, or a graph for Graphviz.",
)
def command(kind: str, **options: Any) -> None:
    """Print components, XRCE profiles, pools and sizes of a selection, each with its reason.

    Works for every profile; sizes are shown only if all of its components are ready.

    \b
    microros-gen resolve --profile pure_sender --interface sensor_msgs/msg/Imu
    microros-gen resolve -c microros.yaml --format dot | dot -Tsvg -o selection.svg
    """
    from microros_gen.cli.selection_report import print_selection

    print_selection(kind, options)
