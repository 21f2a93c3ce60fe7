# SPDX-License-Identifier: Apache-2.0
"""The agent's sealed transport around one that is a list, and the file of keys."""

from __future__ import annotations

import io
from collections.abc import Hashable
from pathlib import Path

import pytest
from noise.connection import NoiseConnection

from microros_gen.agent.configuration.model import (
    CanChoice,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog
from microros_gen.agent.seal.keys import read_keys
from microros_gen.agent.seal.layout import FIRST, LABEL, RECORD, Kind
from microros_gen.agent.seal.noise import NAME
from microros_gen.agent.transport.base import Receive, SealedAddress, Transport
from microros_gen.agent.transport.observed import ObservedTransport
from microros_gen.agent.transport.outbox import SealedRecord
from microros_gen.agent.transport.sealed import SealedTransport
from microros_gen.agent.transport.sockets import UDP4
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.wire.constants import Status
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.seal import read_psk_file
from microros_gen.diagnostics import Diagnostics

KEY, PSK = 0xA1B2C3D4, bytes(range(32))
CREATE_CLIENT = b"\x80\x00\x00\x00\x00\x01\x10\x00XRCE\x01\x00\x01\x0f%s\x81\x00\x00\x02"
PEER = ("192.0.2.1", 4000)
SAMPLE = b"\x81\x01\x00\x00\x09\x01\x04\x00" + bytes(4)
"""A best-effort sample of the agent."""


class Datagrams(ObservedTransport):
    """UDP whose datagrams the test delivers and takes."""

    def __init__(self) -> None:
        super().__init__(Udp(UDP4, "127.0.0.1", 0))
        self.arriving: list[bytes] = []
        self.sent: list[tuple[bytes, Hashable]] = []

    def pump(self, receive: Receive) -> None:
        while self.arriving:
            receive(self.arriving.pop(0), (self, PEER), self)

    def send(self, data: bytes, address: Hashable) -> None:
        self._observe(data, address, inbound=False)

    def _observe(self, data: bytes, address: Hashable, inbound: bool) -> None:
        self.sent.append((data, address))


class Link:
    """A client that an independent implementation of Noise plays, and the agent's end."""

    def __init__(self) -> None:
        self.inner = Datagrams()
        self.log = EventLog(io.StringIO())
        self.sealed = SealedTransport(self.inner, {KEY: PSK}, self.log, clock=lambda: 0.0)
        self.received: list[tuple[bytes, Hashable]] = []
        self.noise = NoiseConnection.from_name(NAME)
        self.index = 0
        self.count = 0

    def deliver(self, data: bytes) -> list[bytes]:
        """Return what the agent answers."""

        def receive(message: bytes, address: Hashable, transport: Transport) -> None:
            assert transport is self.sealed
            self.received.append((message, address))

        self.inner.arriving.append(data)
        self.inner.sent.clear()
        self.sealed.pump(receive)
        return [answer for answer, _ in self.inner.sent]

    def connect(self) -> None:
        head = FIRST.pack(Kind.FIRST, 1, 0, 5, KEY)
        self.noise.set_psks(PSK)
        self.noise.set_prologue(LABEL + head)
        self.noise.set_as_initiator()
        self.noise.start_handshake()
        (second,) = self.deliver(head + bytes(self.noise.write_message()))
        self.index = FIRST.unpack_from(second)[3]
        self.noise.read_message(second[FIRST.size :])

    def record(self, message: bytes) -> bytes:
        self.count += 1
        head = RECORD.pack(Kind.RECORD, 1, 0, self.index, self.count - 1)
        return head + bytes(self.noise.encrypt(message))


@pytest.fixture
def link() -> Link:
    return Link()


def test_messages_have_the_address_and_the_client_key(link: Link) -> None:
    link.connect()
    assert link.deliver(link.record(b"\x81\x00\x00\x00")) == []
    address = SealedAddress((link.inner, PEER), KEY)
    assert link.received == [(b"\x81\x00\x00\x00", address)]
    link.sealed.send(b"answer", address)
    ((record, to),) = link.inner.sent
    assert to == (link.inner, PEER)
    assert isinstance(record, SealedRecord)
    assert not record.is_sample
    assert link.noise.decrypt(record[RECORD.size :]) == b"answer"
    link.sealed.send(SAMPLE, address)
    sample = link.inner.sent[-1][0]
    assert isinstance(sample, SealedRecord)
    assert sample.is_sample, "a full queue drops the oldest of these"
    assert link.sealed.name_of(address) == "192.0.2.1:4000"
    assert str(link.sealed.origin(address)) == "192.0.2.1"
    assert not link.sealed.forgeable


def test_plain_client_is_denied_and_counted(link: Link) -> None:
    (answer,) = link.deliver(CREATE_CLIENT % KEY.to_bytes(4, "big"))
    assert answer[8] == Status.DENIED
    assert len(answer) <= len(CREATE_CLIENT)
    assert link.deliver(b"\x81\x01\x00\x00" + bytes(20)) == []
    assert link.deliver(b"") == []
    assert link.received == []
    assert link.log.counters["seal_missing"] == 3


def test_an_address_proves_a_client_key(link: Link) -> None:
    """Of a message without a key in its header the agent adopts entities for no other client."""
    link.connect()
    link.deliver(link.record(b"\x81\x00\x00\x00"))
    ((_, address),) = link.received
    assert link.sealed.proved_key(address) == KEY.to_bytes(4, "big")


def test_refused_datagrams_are_charged_to_strangers() -> None:
    strangers, times = Account(), iter(range(100))
    inner = Datagrams()
    sealed = SealedTransport(
        inner, {KEY: PSK}, EventLog(io.StringIO()), clock=lambda: float(next(times)), strangers=strangers
    )
    inner.arriving.append(bytes(40))
    sealed.pump(lambda *_: None)
    assert strangers.used > 0


def test_client_key_of_another_is_denied(link: Link) -> None:
    link.connect()
    (record,) = link.deliver(link.record(CREATE_CLIENT % b"\x00\x00\x00\x01"))
    assert link.noise.decrypt(record[RECORD.size :])[8] == Status.DENIED
    link.deliver(link.record(b"\x01\x00\x00\x00\x00\x00\x00\x01" + bytes(8)))
    assert link.received == []
    assert link.log.counters["seal_other_client"] == 2
    link.deliver(link.record(CREATE_CLIENT % KEY.to_bytes(4, "big")))
    assert len(link.received) == 1


@pytest.mark.parametrize("kind", [0, 1, 2, 3, 4, 5, 0x80, 0x81, 0xFF])
def test_short_datagrams_are_counted(link: Link, kind: int) -> None:
    for size in range(1, 70):
        link.deliver(bytes([kind, 1, 0, 0]).ljust(size, b"\0")[:size])
    assert link.received == []
    assert sum(link.log.counters.values()) == 69


def found(tmp_path: Path, text: bytes, mode: int = 0o600) -> tuple[dict[int, bytes], list[str]]:
    file = tmp_path / "keys"
    file.write_bytes(text)
    file.chmod(mode)
    diagnostics = Diagnostics()
    keys = read_keys(file, diagnostics)
    assert all(PSK.hex()[:8] not in d.render() and PSK.hex(":")[:8] not in d.render() for d in diagnostics)
    return dict(keys), [d.id or "" for d in diagnostics]


def test_file_of_keys(tmp_path: Path) -> None:
    line = f"0xA1B2C3D4 {PSK.hex()}"
    assert found(tmp_path, f"# keys\n\n{line} # arm\n7 {PSK.hex().upper()}\n".encode()) == (
        {KEY: PSK, 7: PSK},
        [],
    )
    assert found(tmp_path, line.encode(), 0o640)[1] == ["MG-3265"]
    assert found(tmp_path, f"{line}\n{line}\n".encode())[1] == ["MG-3267"]
    for wrong in (line[:-2], line + "0", f"0 {PSK.hex()}", f"4294967296 {PSK.hex()}", PSK.hex()):
        assert found(tmp_path, wrong.encode())[1] == ["MG-3266"]
    for wrong in (f"7 {PSK.hex(':')}", f"0xA1B2C3D4 {PSK.hex(' ', 2)}", PSK.hex(":")):
        assert found(tmp_path, wrong.encode())[1] == ["MG-3266"]
    assert found(tmp_path, b"\xef\xbb\xbf" + line.encode())[0] == {KEY: PSK}
    assert found(tmp_path, b"# none")[1] == ["MG-3272"]
    assert found(tmp_path, b"1 " + b"00" * 32)[1] == ["MG-3268"]
    assert found(tmp_path, b"\xff\xfe")[1] == ["MG-3274"]
    diagnostics = Diagnostics()
    assert read_keys(tmp_path, diagnostics) == {}
    assert read_keys(tmp_path / "absent", diagnostics) == {}
    assert [d.id for d in diagnostics] == ["MG-3264", "MG-3274"]


def options(file: Path, choice: TransportChoice, discovery: int | None = None) -> AgentOptions:
    return AgentOptions(transports=(choice,), discovery=discovery, psk_file=file)


def test_transports_that_are_sealed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "keys"
    file.write_text(f"1 {PSK.hex()}")
    file.chmod(0o600)
    diagnostics = Diagnostics()
    for choice in (SocketChoice("udp6"), SocketChoice("tcp4"), SerialChoice("/dev/ttyUSB0"), PtyChoice()):
        assert read_psk_file(options(file, choice), diagnostics) == {1: PSK}
    assert list(diagnostics) == []
    read_psk_file(options(file, CanChoice("can0")), diagnostics)
    read_psk_file(options(file, SocketChoice("udp4"), discovery=7400), diagnostics)
    assert [d.id for d in diagnostics] == ["MG-3269", "MG-3273"]
    monkeypatch.setattr("microros_gen.cli.agent.seal.find_spec", lambda _name: None)
    missing = Diagnostics()
    read_psk_file(options(file, SocketChoice("udp4")), missing)
    assert [(d.id, d.hint) for d in missing] == [("MG-3271", "pip install 'microros-gen[seal]'")]
