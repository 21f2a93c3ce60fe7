# SPDX-License-Identifier: Apache-2.0
"""A fake agent after a UDP port."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable

from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.ports import bind, stop

AGENT_TIME = 20.0


class UdpAgent(threading.Thread):
    """Answers on a separate socket until it is stopped."""

    def __init__(self, host: str = "127.0.0.1") -> None:
        super().__init__(daemon=True)
        self.agent = FakeAgent()
        self.socket = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_DGRAM)
        self.port = bind(self.socket, host)
        self.socket.settimeout(AGENT_TIME)
        self.before: Callable[[int], None] = lambda count: None

    def run(self) -> None:
        count = 0
        while True:
            try:
                datagram, peer = self.socket.recvfrom(2048)
            except OSError:
                return
            if not datagram:
                return
            count += 1
            self.before(count)
            for answer in self.agent.receive(datagram):
                self.socket.sendto(answer, peer)

    def stop(self) -> None:
        stop(self.socket)
