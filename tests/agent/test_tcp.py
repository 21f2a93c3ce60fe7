# SPDX-License-Identifier: Apache-2.0
"""TCP on the loopback interface: framing, many connections, slow, silent, broken and flooding ones."""

from __future__ import annotations

import contextlib
import errno
import itertools
import random
import socket
import struct
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.framing import LengthDecoder
from microros_gen.agent.transport.addresses import host_of
from microros_gen.agent.transport.sockets import PROTOCOLS, TCP4, TCP6, UDP4, Protocol
from microros_gen.agent.transport.tcp import Tcp
from microros_gen.agent.transport.udp import Udp
from microros_gen.diagnostics import UserError
from tests.support.agent import captured
from tests.support.agent.client import XrceClient
from tests.support.agent.fakes import Bench
from tests.support.agent.served import Served, wait_until
from tests.support.agent.tcp_agent import _received, tcp
from tests.support.agent.tcp_link import TcpLink
from tests.support.patience import seconds

CREATE_CLIENT = bytes.fromhex(captured.CREATE_CLIENT)
STATUS_AGENT = bytes.fromhex("81000000 04010b00 0000 58524345 0100 010f 00".replace(" ", ""))


@pytest.mark.parametrize("protocol", [TCP4, TCP6], ids=lambda p: p.name)
def test_a_client(protocol: Protocol) -> None:
    bench = Bench()
    transport = tcp(bench, protocol)
    with Served(transport, bench=bench) as served:
        client = XrceClient(TcpLink(protocol.loopback, transport.port))  # type: ignore[arg-type]
        served.publish(client, range(200))
        assert client.leave() == 0
        assert served.ready == [transport.label]
    assert not bench.log.counters, bench.text.getvalue()


def test_segments_have_nothing_to_do_with_messages() -> None:
    """Prefix and body apart, byte by byte, and several messages in one segment."""
    bench = Bench()
    transport = tcp(bench)
    frame = len(CREATE_CLIENT).to_bytes(2, "little") + CREATE_CLIENT
    with Served(transport, bench=bench):
        link = TcpLink("127.0.0.1", transport.port)
        link.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        for cut in ([1], [2], [3], list(range(1, len(frame))), []):
            places = [0, *cut, len(frame)]
            for start, end in itertools.pairwise(places):
                link.socket.sendall(frame[start:end])
                time.sleep(0.002)
            assert link.recv(0) == STATUS_AGENT
        link.socket.sendall(frame * 5 + frame[:7])
        assert [link.recv(0) for _ in range(5)] == [STATUS_AGENT] * 5
        link.socket.sendall(frame[7:])
        assert link.recv(0) == STATUS_AGENT
    assert not bench.log.counters, bench.text.getvalue()


@given(st.lists(st.binary(max_size=300), max_size=12), st.data())
def test_messages_survive_any_cut(messages: list[bytes], data: st.DataObject) -> None:
    stream = b"".join(len(m).to_bytes(2, "little") + m for m in messages)
    decoder, messages_read, at = LengthDecoder(), [], 0
    while at < len(stream):
        size = data.draw(st.integers(1, 40))
        messages_read += decoder.feed(stream[at : at + size])
        at += size
    assert messages_read == messages
    assert not decoder.unfinished


@pytest.mark.system
def test_many_clients_at_once() -> None:
    bench = Bench()
    transport = tcp(bench)
    with Served(transport, bench=bench) as served:
        links = [TcpLink("127.0.0.1", transport.port) for _ in range(20)]
        clients = [XrceClient(link, key=0x100 + n) for n, link in enumerate(links)]  # type: ignore[arg-type]
        for client in clients:
            served.publish(client, range(5))
        assert len(bench.agent.clients) == len(transport) == 20
        for link in links:
            link.close()
        wait_until(lambda: len(transport) == 0, "connections stay")
    assert not bench.log.counters, bench.text.getvalue()


def test_a_client_goes_on_over_another_connection() -> None:
    bench = Bench()
    transport = tcp(bench)
    with Served(transport, bench=bench) as served:
        for _ in range(3):
            link = TcpLink("127.0.0.1", transport.port)
            served.publish(XrceClient(link), range(10))  # type: ignore[arg-type]
            link.close()
        assert len(bench.agent.clients) == 1


