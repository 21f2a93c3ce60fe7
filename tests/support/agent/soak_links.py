# SPDX-License-Identifier: Apache-2.0
"""Ways from many clients of one process to the agent; none of them waits."""

from __future__ import annotations

import os
import socket
import struct
import tty
from collections.abc import Callable
from typing import Protocol

from microros_gen.agent.framing import FrameDecoder, encode_frame
from tests.support.patience import seconds

Take = Callable[[bytes], None]
"""Takes one message from the agent."""
RESET_AT_ONCE = struct.pack("ii", 1, 0)


class Link(Protocol):
    """One client's way."""

    def fileno(self) -> int:
        """Return a descriptor to watch, -1 when somebody else reads."""

    def read(self) -> None:
        """Hand on what was received."""

    def send(self, message: bytes) -> None:
        """Send one message."""

    def close(self) -> None:
        """End it, as a crash does."""


class UdpLink:
    """A socket with its own port."""

    def __init__(self, port: int, take: Take) -> None:
        self._take = take
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect(("127.0.0.1", port))
        self._socket.setblocking(False)

    def fileno(self) -> int:
        return self._socket.fileno()

    def read(self) -> None:
        while self.fileno() >= 0:
            try:
                data = self._socket.recv(65535)
            except BlockingIOError:
                return
            self._take(data)

    def send(self, message: bytes) -> None:
        self._socket.send(message)

    def close(self) -> None:
        self._socket.close()


class TcpStream:
    """A connection; it ends with a reset, as one of a board without power does not even do."""

    def __init__(self, port: int, take: Take) -> None:
        self._take = take
        self._rest = b""
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=seconds(10))
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET_AT_ONCE)
        self._socket.setblocking(False)

    def fileno(self) -> int:
        return self._socket.fileno()

    def read(self) -> None:
        try:
            data = self._socket.recv(65536)
        except BlockingIOError:
            return
        assert data, "the agent hung up"
        self._rest += data
        while len(self._rest) >= 2 and self.fileno() >= 0:
            end = 2 + int.from_bytes(self._rest[:2], "little")
            if len(self._rest) < end:
                return
            message, self._rest = self._rest[2:end], self._rest[end:]
            self._take(message)

    def send(self, message: bytes) -> None:
        frame = len(message).to_bytes(2, "little") + message
        assert self._socket.send(frame) == len(frame), "the agent does not read"

    def close(self) -> None:
        self._socket.close()


class SharedLine:
    """A terminal device that several clients share, each with an address."""

    def __init__(self, device: str) -> None:
        self._fd = os.open(device, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self._fd)
        self._out = bytearray()
        self._ends: dict[int, tuple[FrameDecoder, Take]] = {}

    def fileno(self) -> int:
        return self._fd

    def read(self) -> None:
        try:
            data = os.read(self._fd, 65536)
        except BlockingIOError:
            return
        for address, (decoder, take) in list(self._ends.items()):
            for _, message in decoder.feed(data):
                if address in self._ends:
                    take(message)

    def write(self) -> None:
        """Write what waits."""
        while self._out:
            try:
                done = os.write(self._fd, self._out)
            except BlockingIOError:
                return
            del self._out[:done]

    def close(self) -> None:
        os.close(self._fd)

    def end(self, address: int, take: Take) -> LineEnd:
        """Return the way of the client with an address (1 to 255)."""
        self._ends[address] = FrameDecoder(lambda *_: None, address), take
        return LineEnd(self, address)

    def send(self, message: bytes, address: int) -> None:
        self._out += encode_frame(message, 0, address)
        self.write()

    def forget(self, address: int) -> None:
        self._ends.pop(address, None)


class LineEnd:
    """One client on a shared line."""

    def __init__(self, line: SharedLine, address: int) -> None:
        self._line = line
        self._address = address

    def fileno(self) -> int:
        return -1

    def read(self) -> None:
        """The line reads."""

    def send(self, message: bytes) -> None:
        self._line.send(message, self._address)

    def close(self) -> None:
        self._line.forget(self._address)
