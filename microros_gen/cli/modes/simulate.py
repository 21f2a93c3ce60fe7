# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes simulate`: plays a script of requests and faults."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.modes.options import (
    application_option,
    model_argument,
    reconfigure_option,
    report_option,
    timeout_option,
)
from microros_gen.cli.options import format_option, json_text
from microros_gen.mode_manager.settings import Settings


@click.command()
@model_argument
@click.argument("script", metavar="SCRIPT", type=click.Path(path_type=Path))
@application_option
@click.option(
    "--mode-services",
    "with_services",
    multiple=True,
    metavar="NODE",
    help="Node that serves its modes itself, as firmware does (nodes of --application do); can be repeated.",
)
@reconfigure_option
@timeout_option
@report_option
@format_option
def simulate_command(
    model: Path,
    script: Path,
    applications: tuple[Path, ...],
    with_services: tuple[str, ...],
    reconfigure: tuple[str, ...],
    timeout: float,
    report_timeout: float,
    kind: str,
) -> int:
    """Play the requests and faults of SCRIPT with the decisions of the mode manager, without nodes.

    Time is simulated, too: nothing is waited for. Exit status: 0; 1 when rules oscillate, or parts never come to rest.

    \b
    microros-gen modes simulate robot.yaml faults.yaml
    """
    from microros_gen.cli.modes.devices import read_system
    from microros_gen.mode_manager.scope import select_nodes, select_scope
    from microros_gen.mode_manager.simulation import simulate
    from microros_gen.modes.script import read_script

    system, devices = read_system(model, applications)
    scope = select_scope(system)
    reconfigured = select_nodes(system, scope, reconfigure)
    settings = Settings(call_s=timeout, repeat_s=report_timeout, reconfigured=reconfigured)
    services = select_nodes(system, scope, with_services) | devices
    played = simulate(system, read_script(script, system), settings, services)
    click.echo(json_text(played.data()) if kind == "json" else played.text(), nl=False)
    return 0 if played.is_stable else 1
