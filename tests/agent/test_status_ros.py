# SPDX-License-Identifier: Apache-2.0
"""`agent status` of agents in processes: two at a time, loss, reconnects, a killed one and its socket."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from microros_gen.agent.monitoring.asking import NoAnswerError, ask_status
from microros_gen.agent.monitoring.document import PATH
from tests.support.agent.client import BEST_EFFORT, XrceClient, int32_body
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.e2e.relay import Relay, lossy
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of sockets that only these agents use."""
    with tempfile.TemporaryDirectory() as session:
        monkeypatch.setenv("XDG_RUNTIME_DIR", session)
        monkeypatch.delenv("RUNTIME_DIRECTORY", raising=False)
        yield Path(session) / "microros-gen"


def status(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "microros_gen", "agent", "status", *arguments]
    return subprocess.run(command, text=True, capture_output=True, check=False, timeout=seconds(60))


def until(socket: Path, seen: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
    """Ask until the only client is as it should be; return it."""
    end = deadline(5)
    while True:
        clients: list[dict[str, Any]] = ask_status(socket, PATH)["clients"]
        if clients and seen(clients[0]):
            return clients[0]
        assert time.monotonic() < end, json.dumps(clients)
        time.sleep(0.1)


def test_two_agents_of_which_one_is_killed(folder: Path) -> None:
    domain = own_domain()
    with ExitStack() as stack:
        killed = stack.enter_context(running_agent(domain))
        assert json.loads(status("--format", "json").stdout)["agent"]["pid"] == killed.process.pid
        other = stack.enter_context(running_agent(domain))
        refused = status()
        assert refused.returncode == 2
        assert "[MG-9784]" in refused.stderr
        pid = str(other.process.pid)
        assert f"agent {pid} " in status("--pid", pid).stdout
        killed.process.kill()
        killed.process.wait()
        stale = folder / f"microros-agent-{killed.process.pid}.sock"
        assert stale.exists()
        shown = status()
        assert shown.stdout.startswith(f"agent {pid} "), shown.stderr
        assert not stale.exists()
        stale.touch()  # no socket, so it is left alone
        assert other.stop() == 0
        assert sorted(folder.iterdir()) == [stale]


def test_a_client_over_a_bad_network_that_reconnects(folder: Path) -> None:
    domain = own_domain()
    with ExitStack() as stack:
        agent = stack.enter_context(running_agent(domain))
        relay = stack.enter_context(Relay())
        relay.connect(agent.port)
        socket = folder / f"microros-agent-{agent.process.pid}.sock"
        client = stack.enter_context(XrceClient(relay.port))
        assert client.connect() == 0
        writer = client.publisher("seen", "seen", INT32, domain)
        known = until(socket, lambda c: c["nodes"] == ["/seen"])
        assert (known["key"], known["state"], known["name"], known["lost"]) == (
            "A1B2C3D4",
            "connected",
            "/seen",
            0,
        )
        assert known["round_trip_s"] > 0
        relay.fault = lossy(1)
        for value in range(200):
            client.write(writer, int32_body(value), BEST_EFFORT)
            time.sleep(0.001)
        relay.fault = lambda: [0.0]
        client.write(writer, int32_body(1), BEST_EFFORT)
        lossy_one = until(socket, lambda c: c["lost"] > 20)
        assert lossy_one["received"]["bytes"] > known["received"]["bytes"] + 100 * 16
        assert client.connect() == 0
        again = until(socket, lambda c: c["reconnects"] == 1)
        for key in ("messages", "bytes"):
            assert again["received"][key] >= lossy_one["received"][key]
        assert again["lost"] >= lossy_one["lost"]
        client.leave()
        assert until(socket, lambda c: c["state"] == "gone")["sessions"] == 2


def test_a_stopped_agent_does_not_answer(folder: Path) -> None:
    with running_agent(own_domain(), "--status-socket", f"{folder.parent}/own") as agent:
        own = folder.parent / "own"
        assert ask_status(own, PATH)["agent"]["pid"] == agent.process.pid
        assert not folder.exists()
        os.kill(agent.process.pid, signal.SIGSTOP)
        with pytest.raises(NoAnswerError):
            ask_status(own, PATH, 0.5)
        os.kill(agent.process.pid, signal.SIGCONT)
        assert ask_status(own, PATH)["version"] == 1


def test_no_socket(folder: Path) -> None:
    with running_agent(own_domain(), "--status-socket", "none") as agent:
        assert not folder.exists()
        assert agent.stop() == 0


def test_a_socket_that_cannot_be_made(folder: Path) -> None:
    place = str(folder / "missing" / "s")
    command = [
        *(sys.executable, "-m", "microros_gen", "agent", "udp4"),
        "--port",
        "0",
        "--status-socket",
        place,
    ]
    run = subprocess.run(command, text=True, capture_output=True, check=False, timeout=seconds(60))
    assert run.returncode == 2
    assert f"the status socket {place} cannot be made: No such file or directory" in run.stderr
    assert "[MG-9788]" in run.stderr


def test_without_a_folder_the_agent_runs_on(folder: Path) -> None:
    folder.write_text("a file where the folder should be")
    with running_agent(own_domain()) as agent:
        assert agent.stop() == 0
        agent.wait_for("agent stopped")
        assert any("no status socket: " in line for line in agent.log)
