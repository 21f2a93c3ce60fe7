# SPDX-License-Identifier: Apache-2.0
"""The sizes of messages that each transport takes, bytes."""

from __future__ import annotations

from microros_gen.application.model import LARGEST_UDP_PAYLOAD, Application

LARGEST_MTU = 0xFFFF  # application.schema.json says it too
CANFD_MTU = 63
"""A frame of CAN FD has 64 bytes; the first is the length of the message, as the public client and agent have it."""
# One Ethernet frame: larger datagrams are fragmented by IP, which small stacks drop. The sizes of serial and custom
# transports are those that micro-ROS has.
DEFAULT_MTU = {"udp": 1472, "tcp": 1460, "serial": 512, "canfd": CANFD_MTU, "custom": 512}
# A sample that waits alone in its queue comes in so many pieces: the input buffer holds one. A board has a ring of
# twice that in front of a serial line (client/plan/board.py). Smaller ones would save little, and each is acknowledged.
FRAGMENTS_PER_SAMPLE = {"udp": 3, "tcp": 3, "serial": 8, "canfd": 8, "custom": 8}
SEAL_OVERHEAD = 32
"""Bytes of a record around its message (docs/howto/seal.md)."""
SEAL_HANDSHAKE = 60
"""Bytes of each message of its handshake."""
_BYTE_STREAMS = ("tcp", "serial")
_FRAME_REST = 6
"""Bytes of a serial frame around its message, but the flag: addresses, length, CRC."""
_LARGEST = {"udp": LARGEST_UDP_PAYLOAD, "canfd": CANFD_MTU}


def default_mtu(transport: str, create: int) -> int:
    """Return the largest message without `transport.mtu`: a line without datagrams carries any CREATE."""
    if transport in _BYTE_STREAMS:
        return max(DEFAULT_MTU[transport], min(create, LARGEST_MTU))
    return DEFAULT_MTU[transport]


def largest_mtu(transport: str) -> int:
    """Return the largest message that a transport may be configured for."""
    return _LARGEST.get(transport, LARGEST_MTU)


def seal_overhead(application: Application) -> int:
    """Return the bytes of a record around each message; 0: messages are not sealed."""
    return SEAL_OVERHEAD if application.transport.seal else 0


def carried(size: int, application: Application) -> int:
    """Return the bytes that the transport carries for a message of `size` bytes, sealed if the application says so."""
    return max(size + SEAL_OVERHEAD, SEAL_HANDSHAKE) if application.transport.seal else size


def most_in_buffer(send_buffer: int, application: Application) -> int:
    """Return the largest message whose frame fits the `send_buffer` of a serial line, bytes.

    Each byte but the flag may be stuffed, and one byte of the buffer is never used.
    """
    return (send_buffer - 2) // 2 - _FRAME_REST - seal_overhead(application)


def mtu_is(application: Application, transport: str) -> str:
    """Return what a diagnostic says in front of the number."""
    if transport == "canfd":
        return "a CAN FD frame holds"
    return "transport.mtu is" if application.transport.mtu else "without transport.mtu a datagram holds"


def part_size(kind: str, mtu: int, send_buffer: int, application: Application) -> int:
    """Return the bytes of a message with a part of one that the application writes while it is sent.

    As large as the transport `kind` takes at once: `transport.mtu`, or the default, or `mtu`, the largest other
    message, if that is larger; on a serial line what its `send_buffer` holds with every byte stuffed.
    """
    largest = application.transport.mtu or max(DEFAULT_MTU[kind] - seal_overhead(application), mtu)
    return min(largest, most_in_buffer(send_buffer, application)) if kind == "serial" else largest
