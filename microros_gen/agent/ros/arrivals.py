# SPDX-License-Identifier: Apache-2.0
"""How the samples of a subscription reach the agent's thread: it is woken up, and takes them one by one.

With quick_calls.c, if that was compiled, else with ctypes.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from ctypes import addressof, c_void_p
from typing import Protocol

from microros_gen.agent.quick import quick
from microros_gen.ros.layout import SerializedMessage
from microros_gen.ros.libraries import OK, Libraries, address_of, new_bytes

Take = Callable[[], bytes | int]
"""Function that returns the next sample, or what rcl returns in its place."""


class Bell(Protocol):
    """What ROS 2 calls, in one of its threads, when samples have arrived; it writes to an eventfd."""

    def call(self) -> tuple[int, int]:
        """Return the address of the function to call, and its first argument, which exists until `release`."""

    def release(self) -> None:
        """Declare that ROS 2 does not call any more."""

    def arm(self) -> bool:
        """Let the next call write to the eventfd; later ones need not.

        Return whether one may not have written since the last time: then samples may be there.
        """

    def arrived(self) -> int:
        """Return the number of samples that have arrived since the last call."""


class PlainBell:
    """One that writes each time: the C library's `eventfd_write`, whose arguments are those of the callback."""

    def __init__(self, descriptor: int, eventfd_write: int) -> None:
        self._descriptor = descriptor
        self._function = eventfd_write
        self._own = 0
        """Part of the eventfd's count that `arrived` wrote."""

    def call(self) -> tuple[int, int]:
        """See Bell."""
        return self._function, self._descriptor

    def release(self) -> None:
        """See Bell."""

    def arm(self) -> bool:
        """See Bell."""
        return False

    def arrived(self) -> int:
        """See Bell. Reading the eventfd may take away what has not woken the agent yet: it is rung again."""
        own = self._own
        arrived = self.drain()
        if arrived or own:
            os.eventfd_write(self._descriptor, 1)
            self._own = 1
        return arrived

    def drain(self) -> int:
        """Return what `arrived` does, for a caller that takes all of it now: only later ones wake the agent."""
        try:
            count = os.eventfd_read(self._descriptor)
        except BlockingIOError:
            return 0
        own, self._own = self._own, 0
        return count - own


NewBell = Callable[[int, int], Bell]
"""Function that returns the bell of an eventfd, and gets the address of `eventfd_write`."""


def new_bell(descriptor: int, eventfd_write: int) -> Bell:
    """Return the bell of an eventfd that writes as seldom as possible."""
    if quick is None:
        return PlainBell(descriptor, eventfd_write)
    bell: Bell = quick.Bell(descriptor)
    return bell


def new_take(libraries: Libraries, subscription: int, message: SerializedMessage) -> Take:
    """Return the function that takes the samples of a subscription (its address) by way of `message`."""
    if quick is not None:
        take: Take = quick.Taker(address_of(libraries.take), subscription, addressof(message)).take
        return take
    return _plain_take(libraries, subscription, message)


def _plain_take(libraries: Libraries, subscription: int, message: SerializedMessage) -> Take:
    # Objects of ctypes are passed as they are; an int would be converted in each call.
    arguments = (c_void_p(subscription), c_void_p(addressof(message)), None, None)
    function = libraries.take

    def take() -> bytes | int:
        result: int = function(*arguments)
        return new_bytes(message.buffer, message.length) if result == OK else result

    return take
