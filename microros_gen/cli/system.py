# SPDX-License-Identifier: Apache-2.0
"""`microros-gen system`: checks boards that exchange messages without an agent."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen import compiler
from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.options import format_option, interface_path_option, json_text
from microros_gen.cli.tables import format_table


@click.group(cls=CommandGroup)
def command() -> None:
    """Check the boards of a system file together.

    \b
    microros-gen system check system.yaml
    """


@command.command("check")
@click.argument("system", metavar="SYSTEM.yaml", type=click.Path(path_type=Path))
@interface_path_option
@format_option
def check_command(system: Path, interface_paths: tuple[Path, ...], kind: str) -> int:
    """Report everything that the boards of a system do not agree about, in one run. Nothing is written.

    Each board is planned as `generate` would: types and type hashes, QoS, limits, MTU and rates of what the links
    carry, client keys, lines and chips. A difference is reported at both boards.

    Exit status: 0 all boards agree, with or without warnings; 2 something is wrong.

    \b
    microros-gen system check system.yaml
    microros-gen system check system.yaml --format json | jq '.findings[].id'
    """
    checked = compiler.check_system(system, interface_paths)
    if kind == "json":
        click.echo(json_text(checked.data()), nl=False)
        return checked.exit_status
    if checked.boards:
        rows = [(board.name, board.shown, _neighbors(board), _reports(board)) for board in checked.boards]
        click.echo(format_table(("BOARD", "RESULT", "NEIGHBORS", "EXCHANGES"), rows), nl=False)
    for diagnostic in checked.diagnostics:
        click.echo(diagnostic.render(), err=True)
    return checked.exit_status


def _neighbors(board: compiler.CheckedBoard) -> str:
    return ", ".join(f"{each.board} ({each.over})" for each in board.neighbors) or "none"


def _reports(board: compiler.CheckedBoard) -> tuple[str, ...]:
    return tuple(f"{name}: {value}" for name, value in board.rows)
