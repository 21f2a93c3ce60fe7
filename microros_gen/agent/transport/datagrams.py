# SPDX-License-Identifier: Apache-2.0
"""Sending of several datagrams to one client with few system calls.

Most of what a datagram costs is the system call and, on one machine, that it wakes the receiver.
"""

from __future__ import annotations

import contextlib
import socket
import struct
from typing import Final

AT_ONCE_BYTES: Final = 65_000
"""Maximum number of bytes in one call: the system takes no more than in one datagram."""
UDP_SEGMENT: Final = 103
"""Option of Linux 4.18 and later (udp(7)): the bytes of a call are datagrams of this size; the last may be shorter."""


def takes_several(opened: socket.socket) -> bool:
    """Return whether the system knows UDP_SEGMENT; one that does not ignores it, and sends a call as one datagram."""
    try:
        opened.getsockopt(socket.IPPROTO_UDP, UDP_SEGMENT)
    except OSError:
        return False
    return True


def send_datagrams(connected: socket.socket, datagrams: list[bytes], several: bool) -> None:
    """Send datagrams in their order; one that cannot be sent is lost.

    `several`: a call may take more than one (see `takes_several`).
    """
    at = 0
    while at < len(datagrams):
        end = _run(datagrams, at) if several else at + 1
        if end - at == 1 or not _send_run(connected, datagrams[at:end]):
            for datagram in datagrams[at:end]:
                _send(connected, datagram)
        at = end


def _run(datagrams: list[bytes], at: int) -> int:
    """Return the end of those from `at` on that one call can send: of equal size, the last one may be shorter."""
    size = len(datagrams[at])
    most = min(len(datagrams), at + max(1, AT_ONCE_BYTES // max(1, size)))
    end = at + 1
    while end < most and len(datagrams[end]) == size:
        end += 1
    return end + 1 if end < most and len(datagrams[end]) < size else end


def _send_run(connected: socket.socket, datagrams: list[bytes]) -> bool:
    """Send datagrams in one call; return False if the system sent none of them.

    It refuses datagrams larger than the packets of the network.
    """
    option = (socket.IPPROTO_UDP, UDP_SEGMENT, struct.pack("=H", len(datagrams[0])))
    try:
        connected.sendmsg(datagrams, (option,))
    except OSError:
        return False
    return True


def _send(connected: socket.socket, data: bytes) -> None:
    try:
        connected.send(data)
    except ConnectionRefusedError:  # the error of an earlier one was reported; this one was not sent
        with contextlib.suppress(OSError):
            connected.send(data)
    except OSError:
        return  # a datagram may always be lost
