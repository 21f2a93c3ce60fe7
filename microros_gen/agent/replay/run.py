# SPDX-License-Identifier: Apache-2.0
"""The loop of a replay: all conversations of a recording at once, in its time."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Sequence
from functools import partial
from selectors import EVENT_READ, DefaultSelector
from typing import Any, Protocol

from microros_gen.agent.recording.recorded import opens_session
from microros_gen.agent.replay.links import Link
from microros_gen.agent.replay.player import Player
from microros_gen.agent.transport.base import Transport

ROUND_S = 0.005
"""Seconds between two looks at what is due."""


class Clock:
    """The time of the recording: it begins with the replay, `speed` times as fast; 0: at once."""

    def __init__(self, begin_ns: int, speed: float) -> None:
        self._begin_ns = begin_ns
        self._speed = speed
        self._began = time.monotonic()

    def reached(self, now: float) -> float:
        """Return which time of the recording, in nanoseconds, it is at `now`."""
        if not self._speed:
            return float("inf")
        return self._begin_ns + (now - self._began) * 1e9 * self._speed


class _Readable(Protocol):
    def fileno(self) -> int:
        """Return the descriptor that is readable when something has arrived; always the same."""


class Ends:
    """The ends of a replay; their number is not limited, as that of select(2) is."""

    def __init__(self, ends: Sequence[_Readable]) -> None:
        """Watch `ends`, which stay open meanwhile."""
        self._selector = DefaultSelector()
        for end in ends:
            self._selector.register(end, EVENT_READ)

    def readable(self, seconds: float) -> list[Any]:
        """Return the ends where something has arrived, after at most some seconds."""
        return [key.fileobj for key, _ in self._selector.select(seconds)]

    def close(self) -> None:
        """Close the descriptor of the system; the ends stay open."""
        self._selector.close()


class ClientSide:
    """Plays clients towards an agent: a link for each player, or one for all."""

    def __init__(self, players: Sequence[Player], links: Sequence[Link], numbers: Sequence[int]) -> None:
        """Take the link of each player, which may be the same; `numbers` are those of clients on a line, else 0."""
        self._ends = Ends(list(dict.fromkeys(links)))
        self._players: dict[tuple[Link, int], Player] = {}
        self._places: list[tuple[Player, Link, int]] = []
        for place, player in enumerate(players):
            link, number = links[place], numbers[place]
            self._players[link, number] = player
            self._places.append((player, link, number))

    def wait(self, seconds: float) -> None:
        """Take what arrives within some seconds. Raises OSError if an end is gone."""
        for link in self._ends.readable(seconds):
            link.receive(partial(self._take, link))

    def tick(self, now: float, reached_ns: float) -> None:
        """Send what is due. Raises OSError if an end is gone."""
        for player, link, number in self._places:
            player.tick(now, reached_ns, partial(link.send, number))

    def close(self) -> None:
        """Stop watching the ends, which stay open."""
        self._ends.close()

    def _take(self, link: Link, number: int, message: bytes) -> None:
        player = self._players.get((link, number))
        if player is not None:
            player.receive(message, partial(link.send, number))


class AgentSide:
    """Plays the agent towards clients: each gets the conversation of its key, or else the next one."""

    def __init__(self, players: Sequence[Player], transports: Sequence[Transport]) -> None:
        self._transports = transports
        self._ends = Ends(transports)
        self._free = list(players)
        self._players: dict[Hashable, tuple[Player, Callable[[bytes], None]]] = {}

    def wait(self, seconds: float) -> None:
        """Take what arrives within some seconds."""
        for transport in self._ends.readable(seconds):
            transport.pump(self._take)

    def tick(self, now: float, reached_ns: float) -> None:
        """Send what is due."""
        for transport in self._transports:
            transport.tick(now)
        for player, send in self._players.values():
            player.tick(now, reached_ns, send)
        for transport in self._transports:
            transport.flush()

    def close(self) -> None:
        """Stop watching the ends, which stay open."""
        self._ends.close()

    def _take(self, data: bytes, address: Hashable, transport: Transport) -> None:
        if address not in self._players and opens_session(data) and self._free:
            at = 4 if data[0] >= 0x80 else 8
            key = data[at + 12 : at + 16].hex().upper()
            player = next((each for each in self._free if each.conversation.key == key), self._free[0])
            self._free.remove(player)
            self._players[address] = player, partial(_send_to, transport, address)
        found = self._players.get(address)
        if found is not None:
            found[0].receive(data, found[1])


def _send_to(transport: Transport, address: Hashable, data: bytes) -> None:
    transport.send(data, address)


class Replay:
    """A replay that runs until all players are done, or `stop`."""

    def __init__(self, players: Sequence[Player], side: ClientSide | AgentSide, speed: float) -> None:
        """Play `speed` times as fast as recorded; 0: each message as soon as what preceded it arrived."""
        self._players = players
        self._side = side
        begin_ns = min(next(iter(player.conversation.messages)).time_ns for player in players)
        self._clock = Clock(begin_ns, speed)
        self._stopped = False

    def stop(self) -> None:
        """End soon; called from a signal handler."""
        self._stopped = True

    def run(self) -> None:
        """Play. Raises OSError if the other end of a connection is gone."""
        while not self._stopped and not all(player.done for player in self._players):
            now = time.monotonic()
            self._side.tick(now, self._clock.reached(now))
            self._side.wait(ROUND_S)
