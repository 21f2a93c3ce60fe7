# SPDX-License-Identifier: Apache-2.0
"""Publishers, subscriptions, services and service clients of clients: raw bytes both ways."""

from __future__ import annotations

import ctypes
import os
import struct
from collections.abc import Callable
from ctypes import byref, c_char_p, c_int64, c_void_p, string_at
from typing import Any

from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.layout import RawMessage, RequestId, SerializedMessage, ServiceInfo
from microros_gen.agent.ros.libraries import (
    CLIENT_TAKE_FAILED,
    OK,
    SERVICE_TAKE_FAILED,
    SUBSCRIPTION_TAKE_FAILED,
    TIMEOUT,
    Libraries,
)
from microros_gen.agent.ros.raw_types import ENCAPSULATION_BYTES, RawTypes
from microros_gen.agent.ros.wakeups import Notify, Wakeups
from microros_gen.agent.wire.constants import Status

FAILURES = (RuntimeError, ValueError, TypeError, OSError)
"""What rclpy's handles raise: RCLError is a RuntimeError, refused names are ValueErrors."""
IDENTITY_BYTES = 24
"""SampleIdentity of DDS-RPC: GUID, then the sequence number as signed high and unsigned low word."""
_GUID_BYTES = 16
_NUMBER = struct.Struct("<iI")


class RawWriter:
    """See Writer."""

    def __init__(self, handle: Any, label: str) -> None:
        self._handle = handle
        self._publish = handle.publish_raw
        self.label = label

    def publish(self, serialized: bytes) -> None:
        """See Writer."""
        try:
            self._publish(serialized)
        except FAILURES as error:
            raise BridgeError(f"publish on {self.label}: {first_line(error)}") from error

    def destroy(self) -> None:
        """See Writer."""
        self._handle.destroy_when_not_in_use()


class Ros:
    """What all sources of a bridge share: the libraries, the wake-ups, and one buffer that samples are taken into."""

    def __init__(self, libraries: Libraries, types: RawTypes) -> None:
        self.libraries = libraries
        self.types = types
        self.wakeups: Wakeups[Any] = Wakeups()
        self.taken = SerializedMessage(allocator=libraries.default_allocator())

    def close(self) -> None:
        """Give everything back, after all sources are destroyed."""
        self.wakeups.close()
        self.libraries.free_message(byref(self.taken))


class _RawSource:
    """What ROS 2 wakes up the agent for, until it is destroyed."""

    def __init__(self, handle: Any, label: str, ros: Ros, notify: Notify) -> None:
        self._handle = handle
        self._pointer: int = handle.pointer
        self._libraries = ros.libraries
        self._wakeups = ros.wakeups
        self.label = label
        self._descriptor = ros.wakeups.add(self)
        # What came before is told at once, unless it comes between the two steps of rmw_fastrtps: so look once.
        if notify(self._pointer, ros.libraries.eventfd_write, self._descriptor) != OK:
            ros.wakeups.remove(self._descriptor)
            raise BridgeError(f"{label}: {self._libraries.error()}")
        os.eventfd_write(self._descriptor, 1)

    def destroy(self) -> None:
        """See Source."""
        if self._descriptor < 0:
            return
        # Its DDS reader goes with the handle, and waits for a callback that is under way: only then nobody writes. (To
        # unset the callback first would crash rmw_fastrtps if a request came in that moment.)
        descriptor, self._descriptor = self._descriptor, -1
        self._handle.destroy_when_not_in_use()
        self._wakeups.remove(descriptor)

    def _failed(self, doing: str) -> BridgeError:
        return BridgeError(f"{doing} on {self.label}: {self._libraries.error()}")


class RawReader(_RawSource):
    """See Reader."""

    def __init__(self, handle: Any, label: str, ros: Ros) -> None:
        super().__init__(handle, label, ros, ros.libraries.notify_subscription)
        self._message = ros.taken
        self._arguments = (self._pointer, byref(ros.taken), None, None)
        self._take = ros.libraries.take

    def take(self) -> bytes | None:
        """See Reader."""
        if self._descriptor < 0:
            return None
        result = self._take(*self._arguments)
        if result == OK:
            return string_at(self._message.buffer, self._message.length)
        if result == SUBSCRIPTION_TAKE_FAILED:
            return None
        raise self._failed("take")


class _RawService(_RawSource):
    """A service or a service client.

    Taking one may give nothing although more is there: replies to other clients of the service come here as well, and
    ROS 2 passes over them one by one. So as many are taken as were told of.
    """

    def __init__(self, handle: Any, label: str, ros: Ros, notify: Notify, take: Callable[..., int]) -> None:
        super().__init__(handle, label, ros, notify)
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
                return self._types.taken()
            if result not in (SERVICE_TAKE_FAILED, CLIENT_TAKE_FAILED):
                raise self._failed("take")
        return None

    def _check_alive(self) -> None:
        if self._descriptor < 0:
            raise BridgeError(f"{self.label} is gone")


class RawReplier(_RawService):
    """See Replier."""

    def __init__(self, handle: Any, label: str, ros: Ros) -> None:
        libraries = ros.libraries
        super().__init__(handle, label, ros, libraries.notify_service, libraries.take_request)

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

    def __init__(self, handle: Any, label: str, ros: Ros) -> None:
        libraries = ros.libraries
        super().__init__(handle, label, ros, libraries.notify_client, libraries.take_response)

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


def first_line(error: Exception) -> str:
    """Return what an exception says, without the lines of context that rcl adds."""
    return (str(error) or type(error).__name__).splitlines()[0]
