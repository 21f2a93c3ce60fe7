# SPDX-License-Identifier: Apache-2.0
"""The sending end of reliable streams (DDS-XRCE 1.0, 8.4.3): what is not acknowledged is kept, and sent again."""

from __future__ import annotations

from microros_gen.agent.wire.constants import RELIABLE_WINDOW, is_reliable
from microros_gen.agent.wire.entity_messages import Acknack, Heartbeat
from microros_gen.agent.wire.message import Header

_HALF = 0x8000


class Sender:
    """The messages of each reliable stream that were sent and not acknowledged, by sequence number."""

    def __init__(self) -> None:
        self._kept: dict[int, dict[int, bytes]] = {}
        self._sent: set[tuple[int, int]] = set()

    @property
    def pending(self) -> bool:
        """Whether something is not acknowledged."""
        return any(self._kept.values())

    def reset(self) -> None:
        """Begin a session."""
        self._kept.clear()
        self._sent.clear()

    def has_room(self, stream: int) -> bool:
        """Return whether one more message fits the window of a stream."""
        return len(self._kept.get(stream, ())) < RELIABLE_WINDOW

    def keep(self, head: Header, data: bytes) -> bool:
        """Keep a message until it is acknowledged; return whether it is the first one with its number."""
        if not is_reliable(head.stream):
            return True
        name = head.stream, head.sequence
        if name in self._sent:
            return False
        self._sent.add(name)
        self._sent.discard((head.stream, head.sequence - _HALF & 0xFFFF))
        self._kept.setdefault(head.stream, {})[head.sequence] = data
        return True

    def take(self, acknack: Acknack) -> list[bytes]:
        """Forget what is acknowledged; return the messages that are missing."""
        kept = self._kept.get(acknack.stream, {})
        for sequence in [each for each in kept if 0 < (acknack.first - each) & 0xFFFF < _HALF]:
            del kept[sequence]
        return [
            data
            for sequence, data in kept.items()
            if (sequence - acknack.first) & 0xFFFF < RELIABLE_WINDOW
            and acknack.missing >> ((sequence - acknack.first) & 0xFFFF) & 1
        ]

    def heartbeats(self) -> list[Heartbeat]:
        """Return a question for each stream with messages that are not acknowledged."""
        return [
            Heartbeat(next(iter(kept)), next(reversed(kept)), stream)
            for stream, kept in self._kept.items()
            if kept
        ]
