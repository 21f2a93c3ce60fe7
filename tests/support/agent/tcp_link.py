# SPDX-License-Identifier: Apache-2.0
"""The client's side of a TCP connection, on its own: the oracle for the agent's framing."""

from __future__ import annotations

import socket

from tests.support.patience import seconds


class TcpLink:
    """What `XrceClient` needs of a socket, over TCP."""

    def __init__(self, host: str, port: int) -> None:
        self.socket = socket.create_connection((host, port), timeout=seconds(5))
        self._bytes = b""

    def settimeout(self, seconds: float) -> None:
        """Set how long `recv` waits."""
        self.socket.settimeout(seconds)

    def send(self, payload: bytes) -> None:
        """Send a message."""
        self.socket.sendall(len(payload).to_bytes(2, "little") + payload)

    def recv(self, _size: int) -> bytes:
        """Return the next message; raise TimeoutError if none arrives in time, ConnectionError at its end."""
        while len(self._bytes) < 2 or len(self._bytes) < 2 + int.from_bytes(self._bytes[:2], "little"):
            chunk = self.socket.recv(65536)
            if not chunk:
                raise ConnectionError
            self._bytes += chunk
        size = int.from_bytes(self._bytes[:2], "little")
        message, self._bytes = self._bytes[2 : 2 + size], self._bytes[2 + size :]
        return message

    def close(self) -> None:
        """Hang up."""
        self.socket.close()
