# SPDX-License-Identifier: Apache-2.0
"""`microros-gen parameter-server`: holds the parameters of firmware."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import click

from microros_gen.agent.server import stopped_by_signals
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.parameter_server.file import ParameterFile
from microros_gen.parameter_server.server import NODE, ParameterServer
from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.peer import Peer


@contextmanager
def parameter_peer(name: str, domain: int | None) -> Iterator[Peer]:
    """Give the node of a parameter server; UserError without a usable ROS 2."""
    try:
        peer = Peer(name, domain=domain)
    except RosUnusableError as error:
        raise UserError(
            [Diagnostic(f"the parameter server {error.reason}", hint=error.hint, id="MG-9728")]
        ) from error
    with peer:
        yield peer


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
    help="Where the values are kept. Default: parameters-DOMAIN.json in ~/.local/state/microros-gen"
    " (XDG_STATE_HOME).",
)
@click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)
def command(file: Path | None, domain: int | None) -> None:
    """Hold the parameters of firmware whose application file says `parameters: {at: agent}`.

    The node /microros_parameters serves the six parameter services in the name of each such node, also while its board
    sleeps or is away, keeps the values in a file, and brings both sides together when the board is back: the last
    writer wins. The agent does the same by itself where no such node runs; run this on any machine of the domain, one
    in a domain. Needs ROS 2 Jazzy, as the agent does.

    \b
    microros-gen parameter-server
    microros-gen parameter-server --file arm.json --domain 5

    Prints 'parameter server ready: /microros_parameters' on stdout, and what was overruled on stderr. SIGINT and
    SIGTERM end it with status 0.
    """
    with closing(ParameterFile(file or usual_file(domain))) as kept, parameter_peer(NODE, domain) as peer:
        server = ParameterServer(peer, lambda line: click.echo(line, err=True), kept)
        with stopped_by_signals(server):
            click.echo(f"parameter server ready: {peer.name}")
            server.run()
