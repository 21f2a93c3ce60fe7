# SPDX-License-Identifier: Apache-2.0
"""Publishers, subscriptions, services and service clients of clients: raw bytes both ways."""

from __future__ import annotations

import ctypes
import os
import struct
from collections.abc import Callable
from ctypes import addressof, byref, c_char_p, c_int64, c_void_p
from typing import Any

from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.graph import Endpoint, Events
from microros_gen.agent.ros.layout import RawMessage, RequestId, SerializedMessage, ServiceInfo
from microros_gen.agent.ros.libraries import (
    CLIENT_TAKE_FAILED,
    FAILURES,
    OK,
    SERVICE_TAKE_FAILED,
    SUBSCRIPTION_TAKE_FAILED,
    TIMEOUT,
    first_line,
    new_bytes,
)
from microros_gen.agent.ros.raw_types import ENCAPSULATION_BYTES, RawTypes
from microros_gen.agent.ros.wakeups import Notify, Wakeups
from microros_gen.agent.wire.constants import Status

IDENTITY_BYTES = 24
"""SampleIdentity of DDS-RPC: GUID, then the sequence number as signed high and unsigned low word."""
_GUID_BYTES = 16
_NUMBER = struct.Struct("<iI")


class Ros:
    """What all entities of a bridge share: the libraries, the wake-ups, and one buffer that samples are taken into."""

    def __init__(self, types: RawTypes) -> None:
        self.libraries = types.libraries
        self.types = types
        self.wakeups: Wakeups[Any] = Wakeups()
        self.taken = SerializedMessage(allocator=self.libraries.default_allocator())

    def close(self) -> None:
        """Give everything back, after all entities are destroyed."""
        self.wakeups.close()
        self.libraries.free_message(byref(self.taken))


class _Entity:
    """A handle of rclpy and the endpoints that it stands for. Destroying it again does nothing."""

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


