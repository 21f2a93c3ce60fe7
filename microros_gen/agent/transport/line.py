# SPDX-License-Identifier: Apache-2.0
"""A serial line: frames on a descriptor that may disappear and return.

Several clients may share a line: each frame names its source, and the pair of line and source is an address.
"""

from __future__ import annotations

import errno
import os
import select
from collections.abc import Callable, Hashable

from microros_gen.agent.fairness import Account
from microros_gen.agent.framing import LARGEST_PAYLOAD, FrameDecoder, encode_frame
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.transport.outbox import Outbox, is_sample

READ_BYTES = 4_096
"""Bytes that are read before the answers are sent."""
QUEUE_BYTES = 65_536
"""Maximum bytes of output that wait for a slow line; further frames are lost."""
RETRY_S = 0.25
"""Seconds between two attempts to open a missing device."""

Open = Callable[[], int]
"""Function that opens the line and returns a non-blocking descriptor. Raises OSError if it does not exist now."""


class Line:
    """One line; `name` is its path. While its device is missing, the line keeps trying to open it."""

    def __init__(self, name: str, open_line: Open, log: EventLog) -> None:
        self._name = name
        self._open = open_line
        self._log = log
        self._fd = -1
        self._epoll = select.epoll()  # its descriptor stays the same when the line is reopened
        self._retry_at = 0.0
        self._reported = ""
        self._was_open = False
        self._outbox = Outbox(QUEUE_BYTES, self._too_slow)
        self._watches_room = False
        self._decoder = FrameDecoder(self._fault)

    @property
    def label(self) -> str:
        """See Transport."""
        return f"serial {self._name}"

    @property
    def ready(self) -> bool:
        """See Transport."""
        return self._fd >= 0

    @property
    def writing(self) -> bool:
        """Whether output waits for the line."""
        return bool(self._outbox)

    @property
    def forgeable(self) -> bool:
        """See Transport: input can only come from the other end of the line."""
        return False

    def fileno(self) -> int:
        """See Transport."""
        return self._epoll.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        if self._outbox:
            self._write()
        if self._fd < 0:
            return
        try:
            data = os.read(self._fd, READ_BYTES)
        except BlockingIOError:
            return
        except OSError as error:
            self._lose(error.strerror or str(error))
            return
        if not data:
            self._lose("it hung up")
            return
        for source, payload in self._decoder.feed(data):
            receive(payload, (self.label, source), self)

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport: the clients of a shared line are read in the order of their input."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport: likewise."""

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        if self._fd < 0 or not isinstance(address, tuple) or len(data) > LARGEST_PAYLOAD:
            return
        frame = encode_frame(data, address[1])
        waited = bool(self._outbox)
        if not self._outbox.put(frame, is_sample(data)):
            text = "serial {device} accepts no output: messages to it are lost"
            self._log.count("line_full", text, device=self._name)
        elif not waited:
            self._write()

    def start(self) -> None:
        """Open the line before the first tick. Raises OSError if it cannot be opened."""
        try:
            self._fd = self._open()
        except OSError as error:
            self._reported = error.strerror or str(error)
            raise
        self._epoll.register(self._fd, select.EPOLLIN)
        self._watches_room = False
        self._was_open = True

    def wait(self) -> None:
        """Report that the line waits for its device."""
        text = "serial {device} cannot be opened ({why}); waiting for it"
        self._report("device_waiting", text, why=self._reported)

    def tick(self, now: float) -> None:
        """See Transport."""
        if self._fd < 0 and now >= self._retry_at:
            self._retry_at = now + RETRY_S
            self._try()

    def flush(self) -> None:
        """See Transport: nothing is collected."""

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return f"{self._name} client {address[1]}" if isinstance(address, tuple) else str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return self._name

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    def close(self) -> None:
        """See Transport."""
        self._give_back()
        self._epoll.close()

    def _give_back(self) -> None:
        if self._fd >= 0:
            self._epoll.unregister(self._fd)
            os.close(self._fd)
            self._fd = -1

    def _try(self) -> None:
        known, before = self._was_open, self._reported
        try:
            self.start()
        except OSError:
            if self._reported != before:
                self.wait()
            return
        self._reported = ""
        text = "serial {device} is back" if known else "serial {device} is available"
        self._report("device_back", text)

    def _lose(self, why: str) -> None:
        self._give_back()
        self._outbox.clear()
        self._decoder.reset()
        self._reported = os.strerror(errno.ENOENT)  # the ordinary reason needs no separate line
        self._report("device_lost", "serial {device} is gone ({why}); waiting for it", why=why)

    def _report(self, event: str, text: str, **fields: str) -> None:
        self._log.emit(Level.INFO, event, text, device=self._name, **fields)

    def _write(self) -> None:
        try:
            self._outbox.write(self._fd)
        except OSError as error:
            self._lose(error.strerror or str(error))
            return
        if self.writing is not self._watches_room:
            self._watches_room = self.writing
            self._epoll.modify(self._fd, select.EPOLLIN | (select.EPOLLOUT if self.writing else 0))

    def _too_slow(self) -> None:
        text = "serial {device} is slower than the samples for it: the oldest best-effort ones are dropped"
        self._log.count("line_slow", text, device=self._name)

    def _fault(self, kind: str, found: str) -> None:
        self._log.count(kind, "serial {device}: ignored: {found}", device=self._name, found=found)
