# SPDX-License-Identifier: Apache-2.0
"""The part of SocketCAN that the agent sees of an interface that comes and goes, for kernels without CAN.

As in net/can/raw.c of Linux: an interface that goes down or is removed leaves ENETDOWN or ENODEV at its sockets and
wakes them; one that is down can be bound, and reports that at SO_ERROR; one that is absent has no index to bind to.
"""

from __future__ import annotations

import errno
import fcntl
import os
import socket
import struct

import pytest

from microros_gen.agent.transport.base import Receive
from microros_gen.agent.transport.canfd import CanFd

_SOCKET = socket.socket
_IFREQ = struct.Struct("=16si20x")
FD_MTU, CLASSIC_MTU = 72, 16
"""Bytes of struct canfd_frame and of struct can_frame (linux/can.h)."""


class CanInterface:
    """The interface `can0`, which exists and is up; `attempts` counts sockets, `member` is the rest of the bus."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.absent = 0
        """The error of an interface that is down (ENETDOWN) or does not exist (ENODEV)."""
        self.mtu = FD_MTU
        self.attempts = 0
        self.member: socket.socket | None = None
        self.bound: _Socket | None = None
        monkeypatch.setattr(socket, "socket", self._socket)
        monkeypatch.setattr(fcntl, "ioctl", lambda *_: _IFREQ.pack(b"can0", self.mtu))

    def _socket(
        self, family: int = -1, kind: int = -1, protocol: int = -1, fileno: int | None = None
    ) -> socket.socket:
        if family != socket.AF_CAN:
            return _SOCKET(family, kind, protocol, fileno)
        self.attempts += 1
        return _Socket(self)

    def leaves(self, error: int, wakes: bool = True) -> None:
        """Let it go down or be removed. `wakes`: what waits for frames ends, else only the next call fails."""
        self.absent = error
        assert self.bound is not None
        assert self.member is not None
        self.bound.error = error
        if wakes:
            self.member.close()

    def close(self) -> None:
        """Close the rest of the bus."""
        if self.member is not None:
            self.member.close()


class _Socket(_SOCKET):
    """A socket of the interface: one end of a pair, of which the test has the other one."""

    def __init__(self, interface: CanInterface) -> None:
        own, self._other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        super().__init__(fileno=own.detach())
        self._interface = interface
        self.error = 0

    def setsockopt(self, *_: object) -> None:
        """Accept the options of CAN."""

    def bind(self, address: object) -> None:
        """Bind to the interface, up or down."""
        assert address == ("can0",)
        if self._interface.absent == errno.ENODEV:
            raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))
        self._interface.close()
        self._interface.member, self._interface.bound = self._other, self

    def getsockopt(self, level: int, option: int) -> int:  # type: ignore[override]
        """Return the pending error."""
        return self._interface.absent if option == socket.SO_ERROR else 0

    def recv(self, *arguments: int) -> bytes:
        """Receive a frame, or raise the pending error."""
        self._fail()
        return super().recv(*arguments)

    def send(self, *arguments: object) -> int:
        """Send a frame, or raise the pending error."""
        self._fail()
        return super().send(*arguments)  # type: ignore[arg-type]

    def close(self) -> None:
        """Close it; the rest of the bus of a socket that was never bound, too."""
        if self._interface.bound is not self:
            self._other.close()
        super().close()

    def _fail(self) -> None:
        if self.error:
            raise OSError(self.error, os.strerror(self.error))


def ticks(can: CanFd, receive: Receive, start: float, seconds: float) -> float:
    """Let `seconds` of a played clock pass for a transport, as the loop of the agent does; return its time."""
    now, end = start, start + seconds
    while now < end:
        now += 0.05
        can.tick(now)
        can.pump(receive)
    return now
