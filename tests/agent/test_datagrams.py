# SPDX-License-Identifier: Apache-2.0
"""Datagrams that are sent in one call arrive as they would one by one."""

from __future__ import annotations

import errno
import socket
from collections.abc import Iterator, Sequence

import pytest

from microros_gen.agent.fairness import Account
from microros_gen.agent.transport.datagrams import UDP_SEGMENT, send_datagrams, takes_several
from microros_gen.agent.transport.sockets import UDP4, UDP6, Protocol
from microros_gen.agent.transport.udp import AT_ONCE, Udp
from tests.support.patience import seconds

BOTH = pytest.mark.parametrize("protocol", [UDP4, UDP6], ids=lambda p: p.name)
SIZES = (
    (64,) * 10,  # samples of one size
    (512, 512, 60),  # the fragments of a sample
    (512, 512, 60, 512, 512, 60),
    (10, 20, 30),
    (30, 20, 10),
    (60_000, 60_000, 100),  # more than one call takes
    (1,),
    (200, 13, 13, 13, 200, 200),
)


class Counting(socket.socket):
    """A socket that counts its calls; with `fault` it refuses datagrams that are sent in one call."""

    calls = 0
    fault = 0

    def send(self, *arguments: object) -> int:
        self.calls += 1
        return super().send(*arguments)  # type: ignore[arg-type]

    def sendmsg(self, *arguments: object) -> int:
        self.calls += 1
        if self.fault:
            raise OSError(self.fault, "refused by the test")
        return super().sendmsg(*arguments)  # type: ignore[arg-type]


@pytest.fixture(params=[UDP4, UDP6], ids=lambda p: p.name)
def ends(request: pytest.FixtureRequest) -> Iterator[tuple[Counting, socket.socket]]:
    protocol: Protocol = request.param
    with socket.socket(protocol.family, socket.SOCK_DGRAM) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        receiver.bind((protocol.loopback, 0))
        receiver.settimeout(seconds(10))
        with Counting(protocol.family, socket.SOCK_DGRAM) as sender:
            sender.connect(receiver.getsockname())
            sender.setblocking(False)
            yield sender, receiver


def datagrams(sizes: Sequence[int]) -> list[bytes]:
    return [bytes((place,)) * size for place, size in enumerate(sizes)]


@pytest.mark.parametrize("sizes", SIZES, ids=str)
def test_they_arrive_in_order_and_separately(
    ends: tuple[Counting, socket.socket], sizes: Sequence[int]
) -> None:
    sender, receiver = ends
    send_datagrams(sender, datagrams(sizes), several=True)
    assert [receiver.recv(65_535) for _ in sizes] == datagrams(sizes)


@pytest.mark.parametrize(
    ("sizes", "calls"),
    [((64,) * 10, 1), ((512, 512, 60), 1), ((512, 512, 60) * 4, 4), ((10, 20, 30), 3)],
    ids=str,
)
def test_those_of_one_size_take_one_call(
    ends: tuple[Counting, socket.socket], sizes: Sequence[int], calls: int
) -> None:
    sender, receiver = ends
    send_datagrams(sender, datagrams(sizes), several=True)
    assert sender.calls == calls
    assert [receiver.recv(65_535) for _ in sizes] == datagrams(sizes)


@pytest.mark.parametrize("fault", [errno.EINVAL, errno.EIO, errno.EMSGSIZE])
def test_a_system_that_refuses_gets_them_one_by_one(ends: tuple[Counting, socket.socket], fault: int) -> None:
    """As for datagrams larger than the packets of the network."""
    sender, receiver = ends
    sender.fault = fault
    send_datagrams(sender, datagrams((300, 300, 5)), several=True)
    assert [receiver.recv(65_535) for _ in range(3)] == datagrams((300, 300, 5))


def test_a_system_without_the_option_gets_them_one_by_one(ends: tuple[Counting, socket.socket]) -> None:
    """Before Linux 4.18: it would send all of a call as one datagram, and report nothing."""
    sender, receiver = ends
    send_datagrams(sender, datagrams((300, 300, 5)), several=False)
    assert sender.calls == 3
    assert [receiver.recv(65_535) for _ in range(3)] == datagrams((300, 300, 5))


def test_the_option_is_asked_for() -> None:
    """A TCP socket refuses it, as a system does that does not know it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagram, socket.socket() as stream:
        assert takes_several(datagram)
        assert not takes_several(stream)


def test_a_peer_that_is_gone_takes_nothing_and_breaks_nothing(ends: tuple[Counting, socket.socket]) -> None:
    sender, receiver = ends
    receiver.close()
    for _ in range(3):
        send_datagrams(sender, datagrams((64, 64, 64)), several=True)


def test_the_option_of_the_system_is_the_one_that_is_used() -> None:
    assert getattr(socket, "UDP_SEGMENT", UDP_SEGMENT) == UDP_SEGMENT


@BOTH
def test_a_transport_collects_until_a_flush_or_until_there_are_many(protocol: Protocol) -> None:
    transport = Udp(protocol, protocol.loopback, 0)
    with socket.socket(protocol.family, socket.SOCK_DGRAM) as peer:
        peer.connect((protocol.loopback, transport.port))
        peer.send(b"hello")
        addresses: list[object] = []
        while not addresses:
            transport.pump(lambda _data, address, _transport: addresses.append(address))
        transport.claim(addresses[0], Account())
        peer.setblocking(False)
        sent = datagrams((20,) * (AT_ONCE + 1))
        for datagram in sent[: AT_ONCE - 1]:
            transport.send(datagram, addresses[0])
        with pytest.raises(BlockingIOError):
            peer.recv(100)
        for datagram in sent[AT_ONCE - 1 :]:
            transport.send(datagram, addresses[0])
        peer.settimeout(seconds(10))
        assert [peer.recv(100) for _ in range(AT_ONCE)] == sent[:-1]
        transport.flush()
        assert peer.recv(100) == sent[-1]
        transport.send(b"last", addresses[0])
        transport.release(addresses[0])
        assert peer.recv(100) == b"last", "what was collected is sent before the socket is closed"
    transport.close()
