# SPDX-License-Identifier: Apache-2.0
"""The agent's seal over real TCP connections and lines, and the file of keys while the agent runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import pytest

from microros_gen.agent.configuration.model import SocketChoice
from microros_gen.agent.fairness import Account
from microros_gen.agent.seal.handshakes import Handshakes
from microros_gen.agent.seal.session import RecordError
from microros_gen.agent.transport.outbox import Outbox, SealedRecord, is_sample
from microros_gen.agent.transport.sealed import SealedTransport
from microros_gen.agent.transport.serial import Pty
from microros_gen.agent.wire.constants import Status
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.seal import PskFile, Seals
from tests.support.agent.client import XrceClient
from tests.support.agent.fakes import Bench
from tests.support.agent.sealed_link import SealedLink, Within
from tests.support.agent.serial_link import SerialLink
from tests.support.agent.served import Served, wait_until
from tests.support.agent.tcp_agent import tcp
from tests.support.agent.tcp_link import TcpLink

KEY, PSK, PEER = 0x0A0B0C0D, bytes(range(32)), "peer"
OTHER = bytes(range(1, 33))


def client(link: Within, key: int, psk: bytes) -> XrceClient:
    return XrceClient(SealedLink(link, key, psk), key)  # type: ignore[arg-type]


class Sealed:
    """An agent with the key of one client, after a real transport; `link` opens a new connection to it."""

    def __init__(self, kind: str, stack: ExitStack) -> None:
        self.bench = Bench()
        if kind == "tcp":
            listener = tcp(self.bench)
            self.transport = SealedTransport(listener, {KEY: PSK}, self.bench.log)
            self.link: Callable[[], Within] = lambda: TcpLink("127.0.0.1", listener.port)
        else:
            line = Pty(self.bench.log)
            self.transport = SealedTransport(line, {KEY: PSK}, self.bench.log)
            self.link = lambda: SerialLink(line.label.removeprefix("serial "))
        self.served = stack.enter_context(Served(self.transport, bench=self.bench))


@pytest.fixture(params=["tcp", "line"])
def sealed(request: pytest.FixtureRequest) -> Iterator[Sealed]:
    with ExitStack() as stack:
        yield Sealed(request.param, stack)


def test_a_client_and_its_restart(sealed: Sealed) -> None:
    """The client that restarts has another session, whose records alone are accepted."""
    first = client(sealed.link(), KEY, PSK)
    sealed.served.publish(first, range(50))
    first.socket.close()
    again = client(sealed.link(), KEY, PSK)
    sealed.served.publish(again, range(50, 100))
    assert again.leave() == 0
    assert not sealed.bench.log.counters, sealed.bench.text.getvalue()


@pytest.mark.parametrize("known", [True, False], ids=["known", "unknown"])
def test_a_refused_handshake_keeps_no_connection(known: bool) -> None:
    """Whoever was only refused makes room for others, as whoever was never answered does."""
    bench = Bench()
    listener = tcp(bench, connections=1, patience_s=60.0)
    with Served(SealedTransport(listener, {KEY: PSK}, bench.log), bench=bench) as served:
        first = TcpLink("127.0.0.1", listener.port)
        if known:
            SealedLink(first, KEY, PSK)
        else:
            with pytest.raises(AssertionError, match="refused the handshake"):
                SealedLink(first, KEY + 1, PSK)
        TcpLink("127.0.0.1", listener.port)
        kind = "tcp_refused" if known else "tcp_displaced"
        wait_until(lambda: served.count(kind) == 1, bench.text.getvalue())


def test_repeated_records_are_refused(sealed: Sealed) -> None:
    link = SealedLink(sealed.link(), KEY, PSK)
    record = link.record(b"\x81\x00\x00\x00")
    for _ in range(3):
        link.within.send(record)
    wait_until(lambda: sealed.served.count("seal_replayed") == 2, "both copies are counted")
    forged = bytearray(link.record(b"\x81\x00\x00\x00"))
    forged[-1] ^= 1
    link.within.send(bytes(forged))
    wait_until(lambda: sealed.served.count("seal_forged") == 1, "the forged record is counted")


def test_plain_client_is_denied(sealed: Sealed) -> None:
    plain = XrceClient(sealed.link(), KEY)  # type: ignore[arg-type]
    assert plain.connect() == Status.DENIED
    wait_until(lambda: sealed.served.count("seal_missing") >= 1, "it is counted, after the answer")


def test_record_of_another_connection_is_refused() -> None:
    """A session belongs to the connection of its handshake."""
    with ExitStack() as stack:
        sealed = Sealed("tcp", stack)
        link = SealedLink(sealed.link(), KEY, PSK)
        other = sealed.link()
        other.send(link.record(b"\x81\x00\x00\x00"))
        wait_until(lambda: sealed.served.count("seal_no_session") == 1, "the record is counted")
        other.close()


def test_a_full_queue_replaces_samples_and_no_other_record() -> None:
    """What a record has decides, and not how its counter looks."""
    data = b"\x81\x01\x00\x00\x09\x01\x04\x00"
    sample, answer = (
        SealedRecord(b"\x03" + bytes(20)),
        SealedRecord(b"\x03\x01\x00\x00" + bytes(4) + b"\x09" + bytes(20)),
    )
    sample.is_sample = is_sample(data)
    assert (is_sample(sample), is_sample(answer), is_sample(bytes(answer))) == (True, False, True)
    dropped: list[int] = []
    outbox = Outbox(8 * len(sample), lambda: dropped.append(1))
    assert all(outbox.put(bytes(sample), is_sample(sample)) for _ in range(3))
    assert len(dropped) == 2


def keys_file(tmp_path: Path, text: str) -> Path:
    file = tmp_path / "keys"
    file.write_text(text)
    file.chmod(0o600)
    return file


def test_file_is_read_again(tmp_path: Path) -> None:
    """Sessions of keys that stay go on; those of removed and changed keys end, told while it can be sealed."""
    file = keys_file(tmp_path, f"{KEY} {PSK.hex()}\n5 {OTHER.hex()}\n")
    bench = Bench()
    psk_file = PskFile(AgentOptions((SocketChoice("tcp4"),), psk_file=file), {KEY: PSK, 5: OTHER}, bench.log)
    listener = tcp(bench)
    seals = Seals({KEY: PSK, 5: OTHER}, bench.log)
    (transport,) = seals.sealed([listener], Account())
    reload = psk_file.reloading(partial(seals.use, bench.agent))
    assert reload is not None
    with Served(transport, bench=bench) as served:
        stays = client(TcpLink("127.0.0.1", listener.port), KEY, PSK)
        ends = client(TcpLink("127.0.0.1", listener.port), 5, OTHER)
        served.publish(stays, range(5))
        served.publish(ends, range(5, 10))
        file.write_text(f"{KEY} {PSK.hex()}\n5 {OTHER.hex()[:-1]}\n")
        served.server.soon(reload)
        wait_until(lambda: "stay in force" in bench.text.getvalue(), "the damaged file is reported")
        assert (
            f"{file}:2:1: error: no client key with a key of 32 bytes. Write 0xA1B2C3D4 and"
            in bench.text.getvalue()
        )
        assert OTHER.hex()[:8] not in bench.text.getvalue()
        assert len(bench.agent.clients) == 2
        file.write_text(f"{KEY} {PSK.hex()}\n5 {PSK.hex()}\n7 {OTHER.hex()}\n")
        served.server.soon(reload)
        wait_until(lambda: "keys of 3 clients" in bench.text.getvalue(), "the new file is reported")
        assert [client.session.link.key for client in bench.agent.clients] == [KEY.to_bytes(4, "big")]
        assert "its key was removed or changed" in bench.text.getvalue()
        before = len(bench.bridge.published)
        served.publish(stays, range(20, 25))
        assert len(bench.bridge.published) > before
        link = SealedLink(TcpLink("127.0.0.1", listener.port), 7, OTHER)
        link.close()
        file.chmod(0o644)
        served.server.soon(reload)
        wait_until(lambda: f"chmod 600 {file}" in bench.text.getvalue(), "the open file is reported")


class Direct:
    """A link to the handshakes of an agent in this process."""

    def __init__(self, agent: Handshakes) -> None:
        self._agent = agent
        self._answer = b""

    def settimeout(self, seconds: float) -> None:
        """Nothing is waited for."""

    def send(self, payload: bytes) -> None:
        self._answer, fault = self._agent.answer(payload, PEER, 0.0)
        assert fault == ""

    def recv(self, size: int) -> bytes:
        return self._answer

    def close(self) -> None:
        """Nothing is open."""


def handshake(agent: Handshakes, key: int, psk: bytes) -> SealedLink:
    return SealedLink(Direct(agent), key, psk)


def test_sessions_of_keys_that_are_gone_are_forgotten() -> None:
    """Open ones and those without a record yet; those of a key that stays go on, and a new key counts at once."""
    agent = Handshakes({KEY: PSK, 5: PSK, 6: PSK})
    stays, changes, leaves = (handshake(agent, key, PSK) for key in (KEY, 5, 6))
    for link in (stays, changes, leaves):
        assert agent.open(link.record(b"hello"), PEER)[0] == b"hello"
    for key in (KEY, 5, 6):
        handshake(agent, key, PSK)
    agent.use({KEY: PSK, 5: OTHER})
    assert agent.open(stays.record(b"again"), PEER)[0] == b"again"
    for link, key in ((changes, 5), (leaves, 6)):
        assert agent.seal(b"answer", key, PEER) is None
        with pytest.raises(RecordError, match="seal_no_session"):
            agent.open(link.record(b"again"), PEER)
    renewed = handshake(agent, 5, OTHER)
    assert agent.open(renewed.record(b"hello"), PEER)[0] == b"hello"
    agent.use({})
    assert (agent._by_index, agent._answers, agent._current, agent._unconfirmed) == ({}, {}, {}, {})