def test_the_same_port_of_udp_and_of_both_versions() -> None:
    """Addresses of different transports differ, also where the peers' ports are the same."""
    bench = Bench()
    first = Udp(UDP4, "127.0.0.1", 0)
    others = [
        Tcp(p, p.loopback, first.port, bench.log) if p.stream else Udp(p, p.loopback, first.port)
        for p in PROTOCOLS.values()
        if p is not UDP4
    ]
    with Served(first, *others, bench=bench) as served:
        peer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        peer.bind(("127.0.0.1", 0))
        source = peer.getsockname()
        stream = socket.create_connection(("127.0.0.1", first.port), source_address=source)
        link = TcpLink.__new__(TcpLink)
        link.socket, link._bytes = stream, b""
        peer.connect(("127.0.0.1", first.port))
        served.publish(XrceClient(link, key=1), range(5))  # type: ignore[arg-type]
        served.publish(XrceClient(peer, key=2), range(5))  # type: ignore[arg-type]
        assert len(bench.agent.clients) == 2
        assert len(served.ready) == 4


@pytest.mark.system
def test_a_slow_reader_delays_no_other() -> None:
    """What it does not take is bounded and counted; others go on meanwhile; messages that arrive are whole."""
    bench = Bench()
    transport = tcp(bench, output_bytes=20_000)
    with Served(transport, bench=bench) as served:
        slow = TcpLink("127.0.0.1", transport.port)
        slow.send(CREATE_CLIENT)
        ping = bytes.fromhex("8100000002010800000afffd02000000")
        slow.socket.settimeout(seconds(20))
        batch = (len(ping).to_bytes(2, "little") + ping) * 500

        def too_much() -> bool:
            slow.socket.sendall(batch)
            return served.count("tcp_output_full") > 0

        wait_until(too_much, "nothing was too much", 30)
        other = XrceClient(TcpLink("127.0.0.1", transport.port), key=9, timeout_s=15)  # type: ignore[arg-type]
        served.publish(other, range(50))


def test_output_is_bounded_and_whole() -> None:
    bench = Bench()
    transport = tcp(bench, output_bytes=50_000, patience_s=2.0)
    link = TcpLink("127.0.0.1", transport.port)
    link.send(b"\x01")
    (connection,) = _received(transport)
    message = bytes(range(250)) * 4
    for number in range(1000):
        transport.send(number.to_bytes(4, "big") + message, connection)
    assert bench.log.counters["tcp_output_full"] > 300
    link.settimeout(0.5)
    numbers = []
    while True:
        transport.pump(lambda *_: None)
        try:
            frame = link.recv(0)
        except TimeoutError:
            break
        assert frame[4:] == message
        numbers.append(int.from_bytes(frame[:4], "big"))
    assert numbers == sorted(set(numbers))
    assert len(numbers) == 1000 - bench.log.counters["tcp_output_full"]
    transport.close()


def test_who_takes_nothing_is_closed() -> None:
    bench = Bench()
    transport = tcp(bench, patience_s=2.0)
    link = TcpLink("127.0.0.1", transport.port)
    link.send(b"\x01")
    transport.tick(100.0)
    (connection,) = _received(transport)
    for _ in range(1000):
        transport.send(bytes(1000), connection)
    transport.tick(101.9)
    assert len(transport) == 1
    transport.tick(102.6)
    assert len(transport) == 0
    assert connection.closed
    assert bench.log.counters["tcp_stuck"] == 1
    transport.send(b"x", connection)
    transport.close()


@pytest.mark.parametrize(
    ("sent", "kind"),
    [(b"", "tcp_silent"), (b"\x05", "tcp_silent"), (b"\x01\x00\x07\x05\x00ab", "tcp_unfinished")],
)
def test_who_owes_a_message_is_closed(sent: bytes, kind: str) -> None:
    bench = Bench()
    transport = tcp(bench, patience_s=2.0)
    transport.tick(100.0)
    link = TcpLink("127.0.0.1", transport.port)
    link.socket.sendall(sent)
    wait_until(lambda: _pumped(transport) == 1, "not accepted")
    time.sleep(0.02)
    transport.pump(lambda *_: None)
    transport.tick(101.9)
    assert len(transport) == 1
    transport.tick(102.6)
    assert len(transport) == 0
    assert bench.log.counters == {kind: 1}
    link.socket.settimeout(1)
    assert link.socket.recv(1) == b""
    transport.close()


