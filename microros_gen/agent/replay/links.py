# SPDX-License-Identifier: Apache-2.0
"""The client's end of a transport: what a replay sends messages of clients on."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Hashable
from typing import Protocol

from microros_gen.agent.framing import FrameDecoder, LengthDecoder, encode_frame, encode_length
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.canfd import CanFd
from microros_gen.agent.transport.serial import open_device, speeds
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass

CONNECT_S = 5.0
"""Seconds for a TCP connection to be accepted, and for the agent to take a message."""
_READ_BYTES = 65_535
Received = Callable[[int, bytes], None]
"""Function that gets the client's number on a line or a bus (0 on a socket), and a message for it."""


class Link(Protocol):
    """One end. It serves one client, or all clients of a line or a bus, by number."""

    def fileno(self) -> int:
        """Return the descriptor that is readable when something has arrived."""

    def send(self, number: int, message: bytes) -> None:
        """Send a message of a client. Raises OSError if the other end is gone."""

    def receive(self, received: Received) -> None:
        """Hand on what has arrived. Raises OSError if the other end is gone."""

    def close(self) -> None:
        """Close the descriptor."""


@dataclass(frozen=True)
class Place:
    """Where an agent is: a kind of transport, and its address (`127.0.0.1:8888`), device or interface."""

    kind: str
    address: str
    baud: int

    @property
    def shared(self) -> bool:
        """Whether all clients share one link."""
        return self.kind not in PROTOCOLS


def open_link(place: Place, log: EventLog) -> Link:
    """Return a link to the agent at a place. Raises UserError if it cannot be reached."""
    try:
        if place.kind in PROTOCOLS:
            return _SocketLink(place)
        if place.kind == "canfd":
            return _CanLink(place.address, log)
        return _SerialLink(place)
    except (OSError, ValueError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UserError(
            [
                Diagnostic(
                    f"{place.kind} {place.address} cannot be reached: {reason}",
                    hint="Start the agent first, and give its ready line: --at udp4:127.0.0.1:8888",
                    id="MG-9797",
                )
            ]
        ) from error


class _SocketLink:
    """UDP, or TCP with its lengths."""

    def __init__(self, place: Place) -> None:
        protocol = PROTOCOLS[place.kind]
        host, _, port = place.address.rpartition(":")
        kind = socket.SOCK_STREAM if protocol.stream else socket.SOCK_DGRAM
        self._decoder = LengthDecoder() if protocol.stream else None
        self._socket = socket.socket(protocol.family, kind)
        self._socket.settimeout(CONNECT_S)
        try:
            self._socket.connect((host.strip("[]"), int(port)))
        except (OSError, ValueError, OverflowError):
            self._socket.close()
            raise

    def fileno(self) -> int:
        """See Link."""
        return self._socket.fileno()

    def send(self, number: int, message: bytes) -> None:
        """See Link."""
        if self._decoder is not None:
            self._socket.sendall(encode_length(message))
            return
        try:
            self._socket.send(message)
        except ConnectionRefusedError:
            return  # nobody is at the port yet; the answer is missed, and that is reported

    def receive(self, received: Received) -> None:
        """See Link."""
        try:
            data = self._socket.recv(_READ_BYTES)
        except ConnectionRefusedError:
            return
        if self._decoder is None:
            received(0, data)
            return
        if not data:
            raise ConnectionError("the agent closed the connection")
        for message in self._decoder.feed(data):
            received(0, message)

    def close(self) -> None:
        """See Link."""
        self._socket.close()


class _SerialLink:
    """A serial line, with a decoder for each client."""

    def __init__(self, place: Place) -> None:
        if place.baud not in speeds():
            raise ValueError(f"this system has no serial speed of {place.baud} bit/s")
        self._file = open_device(place.address, place.baud)
        self._decoders: dict[int, FrameDecoder] = {}

    def fileno(self) -> int:
        """See Link."""
        return self._file

    def send(self, number: int, message: bytes) -> None:
        """See Link."""
        self._decoders.setdefault(number, FrameDecoder(_ignored, address=number))
        frame = encode_frame(message, 0, source=number)
        os.set_blocking(self._file, True)
        try:
            while frame:
                frame = frame[os.write(self._file, frame) :]
        finally:
            os.set_blocking(self._file, False)

    def receive(self, received: Received) -> None:
        """See Link."""
        data = os.read(self._file, _READ_BYTES)
        for number, decoder in self._decoders.items():
            for _, message in decoder.feed(data):
                received(number, message)

    def close(self) -> None:
        """See Link."""
        os.close(self._file)


class _CanLink:
    """A CAN FD bus: both ends use the client's identifier."""

    def __init__(self, device: str, log: EventLog) -> None:
        self._bus = CanFd(device, log)

    def fileno(self) -> int:
        """See Link."""
        return self._bus.fileno()

    def send(self, number: int, message: bytes) -> None:
        """See Link."""
        self._bus.send(message, (self._bus.label, number))

    def receive(self, received: Received) -> None:
        """See Link."""

        def taken(message: bytes, address: Hashable, _transport: Transport) -> None:
            assert isinstance(address, tuple)
            received(address[1], message)

        self._bus.pump(taken)

    def close(self) -> None:
        """See Link."""
        self._bus.close()


def _ignored(kind: str, found: str) -> None:
    """Ignore frames for other clients of the line."""
