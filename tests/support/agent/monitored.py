# SPDX-License-Identifier: Apache-2.0
"""An agent without sockets and ROS, whose status is asked for in other threads."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from microros_gen.agent.monitoring.status import AgentStatus, StatusBoard, TransportState
from microros_gen.agent.output_queue import Queue
from microros_gen.agent.states import ClientState, Presence
from microros_gen.agent.traffic import Direction

CLIENT = ClientState(
    *("A1B2C3D4", Presence.CONNECTED, "udp4 127.0.0.1:8888", "127.0.0.1:40312", ("/arm",), 0.25, 3, 2, 1),
    *(0.0015, 2, 3, "late"),
    received=Direction(1000, 64_000, 99.96, 6_400.0),
    sent=Direction(500, 8_000, 0.0, 0.0),
    repeated=4,
    queue=Queue(8, 512, 0.5),
    input_bytes=100,
)
STATUS = AgentStatus(
    pid=77,
    version="1.2.3",
    core="python",
    started=1_700_000_000.0,
    now=1_700_000_090.5,
    uptime_s=90.5,
    domain=None,
    transports=(
        TransportState("udp4", "127.0.0.1:8888", True),
        TransportState("serial", "/dev/ttyUSB0", False),
    ),
    clients_max=256,
    from_clients=900,
    to_clients=400,
    clients=(CLIENT,),
    faults={"truncated": 3, "no_session": 1},
)


def many(count: int) -> AgentStatus:
    """Return the status of an agent with many clients."""
    clients = tuple(replace(CLIENT, key=f"{i:08X}", nodes=(f"/robot_{i}/arm",)) for i in range(count))
    return replace(STATUS, clients=clients)


class Loop:
    """The thread of an agent, which can be stopped for a while."""

    def __init__(self, status: AgentStatus) -> None:
        self.status = status
        self.taken = 0
        self.board = StatusBoard(self._take)
        self.runs = threading.Event()
        self.runs.set()
        self._ended = threading.Event()

    def _take(self) -> AgentStatus:
        self.taken += 1
        return self.status

    def run(self) -> None:
        while not self._ended.wait(0.01):
            if self.runs.is_set():
                self.board.look(0.0)

    def stop(self) -> None:
        self._ended.set()


@contextmanager
def running(status: AgentStatus = STATUS) -> Iterator[Loop]:
    """Run such a thread within the context."""
    loop = Loop(status)
    thread = threading.Thread(target=loop.run)
    thread.start()
    try:
        yield loop
    finally:
        loop.stop()
        thread.join()
