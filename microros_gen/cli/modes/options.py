# SPDX-License-Identifier: Apache-2.0
"""What the commands on a model file share."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.diagnostics import Diagnostic
from microros_gen.mode_manager.settings import Settings

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer

model_argument = click.argument("model", metavar="SYSTEM.yaml", type=click.Path(path_type=Path))

application_option = click.option(
    "--application",
    "applications",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Application file whose nodes with modes are parts of the model, which need not repeat them; can be repeated.",
)

reconfigure_option = click.option(
    "--reconfigure",
    multiple=True,
    metavar="NODE",
    help="Node that takes parameters, or its mode, only while it is inactive: it is deactivated, gets those of the"
    " mode and is activated again; can be repeated.",
)

timeout_option = click.option(
    "--timeout",
    type=click.FloatRange(min=0.1),
    default=Settings().call_s,
    show_default=True,
    metavar="S",
    help="Seconds after which a response is late.",
)

report_option = click.option(
    "--report-timeout",
    type=click.FloatRange(min=0.1),
    default=Settings().repeat_s,
    show_default=True,
    metavar="S",
    help="Seconds in which each status on /diagnostics is repeated: after that, one of no part is stale, and one of a"
    " node that was away is forgotten.",
)

domain_option = click.option(
    "--domain", type=click.IntRange(0, 232), metavar="ID", help="ROS domain. Default: ROS_DOMAIN_ID, else 0."
)


def modes_peer(name: str, domain: int | None) -> Peer:
    """Return a node; UserError without a usable ROS 2."""
    from microros_gen.cli.ros_node import node_of

    return node_of(
        name,
        domain,
        lambda error: Diagnostic(f"this command {error.reason}", hint=error.hint, id="MG-8874"),
    )
