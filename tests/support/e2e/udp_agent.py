# SPDX-License-Identifier: Apache-2.0
"""The agent of tests/runtime, which can be told to refuse and to fall silent, after a UDP port."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from tests.support.runtime.fake_agent import FakeAgent


@contextmanager
def serving(agent: FakeAgent, number: int = 0) -> Iterator[int]:
    """Serve one client at a time, at a UDP port or any; gives the port."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as port:
        port.bind(("127.0.0.1", number))
        port.settimeout(0.05)
        ends = threading.Event()
        thread = threading.Thread(target=_serve, args=(agent, port, ends), daemon=True)
        thread.start()
        try:
            yield port.getsockname()[1]
        finally:
            ends.set()
            thread.join(10)


def _serve(agent: FakeAgent, port: socket.socket, ends: threading.Event) -> None:
    while not ends.is_set():
        try:
            data, client = port.recvfrom(65535)
        except OSError:
            continue  # a pause, or the news that the client is gone
        for answer in agent.receive(data):
            port.sendto(answer, client)
