# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes monitor`: shows what mode managers report."""

from __future__ import annotations

import json
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.modes.options import application_option, domain_option, model_argument, modes_peer
from microros_gen.cli.options import format_option, json_text

if TYPE_CHECKING:
    from microros_gen.mode_manager.monitor import Monitor, Overview

_CLEAR = "\x1b[2J\x1b[H"


@click.command()
@model_argument
@application_option
@click.option(
    "--once", is_flag=True, help="Print the parts when all are known and none is on its way, and end."
)
@click.option(
    "--wait",
    type=click.FloatRange(min=0),
    default=5.0,
    show_default=True,
    metavar="S",
    help="With --once: seconds after which the parts are printed as they are.",
)
@click.option(
    "--page",
    metavar="HOST:PORT",
    help="Show the parts in a browser too, at an address of this machine such as 127.0.0.1:8080; port 0: a free one.",
)
@format_option
@domain_option
def monitor_command(
    model: Path,
    applications: tuple[Path, ...],
    once: bool,
    wait: float,
    page: str | None,
    kind: str,
    domain: int | None,
) -> int:
    """Show target and actual state of the parts of a system, as mode managers report them.

    The table is printed again after each change; with --format json, one line of JSON is. Nothing is commanded.

    Exit status: 0; with --once 1 if a part is not in its target, or no manager reports it. SIGINT and SIGTERM end it
    with status 0.

    \b
    microros-gen modes monitor robot.yaml
    microros-gen modes monitor robot.yaml --once --format json
    microros-gen modes monitor robot.yaml --page 127.0.0.1:8080
    """
    from microros_gen.agent.server import stopped_by_signals
    from microros_gen.cli.modes.devices import read_system
    from microros_gen.mode_manager.diagnosis import OK
    from microros_gen.mode_manager.monitor import Monitor
    from microros_gen.mode_manager.page import check_place, served_page

    system = read_system(model, applications)[0]
    if page is not None:
        check_place(page)
    with modes_peer("mode_monitor", domain) as peer, ExitStack() as stack:
        monitor = Monitor(peer, system, lambda line: click.echo(f"warning: {line}", err=True))
        if page is not None:
            address = stack.enter_context(served_page(page, monitor.overview.data))
            click.echo(f"page: {address}", err=True)
        if once:
            end = time.monotonic() + wait
            while not monitor.overview.is_at_rest and time.monotonic() < end:
                monitor.turn()
            click.echo(_shown(monitor.overview, kind, once), nl=False)
            return int(any(row.level != OK for row in monitor.overview.rows()))
        stack.enter_context(stopped_by_signals(monitor))
        _show_changes(monitor, kind)
    return 0


def _show_changes(monitor: Monitor, kind: str) -> None:
    is_terminal = sys.stdout.isatty()
    before = ""
    while not monitor.is_stopped:
        text = _shown(monitor.overview, kind, once=False)
        if text != before:
            end = "" if kind == "json" or is_terminal else "\n"
            click.echo(f"{_CLEAR if is_terminal and kind != 'json' else ''}{text}{end}", nl=False)
            before = text
        monitor.turn()


def _shown(overview: Overview, kind: str, once: bool) -> str:
    if kind == "json":
        return json_text(overview.data()) if once else json.dumps(overview.data()) + "\n"
    return overview.table()
