# SPDX-License-Identifier: Apache-2.0
"""Services of clients, and what they share with service clients: raw requests and replies, correlated by ROS 2."""

from __future__ import annotations

import ctypes
import struct
import time
from collections import deque
from collections.abc import Callable
from ctypes import byref, c_char_p, c_void_p
from typing import Any, Protocol

from microros_gen.agent.ros.arrivals import PlainBell
from microros_gen.agent.ros.bridge import BridgeError, NoClient
from microros_gen.agent.ros.endpoints import RawSource, Ros
from microros_gen.agent.ros.graph import Endpoint, Events
from microros_gen.agent.ros.wakeups import Notify, Wakeups, Watcher
from microros_gen.agent.wire.constants import Status
from microros_gen.ros.layout import RawMessage, RequestId, ServiceInfo
from microros_gen.ros.libraries import CLIENT_TAKE_FAILED, OK, SERVICE_TAKE_FAILED, TIMEOUT
from microros_gen.ros.raw_types import ENCAPSULATION_BYTES

IDENTITY_BYTES = 24
"""SampleIdentity of DDS-RPC: GUID, then the sequence number as signed high and unsigned low word."""
WAIT_FOR_CLIENT_S = 5.0
"""Seconds that a reply waits for a client that is not in the graph yet."""
HELD_CALLS, HELD_BYTES = 64, 262_144
"""Maximum number and bytes of waiting requests of one service client, or waiting replies of one service."""
HELD_BYTES_OF_ALL = 16_777_216
"""Maximum bytes for all services and service clients of the agent."""
DEAF_CLIENTS = 256
"""Maximum number of a service's clients remembered as unreachable."""
DEAF_S, LONGEST_DEAF_S = 0.5, 60.0
"""Seconds until a client that ROS 2 did not reach is tried again: after the first time, and at most. Each attempt may
block the agent for 100 ms. On a busy machine the graph has a client long before it is matched; one with another quality
of service is never matched."""
BLOCKED_PAUSE = 9
"""Times the duration of an attempt that blocked the agent: so long no other client that was never reached is tried, of
all services. They take a tenth of the agent's time at most, however many clients come at once."""
_LOOK_AGAIN_S = 0.05
_GUID_BYTES = 16
_NUMBER = struct.Struct("<iI")


class Waiter(Protocol):
    """Waits for a service or client to appear in the graph."""

    def still_waits(self) -> bool:
        """Look for the other side, and continue if it exists; return whether to look again."""


class Patience(Watcher):
    """Polls for the other side of a service, for which ROS 2 has no event."""

    def __init__(self, wakeups: Wakeups) -> None:
        self._wakeups = wakeups
        self._timer = wakeups.add_timer(self)
        self._waiting: set[Waiter] = set()
        self.held_bytes = 0
        """Bytes of all waiting calls."""
        self.may_block_at = 0.0
        """When a call that may block the agent may be made again."""

    def wait_for(self, waiter: Waiter) -> None:
        """Call `still_waits` of `waiter` repeatedly until it returns False."""
        if not self._waiting:
            self._wakeups.set_timer(self._timer, _LOOK_AGAIN_S)
        self._waiting.add(waiter)

    def look(self) -> None:
        """See Watcher."""
        self._waiting = {waiter for waiter in self._waiting if waiter.still_waits()}
        if self._waiting:
            self._wakeups.set_timer(self._timer, _LOOK_AGAIN_S)


class Held:
    """Calls that wait for the other side, each until a time of the monotonic clock, the oldest first."""

    def __init__(self, patience: Patience) -> None:
        self._patience = patience
        self._calls: deque[tuple[float, Any, bytes]] = deque()
        self._bytes = 0

    def __len__(self) -> int:
        return len(self._calls)

    def put(self, until: float, key: Any, serialized: bytes) -> bool:
        """Store a call; return False if it does not fit."""
        size = len(serialized)
        if (
            len(self._calls) >= HELD_CALLS
            or self._bytes + size > HELD_BYTES
            or self._patience.held_bytes + size > HELD_BYTES_OF_ALL
        ):
            return False
        self._calls.append((until, key, serialized))
        self._count(size)
        return True

    def over(self, now: float) -> bool:
        """Return whether the oldest has waited long enough."""
        return bool(self._calls) and self._calls[0][0] <= now

    def pop(self) -> tuple[float, Any, bytes]:
        """Remove and return the oldest call: its time, key and bytes."""
        call = self._calls.popleft()
        self._count(-len(call[2]))
        return call

    def pop_all(self) -> list[tuple[float, Any, bytes]]:
        """Remove and return all calls."""
        return [self.pop() for _ in range(len(self._calls))]

    def _count(self, size: int) -> None:
        self._bytes += size
        self._patience.held_bytes += size


