# SPDX-License-Identifier: Apache-2.0
"""Publishers, subscriptions, service clients and servers of any type, with dicts as messages (see `codec`)."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Mapping
from ctypes import byref, c_char_p, c_int64, c_void_p
from functools import partial
from typing import Any

from microros_gen.ros.codec import ENCAPSULATION_BYTES
from microros_gen.ros.errors import RosError
from microros_gen.ros.known_types import KnownType
from microros_gen.ros.layout import RawMessage, RequestId, ServiceInfo
from microros_gen.ros.libraries import (
    CLIENT_TAKE_FAILED,
    FAILURES,
    OK,
    SERVICE_TAKE_FAILED,
    TIMEOUT,
    first_line,
)
from microros_gen.ros.names import ServiceName
from microros_gen.ros.raw_types import RawTypes

Value = dict[str, Any]
MessageInfo = Mapping[str, Any]
"""What rmw says of a received message (rmw_message_info_t): `source_timestamp` and `received_timestamp` in nanoseconds
since 1970, `publication_sequence_number`, `reception_sequence_number`."""
Spin = Callable[[Callable[[], object], float], bool]
"""Spins until something is true, at most so many seconds; returns whether it is."""
Respond = Callable[[Mapping[str, Any]], object]
"""Sends the response to one request. Raises CodecError for an invalid value, RosError if the client is gone."""
SETTLE_S = 0.1
"""From the discovery of a service to the first request: what is sent before the service has found its client too is
delivered only with the writer's next heartbeat, 3 s later."""
UNDISCOVERED_S = 5.0
"""How long a response waits for its client to be discovered: on a busy machine, a request may be faster."""