def _pumped(transport: Tcp) -> int:
    transport.pump(lambda *_: None)
    return len(transport)


def test_who_said_something_may_be_silent_for_long() -> None:
    """Clients sleep; the agent's own time-outs are for them."""
    bench = Bench()
    transport = tcp(bench, patience_s=2.0)
    transport.tick(100.0)
    TcpLink("127.0.0.1", transport.port).send(b"\x01")
    link = TcpLink("127.0.0.1", transport.port)
    link.send(b"\x01")
    assert len(_received(transport)) > 0
    wait_until(lambda: _pumped(transport) >= 1, "lost")
    transport.tick(10_000.0)
    link.send(b"\x02")
    assert _received(transport)
    transport.close()


def test_a_flood_of_connections() -> None:
    """Silent ones make room; those that spoke keep theirs; who finds none is refused."""
    bench = Bench()
    transport = tcp(bench, connections=8, patience_s=60.0)
    with Served(transport, bench=bench) as served:
        client = XrceClient(TcpLink("127.0.0.1", transport.port))  # type: ignore[arg-type]
        served.publish(client, range(5))
        flood = [socket.create_connection(("127.0.0.1", transport.port)) for _ in range(100)]
        wait_until(lambda: served.count("tcp_displaced") >= 90, bench.text.getvalue())
        assert len(transport) <= 8
        assert client.ping() == 1
        spoken = [TcpLink("127.0.0.1", transport.port) for _ in range(7)]
        for link in spoken:
            link.send(CREATE_CLIENT)
            assert link.recv(0) == STATUS_AGENT
        late = TcpLink("127.0.0.1", transport.port)
        with pytest.raises(ConnectionError):
            late.recv(0)
        assert served.count("tcp_refused") >= 1
        for each in flood:
            each.close()


def from_host(host: str, transport: Tcp) -> socket.socket:
    """Return a connection from an address of this machine."""
    return socket.create_connection(
        ("127.0.0.1", transport.port), timeout=seconds(10), source_address=(host, 0)
    )


def test_half_open_connections_delay_no_other() -> None:
    """S7: 500 that say nothing or nonsense, opened again when they are closed; a new client is served at once."""
    bench = Bench()
    transport = tcp(bench, connections=64, connections_per_host=32)
    with Served(transport, bench=bench) as served:
        before = XrceClient(TcpLink("127.0.0.1", transport.port))  # type: ignore[arg-type]
        served.publish(before, range(3))
        flood = [from_host("127.0.0.2", transport) for _ in range(500)]
        for each in flood[::2]:
            with contextlib.suppress(OSError):
                each.sendall(b"\x04\x00\x81\x80\x00\x00")
        began = time.monotonic()
        for number in range(5):
            client = XrceClient(TcpLink("127.0.0.1", transport.port), key=10 + number)  # type: ignore[arg-type]
            served.publish(client, range(3))
        assert time.monotonic() - began < 5.0
        assert len(transport) <= 32 + 6
        assert before.ping() == 1
        for each in flood:
            each.close()


def test_a_host_at_its_limit_displaces_its_own_clients() -> None:
    bench = Bench()
    transport = tcp(bench, connections=8, connections_per_host=4)
    with Served(transport, bench=bench) as served:
        links = [TcpLink("127.0.0.1", transport.port) for _ in range(4)]
        for link in links:
            link.send(CREATE_CLIENT)
            assert link.recv(0) == STATUS_AGENT
        refused = TcpLink("127.0.0.1", transport.port)
        with pytest.raises(ConnectionError):
            refused.recv(0)
        assert served.count("tcp_refused") == 1
        with from_host("127.0.0.2", transport):
            wait_until(lambda: len(transport) == 5, "another host has its own")


