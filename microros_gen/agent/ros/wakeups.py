# SPDX-License-Identifier: Apache-2.0
"""Notification of the agent's thread by ROS 2's threads that data was received, without Python.

Each source has an eventfd. ROS 2 calls `eventfd_write(descriptor, count)` of the C library, whose two arguments are
those of ROS 2's callbacks. One epoll descriptor watches all of them for edges, so nothing has to be read: every write
is an edge, even if the count was not 0.
"""

from __future__ import annotations

import ctypes
import os
import select
from collections.abc import Callable
from typing import Protocol

from microros_gen.agent.ros.bridge import BridgeError, Source
from microros_gen.agent.wire.constants import Status

_CLOCK_MONOTONIC = 1
Notify = Callable[[int, int | None, int | None], int]
"""One of rcl's `…set…callback` functions: entity, function (address), its first argument."""


class Watcher:
    """An object that is woken up and is not a source of data."""

    def look(self) -> None:
        """React to the wake-up."""
        raise NotImplementedError


class WokenSource(Source, Protocol):
    """A source that is named by `Bridge.ready` when it was woken up."""

    def woken(self) -> None:
        """Prepare for the next wake-up; called at each one."""


Woken = Watcher | WokenSource


class _Time(ctypes.Structure):
    """itimerspec of Linux on 64-bit machines."""

    _fields_ = tuple((name, ctypes.c_long) for name in ("every_s", "every_ns", "first_s", "first_ns"))


class Wakeups:
    """An epoll descriptor and the objects that its eventfds wake."""

    def __init__(self) -> None:
        self._epoll = select.epoll()
        self._known: dict[int, Woken] = {}

    def fileno(self) -> int:
        """Return the descriptor that is readable while `drain` would return objects."""
        return self._epoll.fileno()

    def add(self, what: Woken) -> int:
        """Return a new eventfd that wakes `what`. Raises BridgeError if the process has no descriptor left."""
        try:
            descriptor = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        except OSError as error:
            raise BridgeError(
                f"no file descriptor is left ({error.strerror}): raise the limit (ulimit -n)",
                Status.RESOURCES,
            ) from error
        self.watch(descriptor, what)
        return descriptor

    def watch(self, descriptor: int, what: Woken) -> None:
        """Let a descriptor wake `what`; it is closed with the others."""
        self._known[descriptor] = what
        self._epoll.register(descriptor, select.EPOLLIN | select.EPOLLET)

    def add_timer(self, what: Woken) -> int:
        """Return a timer that wakes `what`, stopped until `set_timer`. Raises BridgeError without a free descriptor."""
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
        """Close an eventfd that has no writer any more."""
        self._epoll.unregister(descriptor)
        del self._known[descriptor]
        os.close(descriptor)

    def drain(self) -> list[Woken]:
        """Return the objects woken up since the last call, each once. Never waits."""
        return [self._known[descriptor] for descriptor, _ in self._epoll.poll(0)]

    def close(self) -> None:
        """Close all descriptors, which must have no writer any more."""
        for descriptor in list(self._known):
            self.remove(descriptor)
        self._epoll.close()


def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)
