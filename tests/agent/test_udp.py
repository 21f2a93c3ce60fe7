# SPDX-License-Identifier: Apache-2.0
"""UDP on the loopback interface, over IPv4 and IPv6."""

from __future__ import annotations

import socket

import pytest

from microros_gen.agent.transport.sockets import UDP4, UDP6, Protocol
from microros_gen.agent.transport.udp import BATCH, Udp
from microros_gen.diagnostics import UserError
from tests.support.agent.client import XrceClient
from tests.support.agent.fakes import Bench
from tests.support.agent.served import Served

BOTH = pytest.mark.parametrize("protocol", [UDP4, UDP6], ids=lambda p: p.name)


def peer_of(transport: Udp) -> socket.socket:
    sender = socket.socket(transport.protocol.family, socket.SOCK_DGRAM)
    sender.connect((transport.protocol.loopback, transport.port))
    return sender


@BOTH
def test_a_client(protocol: Protocol) -> None:
    bench = Bench()
    transport = Udp(protocol, protocol.loopback, 0)
    with Served(transport, bench=bench) as served:
        client = XrceClient(peer_of(transport))  # type: ignore[arg-type]
        served.publish(client, range(100))
        (known,) = bench.agent.clients
        host = "127.0.0.1" if protocol is UDP4 else "[::1]"
        assert isinstance(client.socket, socket.socket)
        assert known.place == f"{host}:{client.socket.getsockname()[1]}"
        assert client.leave() == 0
        assert served.ready == [f"{protocol.name} {host}:{transport.port}"]
    assert not bench.log.counters, bench.text.getvalue()


def test_both_versions_have_the_same_port() -> None:
    first = Udp(UDP6, "::", 0)
    second = Udp(UDP4, "0.0.0.0", first.port)
    assert first.port == second.port
    first.close()
    second.close()


@BOTH
def test_a_batch_is_bounded_and_nothing_is_lost(protocol: Protocol) -> None:
    transport = Udp(protocol, protocol.loopback, 0)
    peer = peer_of(transport)
    for number in range(BATCH + 10):
        peer.send(bytes((number,)))
    received: list[bytes] = []
    while len(received) < BATCH + 10:  # a slow machine has shorter batches: they are bounded by time, too
        before = len(received)
        transport.pump(lambda data, _address, _transport: received.append(data))
        assert 0 < len(received) - before <= BATCH
    assert received == [bytes((number,)) for number in range(BATCH + 10)]
    transport.close()


@BOTH
def test_a_peer_that_is_gone_and_a_message_too_large(protocol: Protocol) -> None:
    """Errors of the network are no errors of the agent."""
    transport = Udp(protocol, protocol.loopback, 0)
    peer = peer_of(transport)
    peer.send(b"hello")
    addresses: list[object] = []
    transport.pump(lambda _data, address, _transport: addresses.append(address))
    transport.send(bytes(70_000), addresses[0])
    peer.close()
    for _ in range(3):
        transport.send(b"x", addresses[0])
        transport.pump(lambda *_: None)
    other = peer_of(transport)
    other.send(b"y")
    received: list[bytes] = []
    transport.pump(lambda data, _address, _transport: received.append(data))
    assert received == [b"y"]
    transport.close()


@pytest.mark.parametrize(
    ("protocol", "host", "wanted"),
    [
        (
            UDP4,
            "::1",
            "'::1' is not an IPv4 address of this machine. --bind takes one of them, or 0.0.0.0 for all",
        ),
        (
            UDP6,
            "127.0.0.1",
            "is not an IPv6 address of this machine. --bind takes one of them, or :: for all",
        ),
    ],
)
def test_what_cannot_be_bound(protocol: Protocol, host: str, wanted: str) -> None:
    with pytest.raises(UserError) as error:
        Udp(protocol, host, 0)
    assert wanted in str(error.value)


@BOTH
def test_a_port_in_use(protocol: Protocol) -> None:
    first = Udp(protocol, protocol.loopback, 0)
    with pytest.raises(UserError, match=f"UDP port {first.port} is in use; choose another with --port"):
        Udp(protocol, protocol.loopback, first.port)
    first.close()
