# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes simulate`: plays a script of requests and failures."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.modes.options import format_option, json_text, model_argument
from microros_gen.modes.reader import read_model
from microros_gen.modes.script import read_script
from microros_gen.modes.simulation import simulate


@click.command()
@model_argument
@click.argument("script", metavar="SCRIPT", type=click.Path(path_type=Path))
@format_option
def simulate_command(model: Path, script: Path, kind: str) -> int:
    """Play the requests and failures of SCRIPT on a system of nodes with modes, without nodes.

    Exit status: 0; 1 when rules oscillate.

    \b
    microros-gen modes simulate robot.yaml faults.yaml
    """
    system = read_model(model)
    played = simulate(system, read_script(script, system))
    click.echo(json_text(played.data()) if kind == "json" else played.text(), nl=False)
    return 0 if played.is_stable else 1
