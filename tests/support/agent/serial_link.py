# SPDX-License-Identifier: Apache-2.0
"""The client's side of a serial line, byte by byte and on its own: the oracle for the agent's framing."""

from __future__ import annotations

import os
import select
import time
import tty

from tests.support.patience import deadline


def crc_arc(data: bytes) -> int:
    """Return the CRC-16/ARC of `data`, a bit at a time."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return crc


def frame(payload: bytes, source: int = 1, destination: int = 0) -> bytes:
    """Return the frame that carries `payload`."""
    plain = bytes((source, destination, len(payload) & 0xFF, len(payload) >> 8)) + payload
    crc = crc_arc(payload)
    out = bytearray(b"\x7e")
    for byte in plain + bytes((crc & 0xFF, crc >> 8)):
        out += bytes((0x7D, byte ^ 0x20)) if byte in (0x7D, 0x7E) else bytes((byte,))
    return bytes(out)


class Frames:
    """Cuts what the agent sends into frames to one client."""

    def __init__(self, address: int) -> None:
        self._address = address
        self._bytes = bytearray()
        self._escaped = False

    def take(self, byte: int) -> bytes | None:
        """Take one byte; return the payload that it completes."""
        if byte == 0x7E:
            self._bytes = bytearray()
            self._escaped = False
            return None
        if byte == 0x7D:
            self._escaped = True
            return None
        self._bytes.append(byte ^ 0x20 if self._escaped else byte)
        self._escaped = False
        found = self._bytes
        if len(found) < 6 or len(found) != 6 + (found[2] | found[3] << 8):
            return None
        payload = bytes(found[4:-2])
        assert (found[-2] | found[-1] << 8) == crc_arc(payload), "the agent's checksum is wrong"
        assert found[0] == 0
        return payload if found[1] == self._address else None


class SerialLink:
    """What `XrceClient` needs of a socket, over a terminal device."""

    def __init__(self, device: str | int, address: int = 1) -> None:
        """Open a device, or take a descriptor that somebody else closes."""
        self._own = isinstance(device, str)
        self._fd = os.open(device, os.O_RDWR | os.O_NOCTTY) if isinstance(device, str) else device
        if self._own:
            tty.setraw(self._fd)
        self._address = address
        self._frames = Frames(address)
        self._pending = b""
        self._timeout_s = 0.0

    def settimeout(self, seconds: float) -> None:
        """Set how long `recv` waits."""
        self._timeout_s = seconds

    def send(self, payload: bytes) -> None:
        """Send a message."""
        self.send_raw(frame(payload, self._address))

    def send_raw(self, data: bytes) -> None:
        """Send bytes as they are."""
        while data:
            data = data[os.write(self._fd, data) :]

    def recv(self, _size: int) -> bytes:
        """Return the next message; raise TimeoutError if none arrives in time."""
        end = deadline(self._timeout_s)
        while True:
            for at, byte in enumerate(self._pending):
                payload = self._frames.take(byte)
                if payload is not None:
                    self._pending = self._pending[at + 1 :]
                    return payload
            self._pending = b""
            left = end - time.monotonic()
            if left <= 0 or not select.select([self._fd], [], [], left)[0]:
                raise TimeoutError
            self._pending = os.read(self._fd, 4096)

    def close(self) -> None:
        """Close the device."""
        if self._own:
            os.close(self._fd)
