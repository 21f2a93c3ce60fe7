# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes check`: proves properties of a model file."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.modes.options import model_argument
from microros_gen.cli.options import format_option, json_text
from microros_gen.cli.terminal import echo_found
from microros_gen.modes.stability import MOST_COMBINATIONS


@click.command()
@model_argument
@click.option(
    "--application",
    "applications",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Application file whose nodes declare the parameters that modes set, or have modes; can be repeated.",
)
@click.option(
    "--limit",
    type=click.IntRange(min=1),
    default=MOST_COMBINATIONS,
    show_default=True,
    help="Different combinations of failures that are kept of a system; with more it is not proven.",
)
@format_option
def check_command(model: Path, applications: tuple[Path, ...], limit: int, kind: str) -> int:
    """Prove that a system of nodes with modes works as modeled, or show what contradicts it.

    Proven are: the parameters of modes exist and have values that the nodes accept; start orders are not circular; the
    modes of a system differ from outside; each mode is reached; rules end in a stable state for every combination of
    failed nodes; no part is commanded twice at once.

    Exit status: 0 all proven; 2 something is wrong; 1 something is not proven.

    \b
    microros-gen modes check robot.yaml
    microros-gen modes check robot.yaml --application arm/microros.yaml --application base/microros.yaml
    """
    from microros_gen.modes.verification import check

    report = check(model, applications, limit)
    if kind == "json":
        click.echo(json_text(report.data()), nl=False)
        return report.exit_status
    click.echo(report.text(), nl=False)
    for diagnostic in report.diagnostics:
        echo_found(f"{diagnostic.render()}\n")
    return report.exit_status
