# SPDX-License-Identifier: Apache-2.0
"""An agent with two workers, for tests, and its status."""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from microros_gen.agent.monitoring.asking import ask_status
from microros_gen.agent.monitoring.document import PATH
from tests.support.agent.process import AgentProcess, own_domain, running_agent
from tests.support.patience import deadline


class Running:
    """An agent with two workers, and its status."""

    def __init__(self, agent: AgentProcess, place: Path) -> None:
        self.agent = agent
        self.port = agent.port
        self.place = place

    def status(self) -> dict[str, Any]:
        return ask_status(self.place, PATH)

    def until(self, seen: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
        """Ask until the status is as it should be; return it."""
        end = deadline(15)
        while True:
            status = self.status()
            if seen(status):
                return status
            assert time.monotonic() < end, json.dumps(status)
            time.sleep(0.1)

    def client(self, key: str, **wanted: Any) -> dict[str, Any]:
        """Ask until the client with a key has these values; return it."""

        def seen(status: dict[str, Any]) -> bool:
            found = clients(status).get(key, {})
            return bool(found) and all(found[name] == value for name, value in wanted.items())

        return clients(self.until(seen))[key]

    def logged(self, part: str) -> str:
        """Return the last word of the line of the log that contains `part`, whether it was waited for or not."""
        line = next((line for line in self.agent.log if part in line), None) or self.agent.wait_for(part)
        return line.rpartition(" ")[2]

    def pid(self, worker: int) -> int:
        found: int = self.status()["agent"]["workers"][worker - 1]["pid"]
        return found


@contextmanager
def running(*options: str, port: int = 0, program: Sequence[str] = ()) -> Iterator[Running]:
    """Start one; `program` replaces `microros-gen agent`."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "status"
        transport = ("udp4", "--port", str(port))
        more = ("--workers", "2", "--status-socket", str(place), *options)
        with running_agent(own_domain(), *more, transport=transport, program=program) as agent:
            yield Running(agent, place)


def clients(status: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the clients by key; each is there once."""
    found = {client["key"]: client for client in status["clients"]}
    assert len(found) == len(status["clients"])
    return found


def ended(pid: int) -> bool:
    """Return whether a process of another parent has ended, so that it is at most a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(") ")[2][0] == "Z"
    except FileNotFoundError:
        return True