class RawService(RawSource):
    """A service or a service client.

    A take may return nothing although more are available: replies to other clients of the service arrive here as well,
    and ROS 2 skips them one by one. The number of takes is therefore the number of notifications.
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
        assert isinstance(self._bell, PlainBell), "the default"
        self._drain = self._bell.drain
        self._compared = False
        self._types = ros.types
        self._take = take
        self._reported = 0
        self._info = ServiceInfo()
        self._ignored = RawMessage()
        self._arguments = (self._pointer, byref(self._info), byref(self._ignored))

    def _take_next(self) -> bytes | None:
        while self._descriptor >= 0:
            if not self._reported:
                self._reported = self._drain()
            if not self._reported:
                return None
            self._reported -= 1
            result = self._take(*self._arguments)
            if result == OK:
                self._compare()
                return self._types.taken()
            if result not in (SERVICE_TAKE_FAILED, CLIENT_TAKE_FAILED):
                raise self.failed("take")
        return None

    def unread(self) -> int:
        """See Source."""
        if self._descriptor >= 0:
            self._reported += self._bell.arrived()
        return self._reported

    def _compare(self) -> None:
        """Compare types on the first message, because ROS 2 has no events for matched services."""
        if not self._compared:
            self._compared = True
            for endpoint in self._endpoints:
                self._events.compare(endpoint)

    def check_alive(self) -> None:
        """Raise BridgeError if it was destroyed."""
        if self._descriptor < 0:
            raise BridgeError(f"{self.label} is gone")


class _Reach:
    """Which clients in the graph ROS 2 has reached, and how long each of those that it did not is left alone."""

    def __init__(self) -> None:
        self._until: dict[bytes, tuple[float, float]] = {}
        self._reached: set[bytes] = set()

    def missed(self, guid: bytes, now: float) -> None:
        """Leave a client alone for a while, each time twice as long."""
        self._reached.discard(guid)
        _, pause_s = self._until.pop(guid, (0.0, DEAF_S / 2))
        pause_s = min(2 * pause_s, LONGEST_DEAF_S)
        self._until[guid] = now + pause_s, pause_s
        if len(self._until) > DEAF_CLIENTS:
            del self._until[next(iter(self._until))]

    def rests(self, guid: bytes, now: float) -> bool:
        """Return whether a client is left alone."""
        return guid in self._until and now < self._until[guid][0]

    def reached(self, guid: bytes, clients: set[bytes]) -> None:
        """Note that one of the clients in the graph is matched."""
        if guid in self._reached:
            return
        self._until.pop(guid, None)
        if len(self._reached) >= 2 * len(clients):
            self._reached &= clients
        self._reached.add(guid)

    def is_known(self, guid: bytes) -> bool:
        """Return whether the last reply to a client reached it, so that the next one does not block."""
        return guid in self._reached

    def pause_of(self, guid: bytes) -> float:
        """Return the seconds for which a client was left alone last: clients with shorter ones are tried first."""
        return self._until[guid][1] if guid in self._until else 0.0


class RawReplier(RawService):
    """See Replier.

    For a client that it has not discovered, ROS 2 would block the agent for 100 ms. It therefore gets only replies to
    clients in the graph; other replies wait until their client appears. The graph has a client some time before ROS 2
    has matched it: a reply in between waits, too.
    """

    def __init__(
        self, handle: Any, ros: Ros, patience: Patience, events: Events, endpoints: tuple[Endpoint, ...]
    ) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_service, libraries.take_request, events, endpoints)
        self._report = ros.report
        self._patience = patience
        self._held = Held(patience)
        self._lost = 0
        self._reach = _Reach()
        self._waiting: set[bytes] = set()
        """Clients with replies in `_held`; later ones are sent after these."""

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
        self.check_alive()
        raw_message(serialized)
        now, guid = time.monotonic(), identity[:_GUID_BYTES]
        if guid not in self._waiting and self._send(identity, serialized, self._clients(), now):
            return
        if self._held.put(now + WAIT_FOR_CLIENT_S, identity, serialized):
            self._waiting.add(guid)
            self._patience.wait_for(self)
        else:
            self._lose()

    def still_waits(self) -> bool:
        """See Waiter."""
        if self._descriptor < 0:
            return False
        clients, now = self._clients(), time.monotonic()
        calls = self._held.pop_all()
        order = sorted(
            range(len(calls)), key=lambda place: self._reach.pause_of(calls[place][1][:_GUID_BYTES])
        )
        sent = {place for place in order if self._send_held(*calls[place][1:], clients, now)}
        self._waiting.clear()
        for place, (until, identity, serialized) in enumerate(calls):
            if place in sent:
                continue
            if until < now:
                self._lose()
            else:
                self._held.put(until, identity, serialized)
                self._waiting.add(identity[:_GUID_BYTES])
        return bool(self._held)

    def _leave(self) -> None:
        self._held.pop_all()
        super()._leave()

    def _clients(self) -> set[bytes]:
        return self._events.readers(self._endpoints[1], _GUID_BYTES)

    def _send_held(self, identity: bytes, serialized: bytes, clients: set[bytes], now: float) -> bool:
        try:
            return self._send(identity, serialized, clients, now)
        except BridgeError:
            self._lose()
            return True

    def _send(self, identity: bytes, serialized: bytes, clients: set[bytes], now: float) -> bool:
        """Send a reply if its client can be reached; return whether that is so."""
        guid = identity[:_GUID_BYTES]
        if guid not in clients or self._reach.rests(guid, now):
            return False
        began = time.monotonic()
        if not self._reach.is_known(guid) and began < self._patience.may_block_at:
            return False
        high, low = _NUMBER.unpack_from(identity, _GUID_BYTES)
        request = RequestId(number=high << 32 | low)
        request.guid[:] = guid
        result = self._libraries.send_response(self._pointer, byref(request), byref(raw_message(serialized)))
        if result == TIMEOUT:
            ended = time.monotonic()
            self._patience.may_block_at = ended + BLOCKED_PAUSE * (ended - began)
            self._reach.missed(guid, ended)
            self._libraries.error()  # clear the error, which says less
            return False
        if result != OK:
            raise self.failed("reply")
        self._reach.reached(guid, clients)
        return True

    def _lose(self) -> None:
        self._lost += 1
        self._report(NoClient(self._endpoints[0].node, self.label, self._lost))


def raw_message(serialized: bytes) -> RawMessage:
    """Return a message that borrows `serialized`, which the caller keeps while it is used."""
    if len(serialized) < ENCAPSULATION_BYTES:
        raise BridgeError(f"a message of {len(serialized)} bytes has no encapsulation", Status.INVALID_DATA)
    return RawMessage(ctypes.cast(c_char_p(serialized), c_void_p), len(serialized))