@pytest.mark.parametrize(
    ("first", "second", "same"),
    [
        ("127.0.0.1", "127.0.0.2", False),
        ("10.0.0.1", "10.0.0.1", True),
        ("fd00::1", "fd00::2", True),
        ("fd00::1", "fd00:0:0:1::1", False),
        ("fe80::1%eth0", "fe80::2%eth0", True),
    ],
)
def test_what_a_host_is(first: str, second: str, same: bool) -> None:
    assert (host_of(first) == host_of(second)) == same


def test_no_descriptors_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """The loop does not spin on a connection that cannot be taken, and takes it when it can."""
    bench = Bench()
    transport = tcp(bench)
    listener = transport._listener

    class Exhausted:
        def accept(self) -> None:
            raise OSError(errno.EMFILE, "Too many open files")

        def fileno(self) -> int:
            return listener.fileno()

    link = TcpLink("127.0.0.1", transport.port)
    transport._listener = Exhausted()  # type: ignore[assignment]
    transport.pump(lambda *_: None)
    assert bench.log.counters == {"tcp_refused": 1}
    assert transport._epoll.poll(0) == []
    transport._listener = listener
    transport.tick(1.0)
    link.send(b"\x01")
    assert _received(transport)
    transport.close()


def test_resets_and_empty_messages() -> None:
    bench = Bench()
    transport = tcp(bench)
    with Served(transport, bench=bench) as served:
        link = TcpLink("127.0.0.1", transport.port)
        link.socket.sendall(b"\x00\x00")
        wait_until(lambda: served.count("frame_empty") == 1, "not counted")
        link.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        link.close()
        wait_until(lambda: len(transport) == 0, "the connection stays")
        served.publish(XrceClient(TcpLink("127.0.0.1", transport.port)), range(5))  # type: ignore[arg-type]


def test_noise_on_many_connections() -> None:
    drown(chunks=300, seed=5)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(5))
def test_noise_on_many_connections_at_length(seed: int) -> None:
    drown(chunks=20_000, seed=seed)


def drown(chunks: int, seed: int) -> None:
    """Random bytes, lying lengths and hang-ups: nothing raises, and the next client is served."""
    chance = random.Random(seed)
    bench = Bench()
    transport = tcp(bench, connections=16)
    with Served(transport, bench=bench) as served:
        links: list[TcpLink] = []
        for _ in range(chunks):
            if len(links) < 10 or chance.random() < 0.1:
                links.append(TcpLink("127.0.0.1", transport.port))
            link = chance.choice(links)
            size = chance.choice((0, 1, 40, 300, 5000))
            announced = chance.choice((size, chance.randrange(65536)))
            try:
                link.socket.sendall(announced.to_bytes(2, "little") + chance.randbytes(size))
            except OSError:
                links.remove(link)
            if chance.random() < 0.05 and link in links:
                link.close()
                links.remove(link)
        for link in links:
            link.close()
        served.publish(XrceClient(TcpLink("127.0.0.1", transport.port), key=0x77), range(10))  # type: ignore[arg-type]
    assert not [kind for kind in bench.log.counters if kind.startswith("internal_")], bench.text.getvalue()


@pytest.mark.parametrize(
    ("protocol", "host", "wanted"),
    [
        (TCP4, "192.0.2.77", "'192.0.2.77' is not an IPv4 address of this machine. --bind takes one"),
        (
            TCP6,
            "2001:db8::1",
            "is not an IPv6 address of this machine. --bind takes one of them, or :: for all",
        ),
        (TCP6, "no.such.host.invalid", "is not an IPv6 address"),
    ],
)
def test_what_cannot_be_bound(protocol: Protocol, host: str, wanted: str) -> None:
    with pytest.raises(UserError) as error:
        Tcp(protocol, host, 0, Bench().log)
    assert wanted in str(error.value)


def test_a_port_in_use() -> None:
    first = tcp(Bench())
    with pytest.raises(UserError, match=f"TCP port {first.port} is in use; choose another with --port"):
        Tcp(TCP4, "127.0.0.1", first.port, Bench().log)
    first.close()
