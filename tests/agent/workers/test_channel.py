# SPDX-License-Identifier: Apache-2.0
"""The channel between front and worker: order, what waits, and the end; and codes of addresses."""

from __future__ import annotations

import select
import socket

import pytest

from microros_gen.agent.transport.base import RemoteAddress
from microros_gen.agent.workers.addresses import (
    FREE_BYTES,
    SHARE_BYTES,
    Known,
    remote_address,
    remote_code,
    udp_code,
    udp_peer,
)
from microros_gen.agent.workers.channel import READ_BYTES, Channel, Kind, message_frame, message_of


def pair() -> tuple[Channel, Channel]:
    near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
    return Channel(near), Channel(far)


def readable(channel: Channel) -> bool:
    return bool(select.select([channel.fileno()], [], [], 0)[0])


def test_frames_arrive_whole_and_in_order_whatever_waits() -> None:
    near, far = pair()
    sent = [(Kind.MESSAGE, bytes([n % 256]) * (n * 37 % 3000)) for n in range(2000)]
    for kind, content in sent:
        near.send(kind, content)
    near.flush()
    assert near.waiting > 0, "more than the system takes at once"
    assert not readable(near)
    received: list[tuple[Kind, bytes]] = []
    while len(received) < len(sent):
        received += far.receive()
        if readable(near):
            assert near.receive() == []  # what waits is sent when there is room
    assert received == sent
    assert near.waiting == 0
    assert not readable(near)
    near.close()
    far.close()


def test_a_frame_that_is_larger_than_what_is_read_at_once() -> None:
    near, far = pair()
    content = bytes(3 * READ_BYTES)
    near.send(Kind.STATUS, content)
    received: list[tuple[Kind, bytes]] = []
    while not received:
        near.flush()
        received += far.receive()
    assert received == [(Kind.STATUS, content)]
    near.close()
    far.close()


def test_the_end_arrives_after_the_last_frame() -> None:
    near, far = pair()
    near.send(Kind.READY)
    near.finish(1.0)
    assert near.closed
    assert far.receive() == [(Kind.READY, b"")]
    assert not far.closed
    assert far.receive() == []
    assert far.closed
    far.send(Kind.STOP)
    far.flush()
    assert far.receive() == []


def test_a_side_that_takes_nothing_does_not_hold_up_the_end() -> None:
    near, far = pair()
    near.send(Kind.STATUS, bytes(4 << 20))
    near.finish(0.1)
    assert near.closed
    far.close()


def test_what_is_sent_to_who_has_ended_is_gone() -> None:
    near, far = pair()
    far.close()
    near.send(Kind.ASK)
    near.flush()
    near.send(Kind.ASK)
    assert near.waiting == 0
    assert readable(near), "so that whoever waits for it sees the end"
    assert near.receive() == []
    assert near.closed


@pytest.mark.parametrize("peer", [("127.0.0.1", 7), ("fe80::1%eth0", 65535, 0, 3)])
def test_socket_addresses_round_trip(peer: tuple[object, ...]) -> None:
    code = udp_code(peer)
    assert udp_peer(code) == peer
    assert message_of(message_frame(3, code, b"\0data")) == (3, code, b"\0data")


def test_other_addresses_round_trip() -> None:
    address = RemoteAddress("serial /dev/ttyS0", 5, "/dev/tty\udcff client 1", "/dev/tty\udcff", 1)
    assert remote_address(address.transport, remote_code(address)) == address


def test_one_sender_has_a_share_of_what_waits() -> None:
    flood, far = Known(b"a", None), Known(b"b", None)
    taken = 0
    while flood.may_send(1000, 1, 0, FREE_BYTES + 1):
        taken += 1000
    assert SHARE_BYTES - 1000 < taken <= SHARE_BYTES
    assert far.may_send(1000, 1, 0, FREE_BYTES + 1)
    assert flood.may_send(1000, 1, 0, 0), "little waits for the worker"
    assert flood.may_send(1000, 2, 7, FREE_BYTES + 1), "it has a share at each worker"
    assert not flood.may_send(1000, 1, 0, FREE_BYTES + 1), "and messages to another one do not renew it"
    assert flood.may_send(1000, 1, 1, FREE_BYTES + 1), "it has taken all since"
