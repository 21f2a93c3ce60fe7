# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes mine`: describes running nodes for a model file."""

from __future__ import annotations

import click

from microros_gen.cli.modes.options import domain_option, modes_peer


@click.command()
@click.argument("nodes", metavar="NODE…", nargs=-1, required=True)
@click.option(
    "--timeout",
    type=click.FloatRange(min=0.1),
    default=10.0,
    show_default=True,
    metavar="S",
    help="Seconds to wait for a node and for each of its responses.",
)
@click.option(
    "--visit",
    "each_mode",
    is_flag=True,
    help="Change each node to all of its modes, one after another, read its values there, and return to the first.",
)
@domain_option
def mine_command(nodes: tuple[str, ...], timeout: float, each_mode: bool, domain: int | None) -> None:
    """Print running nodes as parts of a model file: their parameters, with the current values, as __DEFAULT__.

    A comment says in which mode they are. With --visit all modes are printed; the node must be active and have mode
    services. Otherwise other modes are added by hand. The types are those of the values: 1.0 is a double, 1 an integer.

    \b
    microros-gen modes mine /gripper /left/wheel
    microros-gen modes mine --visit /arm/device
    """
    from microros_gen.mode_manager.leaflet import mine

    with modes_peer("mode_miner", domain) as peer:
        for node in nodes:
            click.echo(mine(peer, node, timeout, _warn, each_mode), nl=False)


def _warn(line: str) -> None:
    click.echo(f"warning: {line}", err=True)
