# SPDX-License-Identifier: Apache-2.0
"""Work of `microros-gen agent replay`: from its options to what it prints."""

from __future__ import annotations

import re
import resource
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

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
from microros_gen.agent.recording.recorded import Conversation, open_recording
from microros_gen.agent.replay.links import Link, Place, open_link
from microros_gen.agent.replay.player import Player
from microros_gen.agent.replay.run import AgentSide, ClientSide, Replay
from microros_gen.agent.server import stopped_by_signals
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.diagnostics import Diagnostic, UserError

_PLACE = re.compile(r"(udp4|udp6|tcp4|tcp6|serial|canfd|pty)[: ](.+)")
_OTHER_DESCRIPTORS = 64
"""Descriptors of this process besides its links."""
DIFFERS = 1
"""Exit status if an answer differs."""


def play(
    file: Path,
    at: str | None,
    as_agent: bool,
    client: str | None,
    speed: float,
    wait: float,
    skip: tuple[str, ...],
    baud: int,
) -> None:
    """Play a file, print what came of it, and exit with its status; `speed` 0: at once. Raises UserError, OSError."""
    wanted = None if client is None else _key(client)
    log = EventLog(sys.stderr)
    with ExitStack() as stack:
        recording = stack.enter_context(open_recording(file, wanted))
        if recording.outside:
            count = recording.outside
            click.echo(
                f"{count} packets are outside of sessions that the file has from their start", err=True
            )
        chosen = [each for each in recording.conversations if wanted in (None, each.key)]
        if not chosen:
            known = ", ".join(dict.fromkeys(each.key for each in recording.conversations))
            reason = f"{file} has no client {client}"
            raise UserError([Diagnostic(reason, hint=f"It has {known}", id="MG-9798")])
        players = [Player(each, as_agent, wait, skip) for each in chosen]
        opened = _as_agent if as_agent else _as_clients
        _allow_descriptors(len(players))
        side = opened(stack, players, at, baud, log)
        stack.callback(side.close)
        run = Replay(players, side, speed)
        with stopped_by_signals(run):
            _run(run)
        differs = [_report(player) for player in players]
    sys.exit(DIFFERS if any(differs) else 0)


def _allow_descriptors(links: int) -> None:
    """Let this process have a link for each player, as far as the system's hard limit goes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = links + _OTHER_DESCRIPTORS
    if soft != resource.RLIM_INFINITY and soft < wanted:
        most = wanted if hard == resource.RLIM_INFINITY else min(hard, wanted)
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))


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
    from microros_gen.cli.agent.transports import Shared, open_transports

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
