# SPDX-License-Identifier: Apache-2.0
"""Publishers, subscriptions, services and service clients of clients: raw bytes both ways."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from ctypes import byref
from typing import Any

from microros_gen.agent.ros.arrivals import NewBell, PlainBell, new_bell, new_take
from microros_gen.agent.ros.bridge import BridgeError, BusyError, GraphReport
from microros_gen.agent.ros.graph import Endpoint, Events
from microros_gen.agent.ros.wakeups import Notify, Wakeups
from microros_gen.ros.layout import SerializedMessage
from microros_gen.ros.libraries import FAILURES, OK, SUBSCRIPTION_TAKE_FAILED, first_line
from microros_gen.ros.raw_types import RawTypes

FULL_S, LONGEST_FULL_S = 0.002, 0.064
"""Shortest and longest seconds until a full writer is retried: each attempt blocks the agent for 1 ms in DDS."""


class Ros:
    """Shared by all entities of a bridge: libraries, wake-ups, and one buffer into which samples are taken."""

    def __init__(self, types: RawTypes, report: Callable[[GraphReport], None], request_wait_s: float) -> None:
        self.report = report
        self.request_wait_s = request_wait_s
        self.libraries = types.libraries
        self.types = types
        self.wakeups = Wakeups()
        self.taken = SerializedMessage(allocator=self.libraries.default_allocator())

    def close(self) -> None:
        """Release everything, after all entities are destroyed."""
        self.wakeups.close()
        self.libraries.free_message(byref(self.taken))


class Entity:
    """A handle of rclpy and the endpoints that it represents. Destroying it again does nothing."""

    def __init__(self, handle: Any, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        self._handle = handle
        self._events = events
        self._endpoints = endpoints
        self.label = endpoints[0].label
        events.entities.add(self)

    def destroy(self) -> None:
        """See Writer and Source."""
        if self in self._events.entities:
            self._events.entities.discard(self)
            self._events.release(self._endpoints)
            self._leave()

    def _leave(self) -> None:
        self._handle.destroy_when_not_in_use()


class RawWriter(Entity):
    """See Writer."""

    def __init__(
        self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...], keeps_all: bool
    ) -> None:
        """`keeps_all`: it waits for its readers (reliable, KEEP_ALL): then DDS may have no room for a sample."""
        super().__init__(handle, events, endpoints)
        self._publish = handle.publish_raw
        self._libraries = ros.libraries
        self._keeps_all = keeps_all
        self._full_s = 0.0
        """Current interval until DDS is tried again, in seconds; 0: it accepted the last sample."""
        self._full_until = 0.0

    def publish(self, serialized: bytes) -> None:
        """See Writer."""
        if self._full_s and time.monotonic() < self._full_until:
            raise self._busy()
        try:
            self._publish(serialized)
        except FAILURES as error:
            if self._keeps_all:
                self._full_s = min(max(FULL_S, 2 * self._full_s), LONGEST_FULL_S)
                self._full_until = time.monotonic() + self._full_s
                raise self._busy() from error
            raise BridgeError(f"publish on {self.label}: {first_line(error)}") from error
        self._full_s = 0.0

    def _busy(self) -> BusyError:
        return BusyError(f"{self.label}: a reader does not read its samples, and the history of DDS is full")

    def settled(self, wait_s: float = 0.0) -> bool:
        """See Writer."""
        if self._libraries.all_acknowledged(self._handle.pointer, round(wait_s * 1e9)) == OK:
            return True
        self._libraries.error()  # clear the error, which is the expired time
        return False


class RawSource(Entity):
    """An entity for which ROS 2 wakes the agent, until it is destroyed."""

    def __init__(
        self,
        handle: Any,
        ros: Ros,
        notify: Notify,
        events: Events,
        endpoints: tuple[Endpoint, ...],
        new_bell: NewBell = PlainBell,
    ) -> None:
        self._empty = True
        """Whether it was empty at some time since the last call of `unread`."""
        self._arrived = 0
        self._pointer: int = handle.pointer
        self._libraries = ros.libraries
        self._wakeups = ros.wakeups
        self._descriptor = ros.wakeups.add(self)
        # What came before is reported at once, unless it comes between the two steps of rmw_fastrtps: so look once.
        self._bell = new_bell(self._descriptor, ros.libraries.eventfd_write)
        if notify(self._pointer, *self._bell.call()) != OK:
            self._bell.release()
            ros.wakeups.remove(self._descriptor)
            raise BridgeError(self._libraries.error())
        os.eventfd_write(self._descriptor, 1)
        super().__init__(handle, events, endpoints)

    def _leave(self) -> None:
        # Its DDS reader goes with the handle, and waits for a callback that is under way: only then nobody writes. (To
        # unset the callback first would crash rmw_fastrtps if a request came in that moment.)
        descriptor, self._descriptor = self._descriptor, -1
        super()._leave()
        self._bell.release()
        self._wakeups.remove(descriptor)

    def unread(self) -> int:
        """See Source."""
        if self._empty:
            self._empty, self._arrived = False, 0
        if self._descriptor >= 0:
            self._arrived += self._bell.arrived()
        return self._arrived

    def woken(self) -> None:
        """See WokenSource."""

    def failed(self, doing: str) -> BridgeError:
        """Return the error that ROS 2 reported while `doing` something."""
        return BridgeError(f"{doing} on {self.label}: {self._libraries.error()}")


class RawReader(RawSource):
    """See Reader."""

    def __init__(self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        super().__init__(handle, ros, ros.libraries.notify_subscription, events, endpoints, new_bell)
        self._drained = True
        """Whether it was empty when last looked at: only then the next sample has to wake the agent."""
        self._take = new_take(ros.libraries, self._pointer, ros.taken)

    def woken(self) -> None:
        """See WokenSource. With samples left it is not woken again: whoever left them continues by itself."""
        if self._drained:
            self._drained = False
            self._bell.arm()

    def take(self) -> bytes | None:
        """See Reader."""
        if self._descriptor < 0:
            return None
        taken = self._take()
        if isinstance(taken, bytes):
            return taken
        if taken == SUBSCRIPTION_TAKE_FAILED and self._bell.arm():
            taken = self._take()  # what came between these calls woke nobody
            if isinstance(taken, bytes):
                return taken
        if taken == SUBSCRIPTION_TAKE_FAILED:
            self._empty = self._drained = True
            return None
        raise self.failed("take")
