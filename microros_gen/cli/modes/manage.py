# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes manage`: the mode manager."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.modes.options import (
    application_option,
    domain_option,
    model_argument,
    modes_peer,
    reconfigure_option,
    report_option,
    timeout_option,
)
from microros_gen.mode_manager.settings import Settings

if TYPE_CHECKING:
    from microros_gen.mode_manager.scope import Scope


@click.command()
@model_argument
@application_option
@click.option(
    "--scope",
    "roots",
    multiple=True,
    metavar="PART",
    help="Manage this system and all below it; can be repeated. Default: all of the file.",
)
@click.option(
    "--without",
    multiple=True,
    metavar="SYSTEM",
    help="Subsystem that another manager manages: it is used by its services; can be repeated.",
)
@reconfigure_option
@timeout_option
@report_option
@domain_option
def manage_command(
    model: Path,
    applications: tuple[Path, ...],
    roots: tuple[str, ...],
    without: tuple[str, ...],
    reconfigure: tuple[str, ...],
    timeout: float,
    report_timeout: float,
    domain: int | None,
) -> None:
    """Bring the nodes of a system into the states and modes that somebody requests, and apply rules.

    A ROS node that serves ~/change_state, ~/change_mode, ~/get_state, ~/get_mode and more for each system, and
    publishes on /diagnostics. Nodes are reached by their life cycle and mode services; the modes of nodes without
    mode services are set and inferred by their parameters. If another manager has one of the parts, this one waits.

    \b
    microros-gen modes manage robot.yaml
    microros-gen modes manage robot.yaml --scope base
    microros-gen modes manage robot.yaml --without base
    microros-gen modes manage robot.yaml --application arm/microros.yaml

    Prints 'mode manager ready: PARTS' on stdout, and failures, rules and changes by others on stderr. SIGINT and
    SIGTERM end it with status 0.
    """
    from microros_gen.agent.server import stopped_by_signals
    from microros_gen.cli.modes.devices import read_system
    from microros_gen.mode_manager.scope import select_nodes, select_scope
    from microros_gen.mode_manager.server import ModeManager
    from microros_gen.mode_manager.turns import ManagerInTurn

    system, _ = read_system(model, applications)
    scope = select_scope(system, roots, without)
    reconfigured = select_nodes(system, scope, reconfigure)
    settings = Settings(call_s=timeout, repeat_s=report_timeout, reconfigured=reconfigured)
    turn = ManagerInTurn(
        scope,
        lambda name: modes_peer(name, domain),
        lambda peer: ModeManager(peer, system, scope, _log, settings),
        _Report(scope),
    )
    with stopped_by_signals(turn):
        turn.run()


def _log(line: str) -> None:
    click.echo(line, err=True)


class _Report:
    """Prints who manages."""

    def __init__(self, scope: Scope) -> None:
        self._scope = scope

    def waits(self, other: str, part: str) -> None:
        """Print that another one manages."""
        _log(f"'{part}' is managed by another node ({other}): this manager waits")

    def ready(self) -> None:
        """Print that this one manages."""
        click.echo(f"mode manager ready: {', '.join(self._scope.roots)}")
