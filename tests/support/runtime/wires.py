# SPDX-License-Identifier: Apache-2.0
"""How messages look on each transport: datagrams, lengths in front of them (TCP), frames (serial lines)."""

from __future__ import annotations

from typing import Protocol

from tests.support.runtime.frames import AGENT, CLIENT, events, frame


class Wire(Protocol):
    """What comes of a client, piece by piece, as messages; and messages as they go to it."""

    def begin(self) -> None:
        """Forget what was received of a message: the transport is opened or closed."""

    def messages(self, data: bytes) -> list[bytes]:
        """Take a piece; return the messages that it completes."""
        ...

    def carried(self, message: bytes) -> bytes:
        """Return what carries a message to the client."""
        ...


class Datagrams:
    """A piece is a message."""

    def begin(self) -> None:
        """There is nothing to forget."""

    def messages(self, data: bytes) -> list[bytes]:
        """Return the message."""
        return [data]

    def carried(self, message: bytes) -> bytes:
        """Return the message."""
        return message


class Lengths:
    """Before each message goes its length."""

    def __init__(self) -> None:
        self._waiting = b""

    def begin(self) -> None:
        """Forget the beginning of a message."""
        self._waiting = b""

    def messages(self, data: bytes) -> list[bytes]:
        """Return the messages that are whole."""
        self._waiting += data
        found = []
        while len(self._waiting) >= 2:
            end = 2 + int.from_bytes(self._waiting[:2], "little")
            if len(self._waiting) < end:
                break
            found.append(self._waiting[2:end])
            self._waiting = self._waiting[end:]
        return found

    def carried(self, message: bytes) -> bytes:
        """Return the message after its length."""
        return len(message).to_bytes(2, "little") + message


class Frames:
    """Each message in its frame."""

    def __init__(self) -> None:
        self._waiting = b""

    def begin(self) -> None:
        """Forget the beginning of a frame."""
        self._waiting = b""

    def messages(self, data: bytes) -> list[bytes]:
        """Return the messages of frames that are whole."""
        self._waiting += data
        found = [e.message for e in events(self._waiting, source=CLIENT, destination=AGENT)]
        if found:
            self._waiting = b""
        return [message for message in found if message is not None]

    def carried(self, message: bytes) -> bytes:
        """Return the frame around the message."""
        return frame(message)
