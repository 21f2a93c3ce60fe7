# SPDX-License-Identifier: Apache-2.0
"""A fake agent after a TCP port."""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.ports import bind, stop

Sender = Callable[[socket.socket, list[bytes]], None]


def framed(message: bytes) -> bytes:
    return struct.pack("<H", len(message)) + message


def together(peer: socket.socket, answers: list[bytes]) -> None:
    """Send all answers in one segment."""
    peer.sendall(b"".join(map(framed, answers)))


class TcpAgent(threading.Thread):
    """Listens at `host`, one connection at a time; `before` sees the number of each message and may close it."""

    def __init__(
        self, send: Sender = together, read: int = 4096, host: str = "127.0.0.1", pause_s: float = 0.0
    ) -> None:
        super().__init__(daemon=True)
        self.agent = FakeAgent()
        self.before: Callable[[int], bool] = lambda count: True
        self.connections = 0
        self._send, self._read, self._pause_s = send, read, pause_s
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._listener = socket.socket(family, socket.SOCK_STREAM)
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.port = bind(self._listener, host)
        self._listener.listen()
        self._count = 0

    def run(self) -> None:
        while True:
            try:
                peer, _ = self._listener.accept()
            except OSError:
                return
            self.connections += 1
            with peer:
                peer.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self._serve(peer)

    def _serve(self, peer: socket.socket) -> None:
        stream = b""
        while True:
            try:
                chunk = peer.recv(self._read)
                time.sleep(self._pause_s)
            except OSError:
                return
            if not chunk:
                return
            stream += chunk
            while len(stream) >= 2 and len(stream) >= 2 + struct.unpack_from("<H", stream)[0]:
                size = struct.unpack_from("<H", stream)[0]
                message, stream = stream[2 : 2 + size], stream[2 + size :]
                self._count += 1
                if not self.before(self._count):
                    self.agent.restart()
                    return
                try:
                    self._send(peer, self.agent.receive(message))
                except OSError:
                    return

    def stop(self) -> None:
        stop(self._listener)


@contextmanager
def serving(agent: TcpAgent) -> Iterator[TcpAgent]:
    agent.start()
    try:
        yield agent
    finally:
        agent.stop()
