# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes graph`: draws a model file."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.modes.options import model_argument


@click.command()
@model_argument
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the picture to this file instead of stdout.",
)
def graph_command(model: Path, output: Path | None) -> None:
    """Draw the systems, nodes, modes and rules of a model file as SVG.

    \b
    microros-gen modes graph robot.yaml -o robot.svg
    """
    from microros_gen.modes.picture import draw
    from microros_gen.modes.reader import read_model

    picture = draw(read_model(model))
    if output is None:
        click.echo(picture, nl=False)
    else:
        output.write_text(picture, encoding="utf-8", newline="\n")
