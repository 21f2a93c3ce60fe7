# SPDX-License-Identifier: Apache-2.0
"""An adapter between the UART of a board and UDP: the other side of c/uart_network.h."""

from __future__ import annotations

import os
import random
import select
import socket
import threading
from collections.abc import Mapping

from tests.support.firmware.line import open_raw

_END, _ESCAPE = b"\xc0", b"\xdb"
_ESCAPED = ((_ESCAPE, b"\xdb\xdd"), (_END, b"\xdb\xdc"))
_HEAD = 2


class UartNetwork:
    """Datagrams between the board at `device` and agents on this machine; a context manager.

    `ports`: the ports that the application file names, each with the real one. `loss`: the part of the datagrams of
    both directions that is lost, 0 to 1.
    """

    def __init__(self, device: str, ports: Mapping[int, int], loss: float = 0.0, seed: int = 1) -> None:
        self.lost = 0
        self._loss, self._chance = loss, random.Random(seed)
        self._board, self._waiting = open_raw(device), b""
        os.set_blocking(self._board, True)
        self._agents = {named: _connected(port) for named, port in ports.items()}
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> UartNetwork:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.set()
        self._thread.join(10)
        os.close(self._board)
        for agent in self._agents.values():
            agent.close()

    def _serve(self) -> None:
        sockets = {agent: named for named, agent in self._agents.items()}
        sources: list[int | socket.socket] = [self._board, *sockets]
        while not self._ends.is_set():
            ready, _, _ = select.select(sources, [], [], 0.02)
            for source in ready:
                if isinstance(source, socket.socket):
                    self._to_board(sockets[source], source)
                else:
                    self._from_board()

    def _passes(self) -> bool:
        passes = self._chance.random() >= self._loss
        self.lost += not passes
        return passes

    def _from_board(self) -> None:
        *frames, self._waiting = (self._waiting + os.read(self._board, 4096)).split(_END)
        for frame in frames:
            for plain, escaped in reversed(_ESCAPED):
                frame = frame.replace(escaped, plain)
            agent = self._agents.get(int.from_bytes(frame[:_HEAD], "big"))
            if len(frame) > _HEAD and agent is not None and self._passes():
                try:
                    agent.send(frame[_HEAD:])
                except OSError:
                    self.lost += 1  # the agent is gone

    def _to_board(self, named: int, agent: socket.socket) -> None:
        try:
            frame = named.to_bytes(_HEAD, "big") + agent.recv(2048)
        except OSError:
            return  # no agent has the port
        if self._passes():
            for plain, escaped in _ESCAPED:
                frame = frame.replace(plain, escaped)
            os.write(self._board, _END + frame + _END)


def _connected(port: int) -> socket.socket:
    agent = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    agent.connect(("127.0.0.1", port))
    return agent
