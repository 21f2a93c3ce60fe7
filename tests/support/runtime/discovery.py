# SPDX-License-Identifier: Apache-2.0
"""INFO of an agent that is searched for."""

from __future__ import annotations

import socket
import struct


def locator(host: str, port: int) -> bytes:
    return b"\x01" + socket.inet_aton(host) + b"\0" + struct.pack("<H", port)


def info(*locators: bytes) -> bytes:
    """Return the INFO that the public agent was seen to send; each locator has eight bytes, so all are aligned."""
    payload = bytes.fromhex("0009fffd 0000 010d 58524345 0100010f 00 010d 00 0100 0000")
    payload += struct.pack("<I", len(locators)) + b"".join(locators)
    return b"\x80\0\0\0\x06\x01" + struct.pack("<H", len(payload)) + payload
