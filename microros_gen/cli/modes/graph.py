# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes graph`: draws a model file."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.modes.options import application_option, model_argument


@click.command()
@model_argument
@application_option
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the picture to this file instead of stdout.",
)
def graph_command(model: Path, applications: tuple[Path, ...], output: Path | None) -> None:
    """Draw the systems, nodes, modes and rules of a model file as SVG.

    \b
    microros-gen modes graph robot.yaml -o robot.svg
    """
    from microros_gen.cli.modes.devices import read_system
    from microros_gen.modes.picture import draw

    picture = draw(read_system(model, applications)[0])
    if output is None:
        click.echo(picture, nl=False)
    else:
        output.write_text(picture, encoding="utf-8", newline="\n")
