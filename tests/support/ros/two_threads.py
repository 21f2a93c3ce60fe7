# SPDX-License-Identifier: Apache-2.0
"""Threads with a peer each, as in an agent that holds parameters: one calls its own service, one creates endpoints.

    python -m tests.support.ros.two_threads SECONDS

Prints how often each did so, or ends with 1 and the stack of each thread if they wait for each other.
"""

from __future__ import annotations

import faulthandler
import sys
import threading
import time
from typing import Any

from microros_gen.ros.peer import Peer

SERVICE, TYPE = "/values", "rcl_interfaces/srv/GetParameters"


def _answer(request: dict[str, Any]) -> dict[str, Any]:
    return {"values": [{"type": 4, "string_value": name} for name in request["names"]]}


class Caller:
    """A thread that calls its own service with names that no other caller uses."""

    def __init__(self, number: int, stop: threading.Event) -> None:
        self.calls = 0
        self.wrong: list[object] = []
        self._number = number
        self._stop = stop
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def join(self) -> None:
        self._thread.join()

    def _run(self) -> None:
        with Peer(f"caller{self._number}") as peer:
            peer.serve(f"{SERVICE}{self._number}", TYPE, _answer)
            client = peer.client(f"{SERVICE}{self._number}", TYPE)
            while not self._stop.is_set():
                names = [f"{self._number} {self.calls} {i}" for i in range(50)]
                response = client.call({"names": names}, 5.0)
                if response is not None and [v["string_value"] for v in response["values"]] != names:
                    self.wrong.append(response)
                self.calls += 1


def main() -> None:
    duration_s = float(sys.argv[1])
    faulthandler.dump_traceback_later(30 * (1 + duration_s), exit=True)
    sys.setswitchinterval(1e-5)
    stop = threading.Event()
    callers = [Caller(number, stop) for number in range(2)]
    created = 0
    with Peer("creator") as peer:
        end = time.monotonic() + duration_s
        while time.monotonic() < end:
            clients = [peer.client(f"{SERVICE}{number}", TYPE) for number in range(2)]
            peer.spin_once(0.001)
            for client in clients:
                peer.remove(client)
            created += 1
    stop.set()
    for caller in callers:
        caller.join()
    print(created, *(caller.calls for caller in callers), *(len(caller.wrong) for caller in callers))


if __name__ == "__main__":
    main()
