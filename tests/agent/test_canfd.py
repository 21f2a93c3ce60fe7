# SPDX-License-Identifier: Apache-2.0
"""CAN FD of the agent: frames, a bus that comes and goes, one that is slow, and the kernel's own where it has one."""

from __future__ import annotations

import errno
import io
import socket
import subprocess
import time
from collections.abc import Callable, Hashable, Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.canfd import QUEUE_FRAMES, CanFd, decode, encode
from microros_gen.diagnostics import UserError
from tests.support.e2e.can_bus import EXTENDED, FRAME, record
from tests.support.patience import deadline

LENGTHS = {*range(9), 12, 16, 20, 24, 32, 48, 64}
"""Of the data of a CAN FD frame, bytes (ISO 11898-1)."""
ACKNACK = bytes.fromhex("81000000 0a010500 0100 0000 80")
SAMPLE = bytes.fromhex("81010000 09010800 000a0016")


@given(identifier=st.integers(0, 0x1FFFFFFF), message=st.binary(min_size=1, max_size=63))
def test_a_message_is_a_frame_of_a_length_that_exists(identifier: int, message: bytes) -> None:
    frame = encode(identifier, message)
    flagged, length, flags, data = FRAME.unpack(frame)
    assert (flagged, flags) == (identifier | EXTENDED, 0)
    assert length in LENGTHS
    assert (data[0], data[1 : 1 + len(message)]) == (len(message), message)
    assert not any(data[1 + len(message) :]), "it tells nothing of earlier ones"
    assert decode(frame) == (identifier, message)


def test_frames_of_the_public_client() -> None:
    """It writes the length that it needs and leaves the rest to the driver, which fills the frame up."""
    create = bytes.fromhex("80000000 00011000 58524345 0100010f a1b2c3d4 81003f00")
    for length in (len(create) + 1, 32):
        frame = FRAME.pack(0x7F | EXTENDED, length, 0, bytes((len(create),)) + create)
        assert decode(frame) == (0x7F, create)


@pytest.mark.parametrize(
    "frame",
    [
        record(1, b"\x02ab", flags=0),
        record(1, b"\x02ab", flags=EXTENDED | 0x4000_0000),
        record(1, b"\x02ab", flags=EXTENDED | 0x2000_0000),
        record(1, b"\x03ab"),
        record(1, b"\x00ab"),
        record(1, b"\x40" + bytes(63)),
        record(1, b""),
        record(1, b"\x02ab")[:40],
        record(1, b"\x09" + bytes(9))[:16],
        b"",
    ],
)
def test_other_frames_of_a_bus_are_no_messages(frame: bytes) -> None:
    assert decode(frame) is None


def test_a_classic_frame_may_carry_a_short_message() -> None:
    assert decode(record(1, b"\x07abcdefg")[:16]) == (1, b"abcdefg")


class Taken:
    """What a transport has delivered."""

    def __init__(self) -> None:
        self.messages: list[tuple[bytes, Hashable]] = []

    def __call__(self, message: bytes, address: Hashable, transport: Transport) -> None:
        self.messages.append((message, address))


def pump_until(can: CanFd, taken: Taken, done: Callable[[], bool]) -> None:
    end = deadline(5)
    while not done():
        assert time.monotonic() < end, taken.messages
        can.tick(time.monotonic())
        can.pump(taken)
        time.sleep(0.002)


@pytest.fixture
def log() -> io.StringIO:
    return io.StringIO()


def test_a_bus_that_appears_leaves_and_returns(log: io.StringIO, tmp_path: Path) -> None:
    taken = Taken()
    path = tmp_path / "bus"
    can = CanFd(f"unix:{path}", EventLog(log, False))
    assert not can.ready
    can.send(ACKNACK, (can.label, 1))
    for event in ("is available", "is back"):
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener:
            listener.bind(str(path))
            listener.listen()
            pump_until(can, taken, lambda: can.ready)
            member = listener.accept()[0]
            member.send(encode(7, b"one"))
            member.send(encode(8, b"two"))
            pump_until(can, taken, lambda: len(taken.messages) == 2)
            for message, address in taken.messages:
                can.send(message.upper(), address)
            assert [decode(member.recv(80)) for _ in range(2)] == [(7, b"ONE"), (8, b"TWO")]
            member.close()
            pump_until(can, taken, lambda: not can.ready)
        assert event in log.getvalue()
        path.unlink()
        taken.messages.clear()
    assert can.name_of(("", 0x7F)) == f"unix:{path} identifier 0x7f"
    can.close()