class RawPublisher:
    """Publishes messages as they are on the wire: encapsulation and CDR body."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle

    def publish(self, data: bytes) -> None:
        """Publish a message. Raises RosError if DDS refuses it."""
        try:
            self._handle.publish_raw(data)
        except FAILURES as error:
            raise RosError(f"publish: {first_line(error)}") from error

    def subscriptions(self) -> int:
        """Return the number of matched subscriptions."""
        return int(self._handle.get_subscription_count())


class Publisher:
    """Publishes dicts on a topic."""

    def __init__(self, handle: Any, known: KnownType) -> None:
        self._raw = RawPublisher(handle)
        self._known = known

    def publish(self, value: Mapping[str, Any]) -> None:
        """Encode and publish a message. Raises CodecError for an invalid value, RosError if DDS refuses it."""
        self._raw.publish(self._known.codec.encode(self._known.name, value))

    def subscriptions(self) -> int:
        """Return the number of matched subscriptions."""
        return self._raw.subscriptions()


class _Waited:
    """What a wait set of rclpy takes."""

    kind: str
    handle: Any

    def add(self, waits: Any) -> int:
        """Add it to an rclpy wait set; return its index there."""
        return int(getattr(waits, f"add_{self.kind}")(self.handle))


class RawSubscription(_Waited):
    """Passes received messages to a callback as they were on the wire, with what ROS 2 says of them."""

    kind = "subscription"

    def __init__(self, handle: Any, callback: Callable[[bytes, MessageInfo], object]) -> None:
        self.handle = handle
        self._received = callback

    def publishers(self) -> int:
        """Return the number of matched publishers."""
        return int(self.handle.get_publisher_count())

    def look(self) -> None:
        """Take at most one message and call back. Raises what the callback raises."""
        taken = self.handle.take_message(None, True)
        if taken is not None:
            self._received(taken[0], taken[1])


class Subscription(RawSubscription):
    """Passes received messages to a callback as dicts."""

    def __init__(self, handle: Any, known: KnownType, callback: Callable[[Value], object]) -> None:
        super().__init__(handle, lambda data, _: callback(known.codec.decode(known.name, data)))


class LostMessages(_Waited):
    """Reports messages of a subscription that were lost on their way, as far as DDS knows."""

    kind = "event"

    def __init__(self, handle: Any, callback: Callable[[int, int], object]) -> None:
        self.handle = handle
        self._lost = callback

    def look(self) -> None:
        """Take what was lost, and call back with the number since the last call and in total."""
        status = self.handle.take_event()
        if status is not None:
            self._lost(status.total_count_change, status.total_count)


class _ServiceEnd(_Waited):
    """Common part of service clients and servers: takes and sends messages."""

    def __init__(self, handle: Any, known: KnownType, name: ServiceName, types: RawTypes) -> None:
        self.handle = handle
        self.name = name
        self._codec = known.codec
        self._types = types
        self._libraries = types.libraries
        self._info = ServiceInfo()
        self._ignored = RawMessage()

    def _take(self, take: Callable[..., int]) -> bytes | None:
        result = take(self.handle.pointer, byref(self._info), byref(self._ignored))
        if result == OK:
            return self._types.taken()
        if result in (SERVICE_TAKE_FAILED, CLIENT_TAKE_FAILED):
            return None
        raise RosError(f"take on {self.name}: {self._libraries.error()}")

    def _check(self, result: int, doing: str) -> None:
        if result != OK:
            raise RosError(f"{doing} on {self.name}: {self._libraries.error()}")


class Client(_ServiceEnd):
    """A service client."""

    kind = "client"

    def __init__(self, handle: Any, known: KnownType, name: ServiceName, types: RawTypes, spin: Spin) -> None:
        super().__init__(handle, known, name, types)
        self._spin = spin
        self._waiting: dict[int, Callable[[Value], object]] = {}
        self._several: set[int] = set()
        self._settled = False

    def available(self) -> bool:
        """Return whether a server is matched."""
        return bool(self.handle.service_server_is_available())

    def wait(self, timeout_s: float) -> bool:
        """Spin until a server is matched, for at most `timeout_s` seconds; return whether one is."""
        if not self._spin(self.available, timeout_s):
            self._settled = False
            return False
        if not self._settled:
            self._spin(lambda: False, SETTLE_S)
            self._settled = True
        return True

    def send(self, request: Mapping[str, Any], done: Callable[[Value], object], several: bool = False) -> int:
        """Send a request without waiting; return its sequence number.

        `done` is called with the response by a later `spin_once`; where `several` servers may answer, with each
        response until the request is forgotten. Raises CodecError for an invalid value.
        """
        number = c_int64()
        data = self._codec.encode(self.name.request, request)
        result = self._libraries.send_request(self.handle.pointer, byref(_raw(data)), byref(number))
        self._check(result, "request")
        self._waiting[number.value] = done
        if several:
            self._several.add(number.value)
        return number.value

    def size(self, request: Mapping[str, Any]) -> int:
        """Return the bytes of an encoded request without its header. Raises CodecError for an invalid value."""
        return len(self._codec.encode(self.name.request, request)) - ENCAPSULATION_BYTES

    def forget(self, number: int) -> None:
        """Ignore the response to the request with this number."""
        self._waiting.pop(number, None)
        self._several.discard(number)

    def call(self, request: Mapping[str, Any], timeout_s: float = 5.0) -> Value | None:
        """Wait for a server, send a request and spin until the response arrives; return None after a time-out.

        `timeout_s` limits both waits, in seconds each. Other callbacks of the peer run meanwhile. Callbacks must use
        `send` instead. Raises CodecError for an invalid value.
        """
        responses: list[Value] = []
        if not self.wait(timeout_s):
            return None
        number = self.send(request, responses.append)
        try:
            self._spin(lambda: responses, timeout_s)
        finally:
            self.forget(number)
        return responses[0] if responses else None

    def look(self) -> None:
        """Take at most one response; call back if its request is outstanding."""
        data = self._take(self._libraries.take_response)
        if data is None:
            return
        number = self._info.request.number
        done = self._waiting.get(number)
        if number not in self._several:
            self.forget(number)
        if done is not None:
            done(self._codec.decode(self.name.response, data))


class Server(_ServiceEnd):
    """A service server; a function gets each request and what sends its response, now or later."""

    kind = "service"

    def __init__(
        self,
        handle: Any,
        known: KnownType,
        name: ServiceName,
        types: RawTypes,
        serve: Callable[[Value, Respond], object],
    ) -> None:
        super().__init__(handle, known, name, types)
        self._serve = serve
        self._held: list[tuple[float, RequestId, bytes]] = []

    @property
    def holds(self) -> bool:
        """Return whether a response waits for its client to be discovered."""
        return bool(self._held)

    def look(self) -> None:
        """Take at most one request and serve it. Raises RosError if its client cannot be reached."""
        data = self._take(self._libraries.take_request)
        if data is None:
            return
        request = RequestId.from_buffer_copy(self._info.request)
        self._serve(self._codec.decode(self.name.request, data), partial(self._respond, request))

    def _respond(self, request: RequestId, response: Mapping[str, Any]) -> None:
        encoded = self._codec.encode(self.name.response, response)
        self._send(time.monotonic() + UNDISCOVERED_S, request, encoded)

    def send_held(self) -> None:
        """Try again to send the responses that wait. Raises RosError if a client was not discovered in time."""
        held, self._held = self._held, []
        while held:
            try:
                self._send(*held.pop(0))
            except RosError:
                self._held += held
                raise

    def _send(self, until: float, request: RequestId, encoded: bytes) -> None:
        """Send a response, or hold it: after 0.1 s ROS 2 gives up a client that it has not discovered."""
        sent = _raw(encoded)
        result = self._libraries.send_response(self.handle.pointer, byref(request), byref(sent))
        if result == TIMEOUT and time.monotonic() < until:
            self._libraries.error()
            self._held.append((until, request, encoded))
        else:
            self._check(result, "response")


def _raw(data: bytes) -> RawMessage:
    """Return a message that borrows `data`, which ctypes keeps alive with it."""
    return RawMessage(ctypes.cast(c_char_p(data), c_void_p), len(data))
