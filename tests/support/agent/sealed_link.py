# SPDX-License-Identifier: Apache-2.0
"""The client's side of sealed messages by the package noiseprotocol: the oracle for the agent's seal."""

from __future__ import annotations

import struct
from typing import Protocol

from noise.connection import NoiseConnection

from tests.support.patience import seconds

_NAME = b"Noise_NNpsk0_25519_ChaChaPoly_SHA256"
_LABEL = b"microros-gen seal"
FIRST, SECOND, RECORD = 1, 2, 3


class Within(Protocol):
    """A link that carries records."""

    def settimeout(self, seconds: float) -> None:
        """Set how long `recv` waits."""

    def send(self, payload: bytes) -> object:
        """Send a message."""

    def recv(self, size: int) -> bytes:
        """Return the next message."""

    def close(self) -> None:
        """Hang up."""


class SealedLink:
    """What `XrceClient` needs of a socket, over another link; the handshake is made at once."""

    def __init__(self, within: Within, client_key: int, psk: bytes) -> None:
        self.within = within
        self._noise = NoiseConnection.from_name(_NAME)
        self._count = 0
        head = struct.pack("<BBHII", FIRST, 1, 0, 5, client_key)
        self._noise.set_psks(psk)
        self._noise.set_prologue(_LABEL + head)
        self._noise.set_as_initiator()
        self._noise.start_handshake()
        within.settimeout(seconds(5))
        within.send(head + bytes(self._noise.write_message()))
        second = within.recv(2048)
        while second[0] == RECORD:  # on a line: an answer to the client before
            second = within.recv(2048)
        assert second[0] == SECOND, "the agent refused the handshake"
        kind, _, _, self._index, own = struct.unpack_from("<BBHII", second)
        assert (kind, own) == (SECOND, 5), "the agent refused the handshake"
        self._noise.read_message(second[12:])

    def settimeout(self, seconds: float) -> None:
        """Set how long `recv` waits."""
        self.within.settimeout(seconds)

    def record(self, payload: bytes) -> bytes:
        """Return the next record."""
        self._count += 1
        head = struct.pack("<BBHIQ", RECORD, 1, 0, self._index, self._count - 1)
        return head + bytes(self._noise.encrypt(payload))

    def send(self, payload: bytes) -> None:
        """Seal a message and send it."""
        self.within.send(self.record(payload))

    def recv(self, size: int) -> bytes:
        """Return the message in the next record; raise as the link within does."""
        return bytes(self._noise.decrypt(self.within.recv(size)[16:]))

    def close(self) -> None:
        """Hang up."""
        self.within.close()