@pytest.fixture
def slow(log: io.StringIO, tmp_path: Path) -> Iterator[tuple[CanFd, socket.socket]]:
    """A transport and the other end of its socket, which nobody reads."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener:
        listener.bind(str(tmp_path / "bus"))
        listener.listen()
        can = CanFd(f"unix:{tmp_path / 'bus'}", EventLog(log, False))
        with listener.accept()[0] as member:
            member.setblocking(False)
            yield can, member
        can.close()


def drained(can: CanFd, member: socket.socket) -> list[bytes]:
    """Return all messages that the transport has sent or queued."""
    found: list[bytes] = []
    taken = Taken()
    end = deadline(5)
    while time.monotonic() < end:
        try:
            decoded = decode(member.recv(80))
        except BlockingIOError:
            if not can.writing:
                return found
            can.pump(taken)
            continue
        assert decoded is not None
        found.append(decoded[1])
    raise AssertionError(len(found))


def test_what_a_slow_bus_does_not_take_waits_in_its_order(
    slow: tuple[CanFd, socket.socket], log: io.StringIO
) -> None:
    can, member = slow
    count = 1500
    for number in range(count):
        can.send(ACKNACK + number.to_bytes(2, "big"), (can.label, 1))
    assert can.writing
    assert [message[-2:] for message in drained(can, member)] == [n.to_bytes(2, "big") for n in range(count)]
    assert "bus" not in log.getvalue()


def test_the_newest_samples_wait_and_acknowledgements_find_room(
    slow: tuple[CanFd, socket.socket], log: io.StringIO
) -> None:
    can, member = slow
    for number in range(2 * QUEUE_FRAMES):
        can.send(SAMPLE + number.to_bytes(2, "big"), (can.label, 1))
    can.send(ACKNACK, (can.label, 1))
    *samples, last = drained(can, member)
    assert last == ACKNACK
    numbers = [int.from_bytes(message[-2:], "big") for message in samples]
    assert numbers == sorted(numbers)
    waited = QUEUE_FRAMES // 8
    assert numbers[-waited:] == list(range(2 * QUEUE_FRAMES - waited, 2 * QUEUE_FRAMES))
    assert "slower than the samples" in log.getvalue()


def test_a_bus_that_takes_nothing_costs_bounded_memory(
    slow: tuple[CanFd, socket.socket], log: io.StringIO
) -> None:
    can, member = slow
    for _ in range(3 * QUEUE_FRAMES):
        can.send(ACKNACK, (can.label, 1))
    assert QUEUE_FRAMES <= len(drained(can, member)) < 2 * QUEUE_FRAMES
    assert "takes no frames" in log.getvalue()


def test_messages_that_fit_no_frame_are_not_sent(slow: tuple[CanFd, socket.socket]) -> None:
    can, member = slow
    can.send(bytes(64), (can.label, 1))
    can.send(ACKNACK, (can.label, 1))
    assert drained(can, member) == [ACKNACK]


def test_a_path_that_no_socket_can_have(log: io.StringIO) -> None:
    with pytest.raises(UserError) as raised:
        CanFd("unix:/" + 200 * "x", EventLog(log, False))
    (found,) = raised.value.diagnostics
    assert found.id == "MG-9442"


def _has_can() -> bool:
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
    except OSError:
        return False
    return True


@pytest.mark.skipif(_has_can(), reason="this kernel has CAN sockets")
def test_a_kernel_without_can_is_named(log: io.StringIO) -> None:
    with pytest.raises(UserError) as raised:
        CanFd("can0", EventLog(log, False))
    (found,) = raised.value.diagnostics
    assert (found.id, found.message) == ("MG-9441", "this kernel has no CAN sockets")


@pytest.mark.parametrize("error", [errno.EAFNOSUPPORT, errno.EPROTONOSUPPORT])
def test_a_kernel_without_a_module_of_can_is_not_waited_for(
    log: io.StringIO, monkeypatch: pytest.MonkeyPatch, error: int
) -> None:
    """Without the module `can` the address family is missing, without `can_raw` the protocol (net/can/af_can.c)."""

    def none(*_: object) -> socket.socket:
        raise OSError(error, "not there")

    monkeypatch.setattr(socket, "socket", none)
    with pytest.raises(UserError) as raised:
        CanFd("can0", EventLog(log, False))
    assert [(found.id, "can_raw" in (found.hint or "")) for found in raised.value.diagnostics] == [
        ("MG-9441", True)
    ]
    assert log.getvalue() == ""


class Interface(socket.socket):
    """A socket of an interface that is down, as the kernel has it: it can be bound, and then reports that."""

    def __init__(self, *_: object) -> None:
        super().__init__(socket.AF_UNIX, socket.SOCK_SEQPACKET)

    def setsockopt(self, *_: object) -> None:
        """Accept the options of CAN."""

    def bind(self, address: object) -> None:
        """Accept every name."""

    def getsockopt(self, level: int, option: int) -> int:  # type: ignore[override]
        """Return the pending error."""
        return errno.ENETDOWN if option == socket.SO_ERROR else 0


def test_an_interface_that_is_down_is_waited_for(log: io.StringIO, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(socket, "socket", Interface)
    can = CanFd("can0", EventLog(log, False))
    assert not can.ready
    can.tick(time.monotonic())
    assert not can.ready
    assert log.getvalue().splitlines() == ["canfd can0 cannot be opened (Network is down); waiting for it"]
    can.close()


@pytest.fixture
def vcan() -> Iterator[str]:
    """A virtual bus of the kernel."""
    name = "vcanfd0"
    commands = (["ip", "link", "add", name, "mtu", "72", "type", "vcan"], ["ip", "link", "set", name, "up"])
    for command in commands:
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        except OSError as error:
            pytest.skip(f"no virtual CAN bus: {error}")
        if done.returncode:
            pytest.skip(f"no virtual CAN bus: {done.stderr.strip()}")
    yield name
    subprocess.run(["ip", "link", "delete", name], check=True)


def test_a_bus_of_the_kernel(vcan: str, log: io.StringIO) -> None:
    taken = Taken()
    can = CanFd(vcan, EventLog(log, False))
    with socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as member:
        member.setsockopt(101, 5, 1)  # SOL_CAN_RAW, CAN_RAW_FD_FRAMES
        member.bind((vcan,))
        member.send(record(0x7F, b"\x03abc"))
        pump_until(can, taken, lambda: bool(taken.messages))
        assert taken.messages == [(b"abc", (can.label, 0x7F))]
        can.send(bytes(63), (can.label, 0x7F))
        assert decode(member.recv(80)) == (0x7F, bytes(63))
    can.close()
