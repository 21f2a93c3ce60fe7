# SPDX-License-Identifier: Apache-2.0
"""A CAN FD bus without a kernel that has CAN: every frame of a member goes to all others, in one order.

Members connect to a socket (SOCK_SEQPACKET) and exchange struct canfd_frame, as they do with SocketCAN.
"""

from __future__ import annotations

import select
import selectors
import socket
import struct
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType

FRAME = struct.Struct("=IBB2x64s")
EXTENDED = 0x8000_0000

Lost = Callable[[bytes], bool]
"""Whether the bus loses a frame; a real one does where a receiver has no room."""

Fate = Callable[[bytes], Sequence[bytes]]
"""What becomes of a frame that is not lost: those that arrive instead of it, in order, as a gateway might pass them."""


def record(identifier: int, data: bytes, flags: int = EXTENDED) -> bytes:
    """Return the record of a frame with these bytes of data."""
    return FRAME.pack(identifier | flags, len(data), 0, data)


class CanBus:
    """A bus, at `path` or a temporary one; it runs in a thread within the context."""

    def __init__(self, path: Path | None = None) -> None:
        self._folder = tempfile.TemporaryDirectory()  # a short path: the name of a device has 63 bytes
        path = path or Path(self._folder.name) / "bus"
        self._listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._listener.bind(str(path))
        self._listener.listen()
        self.device = f"unix:{path}"
        self.frames: list[bytes] = []
        """Every frame that was not lost, in order."""
        self.losses = 0
        self.echoes = False
        """Whether a frame goes back to its sender alone, as with a controller in loopback mode."""
        self.lost: Lost = lambda frame: False
        self.fate: Fate = lambda frame: (frame,)
        self._members: list[socket.socket] = []
        self._passing = threading.Lock()
        self._selector = selectors.DefaultSelector()
        self._wake, self._woken = socket.socketpair()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> CanBus:
        for end in (self._listener, self._woken):
            self._selector.register(end, selectors.EVENT_READ)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._wake.send(b"x")
        self._thread.join()
        for end in (*self._members, self._listener, self._wake, self._woken):
            end.close()
        self._selector.close()
        self._folder.cleanup()

    def identifiers(self) -> set[int]:
        """Return the identifiers of all frames."""
        return {int.from_bytes(frame[:4], sys.byteorder) & ~EXTENDED for frame in tuple(self.frames)}

    @property
    def passed(self) -> int:
        """How many frames there were."""
        return len(self.frames) + self.losses

    def is_idle(self) -> bool:
        """Return whether each frame that was sent so far has reached the other members."""
        if not self._passing.acquire(blocking=False):  # it may wait for a member
            return False
        try:
            return not select.select([*self._members, self._listener], [], [], 0)[0]
        finally:
            self._passing.release()

    def put(self, frame: bytes) -> None:
        """Send a frame of nobody in particular to all members."""
        self._spread(frame, None)

    def _run(self) -> None:
        while True:
            for key, _ in self._selector.select():
                end = key.fileobj
                assert isinstance(end, socket.socket)
                if end is self._woken:
                    return
                with self._passing:
                    if end is self._listener:
                        member = self._listener.accept()[0]
                        self._members.append(member)
                        self._selector.register(member, selectors.EVENT_READ)
                    else:
                        self._read(end)

    def _read(self, member: socket.socket) -> None:
        try:
            frame = member.recv(FRAME.size + 1)
        except OSError:
            frame = b""
        if not frame:
            self._remove(member)
        elif self.lost(frame):
            self.losses += 1
        else:
            for passed in self.fate(frame):
                self._spread(passed, member)

    def _spread(self, frame: bytes, sender: socket.socket | None) -> None:
        self.frames.append(frame)
        for member in [m for m in self._members if (m is sender) == (self.echoes and sender is not None)]:
            try:
                member.send(
                    frame, socket.MSG_NOSIGNAL
                )  # waits for it: a controller is never slower than its bus
            except OSError:
                self._remove(member)

    def _remove(self, member: socket.socket) -> None:
        if member in self._members:
            self._selector.unregister(member)
            self._members.remove(member)
            member.close()
