# SPDX-License-Identifier: Apache-2.0
"""The channel between the front of an agent and one of its workers: a pair of local stream sockets.

A frame is its length (32 bits), its kind, and its content. What the other side does not take yet waits in memory.
Messages of clients are dropped beyond a limit, as a network would drop them; all other frames always arrive, in order.
"""

from __future__ import annotations

import select
import socket
import struct
import time
from enum import IntEnum

_HEAD = struct.Struct("<IB")
_MESSAGE = struct.Struct("<BH")
READ_BYTES = 65_536
"""Bytes that are read before the answers are sent."""
SEND_BYTES = 32_768
"""Bytes that are collected before they are sent without waiting for `flush`."""
WAITING_BYTES = 4 << 20
"""Maximum bytes that wait for the other side; further messages of clients are dropped."""


class Kind(IntEnum):
    """Kinds of frames."""

    MESSAGE = 1
    """To a worker: from a client. From a worker: to a client."""
    BACK = 2
    """From a worker: a message that it got directly, outside of the session at that address."""
    CLAIMED = 3
    """From a worker: a client is in session at an address."""
    RELEASED = 4
    """From a worker: none is there any more."""
    DIRECT = 5
    """To a worker: all earlier messages from a claimed address have been passed on."""
    LEFT = 6
    """To a worker: the client at this address has another worker now."""
    ASK = 7
    """To a worker: answer with STATUS; with content, the states of all clients as well."""
    STATUS = 8
    """From a worker: a `Report`."""
    TYPE = 9
    """From a worker: a client has an endpoint of this type."""
    READY = 10
    """From a worker: it serves."""
    FAILED = 11
    """From a worker: it cannot start; its diagnostics."""
    RELOAD = 12
    """To a worker: the policy (pickled) that is in force now."""
    STOP = 13
    """To a worker: end."""
    NEWCOMER = 14
    """From a worker: the answer to a CREATE_CLIENT; no other worker may have a client at this address by then."""
    SEALED = 15
    """From a worker: a sealed message to a client."""
    SEALED_SAMPLE = 16
    """The same, with a best-effort sample in it."""
    REFUSAL = 17
    """From a worker: a message to somebody whose message was not accepted."""
    KEYS = 18
    """To a worker: the pre-shared keys (pickled) that are in force now."""
    MISSING = 19
    """From a worker: the keys (4 bytes each) of its clients to adopt that are not in session."""
    ADOPT = 20
    """To a worker: the key of its client to adopt that is the only one of all workers; empty: none is."""


class Channel:
    """One end. Its descriptor is readable when there is something to read, or room for what waits."""

    def __init__(self, end: socket.socket) -> None:
        """Take over a connected stream socket."""
        end.setblocking(False)
        self._socket = end
        self._input = bytearray()
        self._output = bytearray()
        self._epoll = select.epoll()
        self._epoll.register(end, select.EPOLLIN)
        self._watches_room = False
        self._is_broken = False
        self.closed = False
        """Whether the other side has ended."""
        self.drained = 0
        """How often nothing waited any more."""

    @property
    def waiting(self) -> int:
        """Bytes that wait for the other side."""
        return len(self._output)

    def fileno(self) -> int:
        """Return the descriptor to wait for."""
        return self._epoll.fileno()

    def send(self, kind: Kind, content: bytes = b"") -> None:
        """Send a frame, in `flush` at the latest. Never raises."""
        if self.closed or self._is_broken:
            return
        self._output += _HEAD.pack(len(content), kind)
        self._output += content
        if len(self._output) > SEND_BYTES and not self._watches_room:
            self.flush()

    def flush(self) -> None:
        """Send what waits, as far as the other side takes it. Never raises."""
        if not self._output or self.closed:
            return
        try:
            while self._output:
                del self._output[: self._socket.send(self._output)]
            self.drained += 1
        except BlockingIOError:
            pass
        except OSError:  # the other side has ended: `receive` finds out, after what it had sent
            self._output.clear()
            self._is_broken = True
        wanted = bool(self._output)
        if wanted is not self._watches_room:
            self._watches_room = wanted
            self._epoll.modify(self._socket, select.EPOLLIN | (select.EPOLLOUT if wanted else 0))

    def receive(self, most: int = READ_BYTES) -> list[tuple[Kind, bytes]]:
        """Return the frames that have arrived, without waiting; sets `closed` after the last one. Never raises.

        It reads `most` bytes at most; the descriptor stays readable if there are more.
        """
        if self._watches_room:
            self.flush()
        if self.closed:
            return []
        try:
            data = self._socket.recv(most)
        except BlockingIOError:
            return []
        except OSError:
            data = b""
        if not data:
            self._end()
            return []
        held = self._input
        held += data
        frames, at, size = [], 0, len(held)
        while size - at >= _HEAD.size:
            length, kind = _HEAD.unpack_from(held, at)
            end = at + _HEAD.size + length
            if end > size:
                break
            frames.append((Kind(kind), bytes(held[at + _HEAD.size : end])))
            at = end
        del held[:at]
        return frames

    def finish(self, wait_s: float) -> None:
        """Send what waits, in `wait_s` seconds at most, and close this end."""
        end = time.monotonic() + wait_s
        self.flush()
        while self._output and not self.closed and time.monotonic() < end:
            self._epoll.poll(0.05)
            self.flush()
        self._end()

    def close(self) -> None:
        """Close this end."""
        self._end()

    def _end(self) -> None:
        if not self.closed:
            self.closed = True
            self._output.clear()
            self._epoll.close()
            self._socket.close()


def message_frame(transport: int, code: bytes, data: bytes = b"") -> bytes:
    """Return the content of a frame about an address: the number of its transport, its code, and a message."""
    return _MESSAGE.pack(transport, len(code)) + code + data


def message_of(content: bytes) -> tuple[int, bytes, bytes]:
    """Return transport, code and message of such a content."""
    transport, length = _MESSAGE.unpack_from(content)
    end = _MESSAGE.size + length
    return transport, content[_MESSAGE.size : end], content[end:]
