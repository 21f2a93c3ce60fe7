# SPDX-License-Identifier: Apache-2.0
"""The agent with fakes after real transports, its loop in a thread of this process."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from microros_gen.agent.server import Server
from microros_gen.agent.transport.base import Transport
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.fakes import Bench
from tests.support.patience import deadline

INT32 = "std_msgs/msg/Int32"


class Served:
    """Runs the loop from `with` to its end."""

    def __init__(self, *transports: Transport, bench: Bench) -> None:
        self.bench = bench
        self.ready: list[str] = []
        self.server = Server(bench.agent, transports, bench.log)
        self._thread = threading.Thread(target=self._run)

    def _run(self) -> None:
        self.server.run(lambda transport: self.ready.append(transport.label), time.monotonic)

    def __enter__(self) -> Served:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.server.stop()
        self._thread.join()

    def count(self, kind: str) -> int:
        """Return how often a fault was counted."""
        return self.bench.log.counters[kind]

    def publish(self, client: XrceClient, values: range) -> None:
        """Connect, create a publisher, send reliably, and see that everything arrived in order."""
        assert client.connect() == 0
        writer = client.publisher("node", "count", INT32, 0)
        before = len(self.bench.bridge.published)
        for value in values:
            client.write(writer, int32_body(value))
        client.drain()
        received = [data[4:] for _, data in self.bench.bridge.published[before:]]
        assert received == [int32_body(value) for value in values]


def wait_until(done: Callable[[], bool], what: str, timeout_s: float = 15.0) -> None:
    """Return when `done` is true."""
    end = deadline(timeout_s)
    while not done():
        assert time.monotonic() < end, what
        time.sleep(0.005)
