# SPDX-License-Identifier: Apache-2.0
"""Service clients of clients. An XRCE client cannot check whether a service exists, so its requests wait here."""

from __future__ import annotations

import time
from ctypes import byref, c_int64
from typing import Any

from microros_gen.agent.ros.bridge import BridgeError, NoServer, ServerFound
from microros_gen.agent.ros.endpoints import Ros
from microros_gen.agent.ros.graph import Endpoint, Events
from microros_gen.agent.ros.services import Held, Patience, RawService, raw_message
from microros_gen.ros.libraries import OK

SETTLE_S = 0.1
"""Seconds from the discovery of a service to the first request.

A request that is sent before the service has discovered its client, too, is delivered only with the writer's next
heartbeat, 3 s later."""
UNANSWERED = 4_096
"""Maximum number of open requests of a service client; the core abandons them earlier."""


class RawRequester(RawService):
    """See Requester.

    ROS 2 numbers requests when they are sent; here every request has a number, even if it waits or is dropped.
    """

    def __init__(
        self, handle: Any, ros: Ros, patience: Patience, events: Events, endpoints: tuple[Endpoint, ...]
    ) -> None:
        libraries = ros.libraries
        super().__init__(handle, ros, libraries.notify_client, libraries.take_response, events, endpoints)
        self._report = ros.report
        self._patience = patience
        self._wait_s = ros.request_wait_s
        self._available = False
        self._found: float | None = None
        self._look_until = time.monotonic() + self._wait_s
        patience.wait_for(self)
        self._held = Held(patience)
        self._count = 0
        self._numbers: dict[int, int] = {}
        """Requests that were sent and have no reply: ROS 2's number and ours."""
        self._lost = 0
        """Number of requests dropped since the service was last available."""

    def request(self, serialized: bytes) -> int:
        """See Requester."""
        self.check_alive()
        raw_message(serialized)
        number = self._count + 1
        if self.find_server():
            self._send(number, serialized)
        elif self._held.put(time.monotonic() + self._wait_s, number, serialized):
            self._patience.wait_for(self)
        else:
            self._lose("nobody serves it, and too many wait already")
        self._count += 1
        return self._count

    def take(self) -> tuple[int, bytes] | None:
        """See Requester."""
        message = self._take_next()
        return None if message is None else (self._numbers.pop(self._info.request.number, 0), message)

    def find_server(self) -> bool:
        """Return whether the service exists and had time to discover this client; if so, send the waiting requests."""
        if not self._handle.service_server_is_available():
            self._available, self._found = False, None
            return False
        if self._available:
            return True
        now = time.monotonic()
        if self._found is None:
            self._found = now
        if now < self._found + SETTLE_S:
            return False
        self._available = True
        self._report_found()
        while self._held:
            _, number, serialized = self._held.pop()
            self._send_held(number, serialized)
        return True

    def still_waits(self) -> bool:
        """See Waiter. Requests that waited too long are dropped."""
        if self._descriptor < 0 or self.find_server():
            return False
        now = time.monotonic()
        while self._found is None and self._held.over(now):
            self._held.pop()
            self._lose(f"no server within {self._wait_s:g} s")
        return bool(self._held) or now < self._look_until

    def _leave(self) -> None:
        while self._held:
            self._held.pop()
            self._lose("no server until its client left")
        super()._leave()

    def _send_held(self, number: int, serialized: bytes) -> None:
        try:
            self._send(number, serialized)
        except BridgeError as error:
            self._lose(str(error))

    def _send(self, number: int, serialized: bytes) -> None:
        sent = c_int64()
        message = raw_message(serialized)
        if self._libraries.send_request(self._pointer, byref(message), byref(sent)) != OK:
            raise self.failed("request")
        self._numbers[sent.value] = number
        if len(self._numbers) > UNANSWERED:
            del self._numbers[next(iter(self._numbers))]

    def _lose(self, reason: str) -> None:
        self._lost += 1
        self._report(NoServer(self._endpoints[0].node, self.label, reason, self._lost))

    def _report_found(self) -> None:
        if self._lost:
            self._report(ServerFound(self._endpoints[0].node, self.label, self._lost))
            self._lost = 0
