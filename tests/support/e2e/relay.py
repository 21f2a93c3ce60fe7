# SPDX-License-Identifier: Apache-2.0
"""A UDP relay between images and their agent: it keeps the port that an image was built for, lets the agent
after it come and go, and loses, doubles, delays and cuts datagrams when told to.
"""

from __future__ import annotations

import heapq
import random
import selectors
import socket
import threading
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from types import TracebackType

# Seconds until each copy of a datagram goes on; none: it is lost.
Fault = Callable[[], list[float]]


# What arrives of a datagram.
Cut = Callable[[bytes], bytes]


def no_cut(data: bytes) -> bytes:
    """Leave a datagram whole."""
    return data


def cutting(seed: int, part: float = 0.05) -> Cut:
    """Return a network that loses the end of the part `part` of all datagrams, whatever UDP says of their length.

    What it changed within one, a UDP checksum finds: such a datagram is a lost one.
    """
    chance = random.Random(seed)

    def cut(data: bytes) -> bytes:
        return data[: chance.randrange(1, len(data))] if len(data) > 1 and chance.random() < part else data

    return cut


def no_fault() -> list[float]:
    """Pass each datagram on at once."""
    return [0.0]


def rough(seed: int) -> Fault:
    """Return a bad network: one datagram in six is lost, one in six comes twice, one in four late."""
    chance = random.Random(seed)

    def fault() -> list[float]:
        copies = chance.choice([0, 1, 1, 1, 1, 2])
        return [chance.choice([0.0, 0.0, 0.0, chance.uniform(0.001, 0.04)]) for _ in range(copies)]

    return fault


def lossy(seed: int, loss: float = 0.3) -> Fault:
    """Return a network that loses the part `loss` of all datagrams, doubles one in ten, and overtakes one in five."""
    chance = random.Random(seed)

    def fault() -> list[float]:
        copies = 0 if chance.random() < loss else chance.choice([1] * 9 + [2])
        return [chance.uniform(0.001, 0.03) if chance.random() < 0.2 else 0.0 for _ in range(copies)]

    return fault


@dataclass(order=True)
class _Waiting:
    due: float
    number: int
    send: Callable[[], object] = field(compare=False)


class Relay:
    """Listens on a separate port from the start; used as a context manager."""

    def __init__(self, host: str = "127.0.0.1") -> None:
        """`host`: the loopback address of IPv4, or ::1 of IPv6."""
        self._host = host
        self.largest = 0
        """Bytes of the largest datagram that passed."""
        self.fault: Fault = no_fault
        self.cut: Cut = no_cut
        self.passed = 0
        self.shortened = 0
        self.sent: Counter[int] = Counter()
        """Messages of clients by the id of their first submessage."""
        self.received: Counter[int] = Counter()
        """The same of the agent's messages."""
        self._front = _socket(host)
        self.port: int = self._front.getsockname()[1]
        self._target = 0
        self._backs: dict[tuple[str, int], socket.socket] = {}
        self._waiting: list[_Waiting] = []
        self._lock = threading.Lock()
        self._ends = threading.Event()
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._front, selectors.EVENT_READ, None)
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Relay:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ends.set()
        self._thread.join(10)
        self.connect(0)
        self._selector.close()
        self._front.close()

    def connect(self, port: int) -> None:
        """Serve with the agent at `port` from now on; 0: nobody is there."""
        with self._lock:
            self._target = port
            self.fault, self.cut = no_fault, no_cut
            for back in self._backs.values():
                self._selector.unregister(back)
                back.close()
            self._backs.clear()
            self._waiting.clear()

    def _serve(self) -> None:
        while not self._ends.is_set():
            events = self._selector.select(0.002 if self._waiting else 0.02)
            with self._lock:
                for key, _ in events:
                    if key.fileobj is self._front or key.data in self._backs:
                        self._take(key.fileobj, key.data)  # type: ignore[arg-type]
                self._send_due()

    def _take(self, arrived: socket.socket, client: tuple[str, int] | None) -> None:
        try:
            data, address = arrived.recvfrom(65535)
        except OSError:
            return  # the news that nobody listens there
        self.largest = max(self.largest, len(data))
        if client is not None:
            self.received.update(data[4:5])
            self._pass_on(data, lambda part: self._front.sendto(part, client))
        elif self._target:
            self.sent.update(data[4:5])
            self._pass_on(data, self._back(address).send)

    def _back(self, client: tuple[str, int]) -> socket.socket:
        if client not in self._backs:
            back = _socket(self._host)
            back.connect((self._host, self._target))
            self._backs[client] = back
            self._selector.register(back, selectors.EVENT_READ, client)
        return self._backs[client]

    def _pass_on(self, data: bytes, send: Callable[[bytes], object]) -> None:
        for delay in self.fault():
            part = self.cut(data)
            self.passed += 1
            self.shortened += part != data
            due = time.monotonic() + delay
            heapq.heappush(self._waiting, _Waiting(due, self.passed, partial(send, part)))

    def _send_due(self) -> None:
        while self._waiting and self._waiting[0].due <= time.monotonic():
            try:
                heapq.heappop(self._waiting).send()
            except OSError:
                continue  # lost, as on a network


def _socket(host: str) -> socket.socket:
    opened = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_DGRAM)
    opened.setblocking(False)
    opened.bind((host, 0))
    return opened
