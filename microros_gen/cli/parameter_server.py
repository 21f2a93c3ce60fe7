# SPDX-License-Identifier: Apache-2.0
"""`microros-gen parameter-server`: holds the parameters of firmware."""

from __future__ import annotations

import os
from contextlib import closing, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.diagnostics import Diagnostic

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer


def parameter_peer(name: str, domain: int | None) -> Peer:
    """Return the node of a parameter server; UserError without a usable ROS 2."""
    from microros_gen.cli.ros_node import node_of

    return node_of(
        name,
        domain,
        lambda error: Diagnostic(f"the parameter server {error.reason}", hint=error.hint, id="MG-9728"),
    )


def usual_file(domain: int | None) -> Path:
    """Return where values are kept unless somebody names a file: one for each ROS domain."""
    base = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local/state"
    number = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0" if domain is None else domain
    return Path(base) / "microros-gen" / f"parameters-{number}.json"


@click.command()
@click.option(
    "--file",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="File of the values. Default: parameters-DOMAIN.json in ~/.local/state/microros-gen"
    " (XDG_STATE_HOME).",
)
@click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)
def command(file: Path | None, domain: int | None) -> None:
    """Hold the parameters of firmware whose application file says `parameters: {at: agent}`.

    The node /microros_parameters serves the six parameter services in the name of each such node, even while its board
    sleeps or is away. It keeps the values in a file, and synchronizes both sides when the board is back: the last
    writer wins. Without this node, the agent does the same. Run it on any machine of the domain. If several run,
    one of them serves, and another one takes over when it is gone. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen parameter-server
    microros-gen parameter-server --file arm.json --domain 5

    Prints 'parameter server ready: /microros_parameters' on stdout, and overruled values on stderr. SIGINT and SIGTERM
    end it with status 0.
    """
    from microros_gen.agent.server import stopped_by_signals
    from microros_gen.parameter_server.claims import STANDALONE
    from microros_gen.parameter_server.file import ParameterFile
    from microros_gen.parameter_server.turns import ServerInTurn

    server = ServerInTurn(STANDALONE, lambda name: parameter_peer(name, domain), _Report())
    with closing(ParameterFile(file or usual_file(domain))) as kept, stopped_by_signals(server):
        server.run(lambda: nullcontext(kept))


class _Report:
    """Tells of turns on stdout, and of values on stderr."""

    def waits(self, other: str) -> None:
        """Tell that another one serves."""
        click.echo(f"parameters are held by another server ({other}): this one waits", err=True)

    def ready(self, node: str) -> None:
        """Tell that this one serves."""
        click.echo(f"parameter server ready: {node}")

    def log(self, line: str) -> None:
        """Pass on a line."""
        click.echo(line, err=True)
