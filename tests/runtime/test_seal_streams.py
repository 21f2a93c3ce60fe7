# SPDX-License-Identifier: Apache-2.0
"""Sealed messages on a stream of bytes: parts of records, a full line, a connection that ends, lost frames."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.agent.seal.handshakes import Handshakes
from microros_gen.agent.seal.layout import Kind
from tests.support.runtime.sealed import CLIENT_KEY, Device, build_device

pytestmark = [pytest.mark.builds, pytest.mark.variant]
PSK = bytes(range(1, 33))
PEER = ("agent", "line")
LARGEST_SENT = 64
"""Bytes of MTU and record in the plan of `build_device`, at least."""


@pytest.fixture(scope="module", params=["tcp", "serial"])
def library(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> tuple[Path, str]:
    transport: str = request.param
    return build_device(tmp_path_factory.mktemp(f"seal_{transport}"), transport), transport


@pytest.fixture
def device(library: tuple[Path, str]) -> Device:
    return Device(library[0], PSK, library[1])


def connect(device: Device, agent: Handshakes) -> None:
    """Bring a device into a session with an agent."""
    assert device.open()
    assert device.send(b"waiting")
    (first,) = device.sent()
    answer, fault = agent.answer(first, PEER, 0.0)
    assert (fault, device.arrives(answer), device.is_ready) == ("", 0, 1)
    (waiting,) = device.sent()
    assert agent.open(waiting, PEER)[0] == b"waiting"


@pytest.fixture
def agent(device: Device) -> Handshakes:
    """An agent that the device has a session with."""
    found = Handshakes({CLIENT_KEY: PSK})
    connect(device, found)
    return found


def from_agent(agent: Handshakes, message: bytes) -> bytes:
    record = agent.seal(message, CLIENT_KEY, PEER)
    assert record is not None
    return record


def test_records_in_parts_while_others_are_sent(device: Device, agent: Handshakes) -> None:
    """What is sent between two parts of a record does not touch it."""
    for at in range(1, 40):
        whole = device.on_the_wire(from_agent(agent, b"down %d" % at))
        device.deliver(whole[:at])
        assert device.receives() == 0
        assert device.send(b"up %d" % at)
        assert agent.open(device.sent()[0], PEER)[0] == b"up %d" % at
        device.deliver(whole[at:])
        assert device.receives() == b"down %d" % at


def test_two_records_at_once(device: Device, agent: Handshakes) -> None:
    device.deliver(b"".join(device.on_the_wire(from_agent(agent, text)) for text in (b"one", b"two")))
    assert [device.receives(), device.receives(), device.receives()] == [b"one", b"two", 0]


def test_full_stream_refuses_and_the_session_goes_on(device: Device, agent: Handshakes) -> None:
    device.set_room(0)
    accepted = [device.send(b"%d" % i) for i in range(3)]
    assert accepted[1:] == [False, False]  # TCP keeps the first one
    device.set_room(1 << 20)
    device.receives()
    assert device.send(b"last")
    messages = [agent.open(record, PEER)[0] for record in device.sent()]
    assert messages == [b"0", b"last"] if accepted[0] else [b"last"]


def test_first_message_waits_for_room(device: Device) -> None:
    """A connection that is being established, or a line that still sends, takes it later."""
    agent = Handshakes({CLIENT_KEY: PSK})
    device.set_room(0)
    assert device.open()
    assert device.send(b"waiting")
    assert device.sent() == []
    device.set_room(1 << 20)
    for ms in range(0, 2_000, 20):
        device.clock(ms)
        device.receives()
        device.send(b"waiting")
        for message in device.sent():
            if message[0] == Kind.FIRST:
                device.arrives(agent.answer(message, PEER, 0.0)[0])
        if device.is_ready:
            return
    pytest.fail("no session within 2 s")


def test_largest_message_of_each_direction(device: Device, agent: Handshakes) -> None:
    """All bytes may be stuffed on a line; the plan has room for that."""
    for size in (64, 60, 28):
        message = bytes(range(size))
        assert device.arrives(from_agent(agent, message)) == message
    for size in range(LARGEST_SENT + 1):
        assert device.send(b"~" * size)
        assert agent.open(device.sent()[0], PEER)[0] == b"~" * size


def test_record_larger_than_the_buffer_is_skipped(device: Device, agent: Handshakes) -> None:
    assert device.arrives(from_agent(agent, bytes(1000))) == -1
    for _ in range(4):  # the rest of a frame
        device.receives()
    assert device.arrives(from_agent(agent, b"next")) == b"next"


@pytest.mark.parametrize("library", ["serial"], indirect=True)
def test_damage_on_the_line_costs_its_frame_alone(device: Device, agent: Handshakes) -> None:
    refused = device.refused
    for at in range(1, 40):
        whole = bytearray(device.on_the_wire(from_agent(agent, b"damaged")))
        whole[at % len(whole)] ^= 0x01
        device.deliver(bytes(whole))
        while device.receives() != 0:
            continue
        assert device.arrives(from_agent(agent, b"next")) == b"next"
    assert device.refused == refused, "frames with a wrong checksum are no attack"


@pytest.mark.parametrize("library", ["serial"], indirect=True)
def test_lost_handshake_is_repeated(device: Device) -> None:
    agent, lost = Handshakes({CLIENT_KEY: PSK}), 0
    assert device.open()
    for ms in range(0, 20_000, 20):
        device.clock(ms)
        device.send(b"waiting")
        for message in device.sent():
            lost += 1
            if lost == 3:  # then the answer is lost once
                agent.answer(message, PEER, 0.0)
            elif lost > 4:
                assert device.arrives(agent.answer(message, PEER, 0.0)[0]) == 0
        if device.is_ready:
            return
    pytest.fail("no session within 20 s")


@pytest.mark.parametrize("library", ["tcp"], indirect=True)
def test_connection_that_ends_takes_its_session_with_it(device: Device, agent: Handshakes) -> None:
    old = from_agent(agent, b"old")
    device.hang_up()
    assert device.receives() == 0
    assert not device.send(b"lost")
    connect(device, agent)
    assert device.arrives(old) == -1
    assert device.arrives(from_agent(agent, b"new")) == b"new"
