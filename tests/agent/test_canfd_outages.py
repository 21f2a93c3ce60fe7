# SPDX-License-Identifier: Apache-2.0
"""A CAN interface of the agent that goes down, is removed, loses CAN FD, and comes back: counted, logged, reopened."""

from __future__ import annotations

import errno
import io
import os
import select
import socket
import subprocess
import time
from collections.abc import Callable, Hashable, Iterator

import pytest

from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.canfd import RETRY_S, CanFd, decode, encode
from tests.support.agent.can_interface import CLASSIC_MTU, FD_MTU, CanInterface, ticks
from tests.support.e2e.can_bus import record
from tests.support.patience import deadline

ACKNACK = bytes.fromhex("81000000 0a010500 0100 0000 80")


class Taken:
    """What a transport has delivered."""

    def __init__(self) -> None:
        self.messages: list[bytes] = []

    def __call__(self, message: bytes, address: Hashable, transport: Transport) -> None:
        self.messages.append(message)


@pytest.fixture
def written() -> io.StringIO:
    return io.StringIO()


@pytest.fixture
def log(written: io.StringIO) -> EventLog:
    return EventLog(written, False)


@pytest.fixture
def interface(monkeypatch: pytest.MonkeyPatch) -> Iterator[CanInterface]:
    played = CanInterface(monkeypatch)
    yield played
    played.close()


def is_quiet(can: CanFd) -> bool:
    """Return whether the loop of the agent would wait: what it waits for reports nothing."""
    return not select.select([can], [], [], 0)[0]


def exchange(can: CanFd, interface: CanInterface, taken: Taken) -> None:
    """Let frames go both ways."""
    assert interface.member is not None
    interface.member.send(encode(7, b"one"))
    can.pump(taken)
    assert taken.messages.pop() == b"one"
    can.send(ACKNACK, (can.label, 7))
    assert decode(interface.member.recv(80)) == (7, ACKNACK)


@pytest.mark.parametrize("error", [errno.ENETDOWN, errno.ENODEV])
@pytest.mark.parametrize("how", ["while it waits", "at a message"])
def test_it_is_counted_reported_once_and_reopened(
    interface: CanInterface, log: EventLog, written: io.StringIO, error: int, how: str
) -> None:
    taken, now = Taken(), 0.0
    can = CanFd("can0", log)
    for outage in (1, 2):
        exchange(can, interface, taken)
        interface.leaves(error, wakes=how == "while it waits")
        if how == "while it waits":
            assert not is_quiet(can)
            can.pump(taken)
        else:
            can.send(ACKNACK, (can.label, 7))
        assert not can.ready
        assert log.counters["bus_lost"] == outage
        before = interface.attempts
        now = ticks(can, taken, now, 3.0)
        assert 1 < interface.attempts - before <= 3.0 / RETRY_S + 1
        assert is_quiet(can), "the loop does not spin"
        can.send(ACKNACK, (can.label, 7))
        assert not can.writing, "nothing waits for a bus that is gone"
        interface.absent = 0
        now = ticks(can, taken, now, 1.0)
        assert can.ready
    exchange(can, interface, taken)
    lost = f"canfd can0 is gone ({os.strerror(error)}); waiting for it"
    assert written.getvalue().splitlines() == 2 * [lost, "canfd can0 is back"]
    can.close()


def test_an_adapter_that_is_unplugged(interface: CanInterface, log: EventLog, written: io.StringIO) -> None:
    """It goes down before it is removed; what changes is reported, and each only once."""
    taken = Taken()
    can = CanFd("can0", log)
    interface.leaves(errno.ENETDOWN)
    now = ticks(can, taken, 0.0, 1.0)
    interface.absent = errno.ENODEV
    now = ticks(can, taken, now, 1.0)
    interface.absent = errno.ENETDOWN  # plugged in, not yet up
    now = ticks(can, taken, now, 1.0)
    interface.absent = 0
    ticks(can, taken, now, 1.0)
    exchange(can, interface, taken)
    assert written.getvalue().splitlines() == [
        "canfd can0 is gone (Network is down); waiting for it",
        "canfd can0 cannot be opened (No such device); waiting for it",
        "canfd can0 cannot be opened (Network is down); waiting for it",
        "canfd can0 is back",
    ]
    assert log.counters == {"bus_lost": 1}
    can.close()


def test_an_interface_without_can_fd_is_waited_for(
    interface: CanInterface, log: EventLog, written: io.StringIO
) -> None:
    """It can be bound and refuses each frame that is sent: by its MTU that is known before."""
    interface.mtu = CLASSIC_MTU
    can = CanFd("can0", log)
    now = ticks(can, Taken(), 0.0, 2.0)
    assert not can.ready
    interface.mtu = FD_MTU
    ticks(can, Taken(), now, 1.0)
    exchange(can, interface, Taken())
    assert written.getvalue().splitlines() == [
        "canfd can0 cannot be opened (no CAN FD: its MTU is 16, not 72); waiting for it",
        "canfd can0 is available",
    ]
    assert not log.counters
    can.close()


NAME = "vcanout0"


def ip(*arguments: str) -> None:
    """Run a command of iproute2; skip the test where this kernel has no virtual CAN bus."""
    try:
        done = subprocess.run(("ip", "link", *arguments), capture_output=True, text=True, check=False)
    except OSError as error:
        pytest.skip(f"no virtual CAN bus: {error}")
    if done.returncode:
        pytest.skip(f"no virtual CAN bus: {done.stderr.strip()}")


@pytest.mark.parametrize("removed", [False, True])
def test_an_interface_of_the_kernel(log: EventLog, removed: bool) -> None:
    taken = Taken()
    ip("add", NAME, "mtu", str(FD_MTU), "type", "vcan")
    try:
        ip("set", NAME, "up")
        can = CanFd(NAME, log)
        for outage in (1, 2):
            with socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as member:
                member.setsockopt(101, 5, 1)  # SOL_CAN_RAW, CAN_RAW_FD_FRAMES
                member.bind((NAME,))
                member.send(record(7, b"\x03one"))
                until(can, taken, lambda: bool(taken.messages))
                assert taken.messages.pop() == b"one"
                can.send(ACKNACK, (can.label, 7))
                assert decode(member.recv(80)) == (7, ACKNACK)
            ip("delete" if removed else "set", NAME, *(() if removed else ("down",)))
            until(can, taken, lambda: not can.ready)
            assert log.counters["bus_lost"] == outage
            if removed:
                ip("add", NAME, "mtu", str(FD_MTU), "type", "vcan")
            ip("set", NAME, "up")
            until(can, taken, lambda: can.ready)
        can.close()
    finally:
        subprocess.run(("ip", "link", "delete", NAME), check=False, capture_output=True)


def until(can: CanFd, taken: Taken, done: Callable[[], bool]) -> None:
    """Let a transport run until something is true."""
    end = deadline(5)
    while not done():
        assert time.monotonic() < end
        can.tick(time.monotonic())
        can.pump(taken)
        time.sleep(0.002)
