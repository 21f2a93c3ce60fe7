# SPDX-License-Identifier: Apache-2.0
"""Services and service clients of clients: raw requests and replies, correlated by ROS 2's own identities."""

from __future__ import annotations

import ctypes
import os
import struct
import time
from collections import deque
from collections.abc import Callable
from ctypes import byref, c_char_p, c_int64, c_void_p
from typing import Any

from microros_gen.agent.ros.bridge import BridgeError, NoServer
from microros_gen.agent.ros.endpoints import RawSource, Ros
from microros_gen.agent.ros.graph import Endpoint, Events
from microros_gen.agent.ros.layout import RawMessage, RequestId, ServiceInfo
from microros_gen.agent.ros.libraries import CLIENT_TAKE_FAILED, OK, SERVICE_TAKE_FAILED, TIMEOUT
from microros_gen.agent.ros.raw_types import ENCAPSULATION_BYTES
from microros_gen.agent.ros.wakeups import Notify, Wakeups, Watcher
from microros_gen.agent.wire.constants import Status

IDENTITY_BYTES = 24
"""SampleIdentity of DDS-RPC: GUID, then the sequence number as signed high and unsigned low word."""
WAIT_FOR_SERVER_S = 5.0
"""How long a request waits for a service that has not been there yet."""
SETTLE_S = 0.1
"""From the discovery of a service to the first request: what is sent before the service has found its client too is
only delivered with the writer's next heartbeat, 3 s later."""
HELD_REQUESTS, HELD_BYTES = 64, 262_144
"""Requests of one service client that wait for it, and their size together."""
VANISHED_CLIENTS = 256
"""Clients of a service that are remembered as unknown to the graph."""
_LOOK_AGAIN_S = 0.05
_GUID_BYTES = 16
_NUMBER = struct.Struct("<iI")


class Servers(Watcher):
    """Looks for services that requests wait for: ROS 2 has no event for them."""

    def __init__(self, wakeups: Wakeups[Any]) -> None:
        self._wakeups = wakeups
        self._timer = wakeups.add_timer(self)
        self._waiting: set[RawRequester] = set()

    def wait_for(self, requester: RawRequester) -> None:
        """Look for the service of `requester` until nothing of it waits."""
        if not self._waiting:
            self._wakeups.set_timer(self._timer, _LOOK_AGAIN_S)
        self._waiting.add(requester)

    def look(self) -> None:
        """See Watcher."""
        self._waiting = {requester for requester in self._waiting if requester.still_waits()}
        if self._waiting:
            self._wakeups.set_timer(self._timer, _LOOK_AGAIN_S)


class _RawService(RawSource):
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
                raise self.failed("take")
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
    """See Replier.

    ROS 2 waits (100 ms) for a client that it does not know, since it may be about to be discovered. It is waited for
    once; after that only when the graph has it.
    """

    def __init__(self, handle: Any, ros: Ros, events: Events, endpoints: tuple[Endpoint, ...]) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_service, libraries.take_request, events, endpoints)
        self._vanished: dict[bytes, None] = {}

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
        guid = identity[:_GUID_BYTES]
        if guid in self._vanished:
            if not self._events.has_reader(self._endpoints[1], guid):
                raise self._nobody()
            del self._vanished[guid]
        high, low = _NUMBER.unpack_from(identity, _GUID_BYTES)
        request = RequestId(number=high << 32 | low)
        request.guid[:] = guid
        self._check_alive()
        result = self._libraries.send_response(self._pointer, byref(request), byref(raw_message(serialized)))
        if result == TIMEOUT:
            self._vanished[guid] = None
            if len(self._vanished) > VANISHED_CLIENTS:
                del self._vanished[next(iter(self._vanished))]
            self._libraries.error()  # forget it: it says less
            raise self._nobody()
        if result != OK:
            raise self.failed("reply")

    def _nobody(self) -> BridgeError:
        return BridgeError(f"reply on {self.label}: the client that asked is not there to receive it")


class RawRequester(_RawService):
    """See Requester.

    ROS 2 numbers requests from 1. What is held until the service is there is numbered ahead, in its order.
    """

    def __init__(
        self, handle: Any, ros: Ros, servers: Servers, events: Events, endpoints: tuple[Endpoint, ...]
    ) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_client, libraries.take_response, events, endpoints)
        self._report = ros.report
        self._servers = servers
        self._there = False
        self._found: float | None = None
        self._look_until = time.monotonic() + WAIT_FOR_SERVER_S
        servers.wait_for(self)
        self._held: deque[tuple[float, bytes]] = deque()
        self._dropped = 0

    def request(self, serialized: bytes) -> int:
        """See Requester."""
        self._check_alive()
        raw_message(serialized)
        if self.find_server():
            return self._send(serialized)
        held_bytes = sum(len(held) for _, held in self._held)
        if len(self._held) >= HELD_REQUESTS or held_bytes + len(serialized) > HELD_BYTES:
            raise BridgeError(f"request on {self.label}: nobody serves it", Status.RESOURCES)
        self._held.append((time.monotonic() + WAIT_FOR_SERVER_S, serialized))
        self._servers.wait_for(self)
        return self._dropped + len(self._held)

    def take(self) -> tuple[int, bytes] | None:
        """See Requester."""
        message = self._take_next()
        return None if message is None else (self._info.request.number + self._dropped, message)

    def find_server(self) -> bool:
        """Return whether the service was there once, and had time to find this client; then what is held is sent."""
        if self._there:
            return True
        now = time.monotonic()
        if self._found is None and self._handle.service_server_is_available():
            self._found = now
        if self._found is None or now < self._found + SETTLE_S:
            return False
        self._there = True
        while self._held:
            self._send_held(self._held.popleft()[1])
        return True

    def still_waits(self) -> bool:
        """Drop what waits for too long; return whether the service is still to be looked for."""
        if self._descriptor < 0 or self.find_server():
            return False
        now = time.monotonic()
        while self._held and self._held[0][0] < now and self._found is None:
            self._held.popleft()
            self._drop()
        return bool(self._held) or now < self._look_until

    def _send_held(self, serialized: bytes) -> None:
        try:
            self._send(serialized)
        except BridgeError:
            self._drop()

    def _drop(self) -> None:
        self._dropped += 1
        self._report(NoServer(self._endpoints[0].node, self.label))

    def _send(self, serialized: bytes) -> int:
        number = c_int64()
        message = raw_message(serialized)
        if self._libraries.send_request(self._pointer, byref(message), byref(number)) != OK:
            raise self.failed("request")
        return number.value + self._dropped


def raw_message(serialized: bytes) -> RawMessage:
    """Return a message that borrows `serialized`, which the caller keeps while it is used."""
    if len(serialized) < ENCAPSULATION_BYTES:
        raise BridgeError(f"a message of {len(serialized)} bytes has no encapsulation", Status.INVALID_DATA)
    return RawMessage(ctypes.cast(c_char_p(serialized), c_void_p), len(serialized))
