# SPDX-License-Identifier: Apache-2.0
"""How ROS 2's threads tell the agent's one thread that something was received, without Python.

Each thing that is waited for has an eventfd; ROS 2 calls `eventfd_write(descriptor, count)` of the C library, whose two
arguments are those of ROS 2's callbacks. One epoll descriptor watches all of them for edges, so that nothing has
to be read: a write is an edge, also when the count was not 0.
"""

from __future__ import annotations

import ctypes
import os
import select
from collections.abc import Callable
from typing import Generic, TypeVar

from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.wire.constants import Status

T = TypeVar("T")
_CLOCK_MONOTONIC = 1
Notify = Callable[[int, int | None, int | None], int]
"""One of rcl's `…set…callback` functions: entity, function (address), its first argument."""


class Watcher:
    """Something that is woken up and is no source of data."""

    def look(self) -> None:
        """Check what has happened, and react."""
        raise NotImplementedError


class _Time(ctypes.Structure):
    """itimerspec of Linux on 64-bit machines."""

    _fields_ = tuple((name, ctypes.c_long) for name in ("every_s", "every_ns", "first_s", "first_ns"))


class Wakeups(Generic[T]):
    """An epoll descriptor and the objects that its eventfds wake."""

    def __init__(self) -> None:
        self._epoll = select.epoll()
        self._known: dict[int, T] = {}

    def fileno(self) -> int:
        """Return the descriptor that is readable while `drain` has something."""
        return self._epoll.fileno()

    def add(self, what: T) -> int:
        """Return a new eventfd that wakes `what`; BridgeError when the process has no descriptor left."""
        try:
            descriptor = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        except OSError as error:
            raise BridgeError(
                f"no file descriptor is left ({error.strerror}): raise the limit (ulimit -n)",
                Status.RESOURCES,
            ) from error
        self.watch(descriptor, what)
        return descriptor

    def watch(self, descriptor: int, what: T) -> None:
        """Let a descriptor wake `what`; it is closed with the others."""
        self._known[descriptor] = what
        self._epoll.register(descriptor, select.EPOLLIN | select.EPOLLET)

    def add_timer(self, what: T) -> int:
        """Return a timer that wakes `what` and rests until `set_timer`; BridgeError as above."""
        descriptor = int(_libc().timerfd_create(_CLOCK_MONOTONIC, os.O_NONBLOCK | os.O_CLOEXEC))
        if descriptor < 0:
            raise BridgeError("no file descriptor is left: raise the limit (ulimit -n)", Status.RESOURCES)
        self.watch(descriptor, what)
        return descriptor

    @staticmethod
    def set_timer(descriptor: int, seconds: float) -> None:
        """Let a timer wake up once, after this number of seconds."""
        deadline = _Time(first_s=int(seconds), first_ns=round(seconds % 1 * 1e9))
        _libc().timerfd_settime(descriptor, 0, ctypes.byref(deadline), None)

    def remove(self, descriptor: int) -> None:
        """Close an eventfd to which nothing writes any more."""
        self._epoll.unregister(descriptor)
        del self._known[descriptor]
        os.close(descriptor)

    def drain(self) -> list[T]:
        """Return what was woken up since the last call, each once. Never waits."""
        return [self._known[descriptor] for descriptor, _ in self._epoll.poll(0)]

    def close(self) -> None:
        """Close everything; nothing writes any more."""
        for descriptor in list(self._known):
            self.remove(descriptor)
        self._epoll.close()


def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)
