# SPDX-License-Identifier: Apache-2.0
"""What wakes the agent's thread and takes samples: in Python, and in quick_calls.c where the core is compiled."""

from __future__ import annotations

import ctypes
import os
import select
import socket
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from microros_gen.agent.quick import quick, quick_receive
from microros_gen.agent.ros.arrivals import NewBell, PlainBell, new_bell, new_take
from microros_gen.ros.layout import SerializedMessage
from microros_gen.ros.libraries import OK, SUBSCRIPTION_TAKE_FAILED, address_of

RING = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_size_t)
TAKE = ctypes.PYFUNCTYPE(ctypes.c_int, *(ctypes.c_void_p,) * 4)
EVENTFD_WRITE = address_of(ctypes.PyDLL(None).eventfd_write)
SUBSCRIPTION = 0x1230
needs_quick = pytest.mark.skipif(quick is None, reason="the core is not compiled")


def ringing(new: NewBell) -> tuple[Any, int, Callable[[int], None]]:
    """Return a bell, its eventfd, and a function that rings for a number of samples as ROS 2 does."""
    descriptor = os.eventfd(0, os.EFD_NONBLOCK)
    bell = new(descriptor, EVENTFD_WRITE)
    function, argument = bell.call()
    ring = RING(function)
    return bell, descriptor, lambda count: ring(argument, count)


@pytest.mark.parametrize("new", [PlainBell, new_bell])
def test_a_bell_counts_what_arrives(new: NewBell) -> None:
    bell, descriptor, ring = ringing(new)
    assert bell.arrived() == 0
    ring(2)
    ring(1)
    assert bell.arrived() == 3
    assert bell.arrived() == 0
    bell.release()
    os.close(descriptor)


@pytest.mark.parametrize("new", [PlainBell, new_bell])
def test_counting_takes_no_wake_up_away(new: NewBell) -> None:
    """The count is that of the eventfd: to read it removes an event that epoll has not told yet."""
    bell, descriptor, ring = ringing(new)
    with select.epoll() as epoll:
        epoll.register(descriptor, select.EPOLLIN | select.EPOLLET)
        for samples in (1, 3):
            bell.arm()
            ring(samples)
            assert bell.arrived() == samples
            assert epoll.poll(0) == [(descriptor, select.EPOLLIN)]
            assert bell.arrived() == 0
    bell.release()
    os.close(descriptor)


def test_a_bell_in_python_writes_each_time() -> None:
    bell, descriptor, ring = ringing(PlainBell)
    for _ in range(2):
        ring(1)
        assert os.eventfd_read(descriptor) == 1
        assert not bell.arm()
    os.close(descriptor)


@needs_quick
def test_a_bell_in_c_writes_once_until_it_is_armed() -> None:
    bell, descriptor, ring = ringing(new_bell)
    assert not bell.arm()
    for _ in range(2):
        ring(1)
        assert os.eventfd_read(descriptor) == 1
        ring(1)
        with pytest.raises(BlockingIOError):
            os.eventfd_read(descriptor)
        assert bell.arm()
        assert not bell.arm()
    assert bell.arrived() == 4
    bell.release()
    os.close(descriptor)


def test_samples_are_taken_by_way_of_the_message() -> None:
    content = ctypes.create_string_buffer(b"\0\1\0\0abcd", 8)
    message = SerializedMessage()
    results = [OK, SUBSCRIPTION_TAKE_FAILED, 1]
    calls = []

    def take(*arguments: int | None) -> int:
        calls.append(arguments)
        message.buffer, message.length = ctypes.addressof(content), 8
        return results[len(calls) - 1]

    libraries: Any = SimpleNamespace(take=TAKE(take))
    libraries.take.argtypes = (ctypes.c_void_p,) * 4
    take_next = new_take(libraries, SUBSCRIPTION, message)
    assert [take_next() for _ in results] == [b"\0\1\0\0abcd", SUBSCRIPTION_TAKE_FAILED, 1]
    assert calls == [(SUBSCRIPTION, ctypes.addressof(message), None, None)] * 3


@needs_quick
def test_datagrams_are_received_until_the_queue_is_empty() -> None:
    assert quick_receive is not None
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.connect(receiver.getsockname())
        sent = [b"a", b"", b"c" * 65_507]
        for datagram in sent:
            sender.send(datagram)
        assert [quick_receive(receiver.fileno()) for _ in range(4)] == [*sent, None]
    receiver.close()
    with pytest.raises(OSError, match="Bad file descriptor"):
        quick_receive(receiver.fileno())