class RawWriter(_Entity):
    """See Writer."""

    def __init__(self, handle: Any, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        super().__init__(handle, events, endpoints)
        self._publish = handle.publish_raw

    def publish(self, serialized: bytes) -> None:
        """See Writer."""
        try:
            self._publish(serialized)
        except FAILURES as error:
            raise BridgeError(f"publish on {self.label}: {first_line(error)}") from error


class _RawSource(_Entity):
    """What ROS 2 wakes up the agent for, until it is destroyed."""

    def __init__(
        self, handle: Any, ros: Ros, notify: Notify, events: Events, endpoints: tuple[Endpoint, ...]
    ) -> None:
        self._pointer: int = handle.pointer
        self._libraries = ros.libraries
        self._wakeups = ros.wakeups
        self._descriptor = ros.wakeups.add(self)
        # What came before is told at once, unless it comes between the two steps of rmw_fastrtps: so look once.
        if notify(self._pointer, ros.libraries.eventfd_write, self._descriptor) != OK:
            ros.wakeups.remove(self._descriptor)
            raise BridgeError(self._libraries.error())
        os.eventfd_write(self._descriptor, 1)
        super().__init__(handle, events, endpoints)

    def _leave(self) -> None:
        # Its DDS reader goes with the handle, and waits for a callback that is under way: only then nobody writes. (To
        # unset the callback first would crash rmw_fastrtps if a request came in that moment.)
        descriptor, self._descriptor = self._descriptor, -1
        super()._leave()
        self._wakeups.remove(descriptor)

    def _failed(self, doing: str) -> BridgeError:
        return BridgeError(f"{doing} on {self.label}: {self._libraries.error()}")


class RawReader(_RawSource):
    """See Reader."""

    def __init__(self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        super().__init__(handle, ros, ros.libraries.notify_subscription, events, endpoints)
        self._message = ros.taken
        self._arguments = (self._pointer, addressof(ros.taken), None, None)
        self._take = ros.libraries.take

    def take(self) -> bytes | None:
        """See Reader."""
        if self._descriptor < 0:
            return None
        result = self._take(*self._arguments)
        if result == OK:
            return new_bytes(self._message.buffer, self._message.length)
        if result == SUBSCRIPTION_TAKE_FAILED:
            return None
        raise self._failed("take")


class _RawService(_RawSource):
    """A service or a service client.

    Taking one may give nothing although more is there: replies to other clients of the service come here as well, and
    ROS 2 passes over them one by one. So as many are taken as were told of.
    """

    def __init__(
        self,
        handle: Any,
        ros: Ros,
        notify: Notify,
        take: Callable[..., int],
        events: Events,
        endpoints: tuple[Endpoint, ...],
    ) -> None:
        super().__init__(handle, ros, notify, events, endpoints)
        self._compared = False
        self._types = ros.types
        self._take = take
        self._told = 0
        self._info = ServiceInfo()
        self._ignored = RawMessage()
        self._arguments = (self._pointer, byref(self._info), byref(self._ignored))

    def _take_next(self) -> bytes | None:
        while self._descriptor >= 0:
            if not self._told:
                try:
                    self._told = os.eventfd_read(self._descriptor)
                except BlockingIOError:
                    return None
            self._told -= 1
            result = self._take(*self._arguments)
            if result == OK:
                self._compare()
                return self._types.taken()
            if result not in (SERVICE_TAKE_FAILED, CLIENT_TAKE_FAILED):
                raise self._failed("take")
        return None

    def _compare(self) -> None:
        """ROS 2 has no events of services: the first message shows that somebody is there to compare with."""
        if not self._compared:
            self._compared = True
            for endpoint in self._endpoints:
                self._events.compare(endpoint)

    def _check_alive(self) -> None:
        if self._descriptor < 0:
            raise BridgeError(f"{self.label} is gone")


class RawReplier(_RawService):
    """See Replier."""

    def __init__(self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_service, libraries.take_request, events, endpoints)

    def take(self) -> tuple[bytes, bytes] | None:
        """See Replier."""
        message = self._take_next()
        if message is None:
            return None
        request = self._info.request
        return bytes(request.guid) + _NUMBER.pack(request.number >> 32, request.number & 0xFFFFFFFF), message

    def reply(self, identity: bytes, serialized: bytes) -> None:
        """See Replier."""
        if len(identity) != IDENTITY_BYTES:
            raise BridgeError(f"a sample identity of {len(identity)} bytes", Status.INVALID_DATA)
        high, low = _NUMBER.unpack_from(identity, _GUID_BYTES)
        request = RequestId(number=high << 32 | low)
        request.guid[:] = identity[:_GUID_BYTES]
        self._check_alive()
        result = self._libraries.send_response(self._pointer, byref(request), byref(raw_message(serialized)))
        if result == TIMEOUT:
            raise BridgeError(f"reply on {self.label}: the client that asked is not there to receive it")
        if result != OK:
            raise self._failed("reply")


class RawRequester(_RawService):
    """See Requester."""

    def __init__(self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_client, libraries.take_response, events, endpoints)

    def request(self, serialized: bytes) -> int:
        """See Requester."""
        self._check_alive()
        number = c_int64()
        message = raw_message(serialized)
        if self._libraries.send_request(self._pointer, byref(message), byref(number)) != OK:
            raise self._failed("request")
        return number.value

    def take(self) -> tuple[int, bytes] | None:
        """See Requester."""
        message = self._take_next()
        return None if message is None else (self._info.request.number, message)


def raw_message(serialized: bytes) -> RawMessage:
    """Return a message that borrows `serialized`, which the caller keeps while it is used."""
    if len(serialized) < ENCAPSULATION_BYTES:
        raise BridgeError(f"a message of {len(serialized)} bytes has no encapsulation", Status.INVALID_DATA)
    return RawMessage(ctypes.cast(c_char_p(serialized), c_void_p), len(serialized))
