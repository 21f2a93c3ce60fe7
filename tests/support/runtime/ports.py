# SPDX-License-Identifier: Apache-2.0
"""Ports of scripted agents that stay the same from test to test."""

from __future__ import annotations

import socket
from contextlib import suppress

_LAST: dict[tuple[str, int], int] = {}


def bind(listener: socket.socket, host: str) -> int:
    """Bind to the port of the last agent of this kind where it is free, else to any; return it.

    A client has the port of its agent built in: where the port stays, tests share the program.
    """
    kind = (host, int(listener.type))
    try:
        listener.bind((host, _LAST.get(kind, 0)))
    except OSError:  # another process has it now, or an agent of this one still does
        listener.bind((host, 0))
    port: int = listener.getsockname()[1]
    _LAST[kind] = port
    return port


def stop(listener: socket.socket) -> None:
    """Close a socket that a thread may be reading: without the shutdown its port would stay in use until it returns."""
    with suppress(OSError):  # a socket of datagrams is not connected, and wakes its reader all the same
        listener.shutdown(socket.SHUT_RDWR)
    listener.close()
