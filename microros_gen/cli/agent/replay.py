# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent replay`: plays one side of a recording, and says where the other one differs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen.agent.configuration.model import SerialChoice
from microros_gen.agent.wire.constants import SubmessageId

_NAMES = [kind.name for kind in SubmessageId]


class _Alone(click.Command):
    """A command among chained ones that takes the rest of the line: options may follow its argument."""

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        extra.update(allow_extra_args=False, allow_interspersed_args=True)
        return super().make_context(*args, **extra)


@click.command(cls=_Alone)
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False))
@click.option(
    "--at",
    metavar="PLACE",
    help="Where the other side is, or with --side agent will be: udp4:127.0.0.1:8888, tcp6:[::1]:8888,"
    " serial:/dev/ttyUSB0, canfd:can0, pty:LINK. Default: the transport of the recording.",
)
@click.option(
    "--side",
    type=click.Choice(["client", "agent"]),
    default="client",
    show_default=True,
    help="Which side to play: clients towards an agent, or the agent towards firmware.",
)
@click.option(
    "--client",
    metavar="KEY",
    help="Play only the client with this key (A1B2C3D4). Default: all clients of the file.",
)
@click.option(
    "--speed",
    type=click.FloatRange(min=0, min_open=True),
    default=1.0,
    show_default=True,
    help="Play this many times as fast as recorded.",
)
@click.option("--fast", is_flag=True, help="Send each message as soon as the answers before it arrived.")
@click.option(
    "--wait",
    type=click.FloatRange(min=0, min_open=True),
    default=2.0,
    show_default=True,
    metavar="SECONDS",
    help="How long an answer may be late.",
)
@click.option(
    "--skip",
    multiple=True,
    type=click.Choice(_NAMES, case_sensitive=False),
    help="Do not compare submessages of this kind, such as DATA, whose samples come from ROS 2. Can be repeated.",
)
@click.option(
    "-b",
    "--baud",
    type=click.IntRange(min=1),
    default=SerialChoice.baud,
    show_default=True,
    help="Speed of a serial device in bit/s.",
)
def replay(
    file: Path,
    at: str | None,
    side: str,
    client: str | None,
    speed: float,
    fast: bool,
    wait: float,
    skip: tuple[str, ...],
    baud: int,
) -> None:
    """Play a recording of `agent record`, and compare the answers with the recorded ones.

    Needs no ROS 2. Sequence numbers are those of the recording; acknowledgements and heartbeats are of this run and not
    compared, nor are times and the identities of requests. The first difference of each client is named with its
    packet, counted as in Wireshark. Towards firmware, its session may have another id and another key.

    \b
    microros-gen agent replay failure.pcapng --at udp4:127.0.0.1:8888
    microros-gen agent replay failure.pcapng --fast --skip DATA
    microros-gen agent replay failure.pcapng --side agent --at serial:/dev/ttyUSB0

    Status 0: no difference; 1: a difference; 2: invalid usage, a file that cannot be replayed, or no other side.
    """
    from microros_gen.cli.agent.replaying import play

    play(file, at, side == "agent", client, 0 if fast else speed, wait, skip, baud)
