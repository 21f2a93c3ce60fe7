# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent replay`: plays one side of a recording, and says where the other one differs."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.configuration.model import (
    CanChoice,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.recording.packets import PREFIX, line_number
from microros_gen.agent.recording.recorded import Conversation, read_recording
from microros_gen.agent.replay.links import Link, Place, open_link
from microros_gen.agent.replay.player import Player
from microros_gen.agent.replay.run import AgentSide, ClientSide, Replay
from microros_gen.agent.server import stopped_by_signals
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.diagnostics import Diagnostic, UserError

_PLACE = re.compile(r"(udp4|udp6|tcp4|tcp6|serial|canfd|pty)[: ](.+)")
_NAMES = [kind.name for kind in SubmessageId]
DIFFERS = 1
"""Exit status if an answer differs."""


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
@click.option("--fast", is_flag=True, help="Send each message as soon as the answers before it have come.")
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
    as_agent = side == "agent"
    conversations, outside = read_recording(file)
    if outside:
        click.echo(f"{outside} packets are outside of sessions that the file has from their start", err=True)
    chosen = [each for each in conversations if client is None or each.key == _key(client)]
    if not chosen:
        known = ", ".join(dict.fromkeys(each.key for each in conversations))
        reason = f"{file} has no client {client}"
        raise UserError([Diagnostic(reason, hint=f"It has {known}", id="MG-9798")])
    players = [Player(each, as_agent, wait, skip) for each in chosen]
    log = EventLog(sys.stderr)
    with ExitStack() as stack:
        play = _as_agent if as_agent else _as_clients
        run = Replay(players, play(stack, players, at, baud, log), 0 if fast else speed)
        with stopped_by_signals(run):
            _run(run)
    differs = [_report(player) for player in players]
    sys.exit(DIFFERS if any(differs) else 0)


def _run(run: Replay) -> None:
    try:
        run.run()
    except OSError as error:
        click.echo(f"the other side is gone: {error.strerror or error}", err=True)


def _report(player: Player) -> bool:
    """Print what came of a conversation; return whether it differs."""
    conversation = player.conversation
    name = f"client {conversation.key} ({conversation.transport})"
    if player.difference:
        click.echo(f"{name}: {player.difference}")
    elif not player.done:
        click.echo(f"{name}: not played to its end")
    else:
        click.echo(f"{name}: {player.sent} messages sent, {player.compared} answers as recorded")
    return bool(player.difference) or not player.done


def _key(text: str) -> str:
    return text.upper().removeprefix("0X").zfill(8)


def _place(at: str | None, conversation: Conversation, baud: int) -> Place:
    """Return what --at says, or where the agent was. Raises UserError for a place that is none."""
    text = at or conversation.transport
    match = _PLACE.fullmatch(text)
    if match is None or (match[1] in PROTOCOLS and not re.fullmatch(r".+:\d{1,5}", match[2])):
        raise UserError(
            [
                Diagnostic(
                    f"'{text}' is not the place of an agent",
                    hint="Write --at udp4:127.0.0.1:8888, --at serial:/dev/ttyUSB0 or --at canfd:can0",
                    id="MG-9799",
                )
            ]
        )
    return Place(match[1], match[2], baud)


def _as_clients(
    stack: ExitStack, players: Sequence[Player], at: str | None, baud: int, log: EventLog
) -> ClientSide:
    shared: dict[Place, int] = {}
    links: list[Link] = []
    numbers = []
    for player in players:
        place = _place(at, player.conversation, baud)
        if place.shared and place in shared:
            links.append(links[shared[place]])
        else:
            shared[place] = len(links)
            links.append(open_link(place, log))
            stack.callback(links[-1].close)
        numbers.append(_number(player.conversation) if place.shared else 0)
    return ClientSide(players, links, numbers)


def _number(conversation: Conversation) -> int:
    """Return a client's number on a line; of one that was on a network: 1, as the public client has."""
    of_line = int(conversation.client.address) >> 64 == int(PREFIX) >> 64
    return line_number(conversation.client) if of_line else 1


def _as_agent(
    stack: ExitStack, players: Sequence[Player], at: str | None, baud: int, log: EventLog
) -> AgentSide:
    from microros_gen.cli.agent.start import Shared, open_transports

    places = dict.fromkeys(_place(at, player.conversation, baud) for player in players)
    choices = [_choice(place) for place in places]
    limits = Limits()
    shared = Shared(
        InputPool(limits.input_bytes, limits.clients),
        Budgets(limits, len(choices)).output,
        Fairness(),
        Account(),
    )
    transports = open_transports(choices, None, log, shared)
    for transport in transports:
        stack.callback(transport.close)
        log.emit(Level.INFO, "ready", "agent ready: {transport}", transport=transport.label)
    return AgentSide(players, transports)


def _choice(place: Place) -> TransportChoice:
    if place.kind in PROTOCOLS:
        host, _, port = place.address.rpartition(":")
        return SocketChoice(place.kind, int(port), host.strip("[]"))
    if place.kind == "canfd":
        return CanChoice(place.address)
    if place.kind == "pty":
        return PtyChoice(place.address, place.baud)
    return replace(SerialChoice(place.address), baud=place.baud)
