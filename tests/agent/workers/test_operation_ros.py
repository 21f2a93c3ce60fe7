# SPDX-License-Identifier: Apache-2.0
"""What watches an agent with workers: metrics, page, `status --watch`, log, service manager, and the ROS package."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.process import own_domain
from tests.support.agent.ros_client import INT32
from tests.support.agent.worker_agents import running
from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]
SAMPLES = "microros_agent_samples_from_clients_total"


def metrics(address: str) -> dict[str, float]:
    """Return the value of each series; each is there once."""
    with urllib.request.urlopen(address, timeout=seconds(10)) as answer:
        lines = [line for line in answer.read().decode().splitlines() if not line.startswith("#")]
    found = {name: float(value) for name, _, value in (line.rpartition(" ") for line in lines)}
    assert len(found) == len(lines)
    return found


def published(client: XrceClient, count: int) -> None:
    """Open a session, and publish."""
    assert client.connect() == 0
    name = f"watched{client.key[3]}"
    writer = client.publisher(name, name, INT32, own_domain())
    for value in range(count):
        client.write(writer, int32_body(value))
    client.drain()


def test_counters_are_sums_that_never_go_back() -> None:
    """Also while a worker is killed, and the samples of the process before it still count."""
    with running("--metrics", "0", "--page", "0") as agent, ExitStack() as stack:
        address, page = agent.logged("metrics: "), agent.logged("page: ")
        first, second = (stack.enter_context(XrceClient(agent.port, key=key)) for key in (2, 3))
        published(first, 30)
        published(second, 20)
        agent.until(lambda status: status["agent"]["samples"]["from_clients"] == 50)
        seen = metrics(address)
        assert (seen[SAMPLES], seen["microros_agent_clients_limit"]) == (50, 512)
        assert seen['microros_agent_clients{state="connected"}'] == 2
        os.kill(agent.pid(1), signal.SIGKILL)
        end = deadline(20)
        while seen['microros_agent_worker_restarts_total{worker="1"}'] == 0 or not is_ready(seen):
            assert time.monotonic() < end
            seen = metrics(address)
            assert seen[SAMPLES] == 50
        published(first, 5)
        agent.until(lambda status: status["agent"]["samples"]["from_clients"] == 55)
        assert metrics(address)[SAMPLES] == 55
        with urllib.request.urlopen(f"{page}status.json", timeout=seconds(10)) as answer:
            document = json.load(answer)
        assert [each["restarts"] for each in document["agent"]["workers"]] == [1, 0]
        assert {each["key"]: each["worker"] for each in document["clients"]} == {"00000002": 1, "00000003": 2}
        assert agent.agent.stop() == 0
        assert "agent stopped: 55 samples in" in agent.agent.rest()[-1]


def is_ready(seen: dict[str, float]) -> bool:
    return all(seen[f'microros_agent_worker_ready{{worker="{number}"}}'] == 1 for number in (1, 2))


def test_status_watch_follows_a_worker_that_starts_again() -> None:
    with running() as agent:
        command = [sys.executable, "-m", "microros_gen", "agent", "status", "--watch", "--format", "json"]
        with subprocess.Popen(
            [*command, "--socket", str(agent.place)], stdout=subprocess.PIPE, text=True
        ) as watch:
            assert watch.stdout is not None
            before = json.loads(watch.stdout.readline())["agent"]["workers"][0]
            os.kill(before["pid"], signal.SIGKILL)
            workers = (json.loads(line)["agent"]["workers"] for line in watch.stdout)
            after = next(found[0] for found in workers if found[0]["restarts"] == 1 and found[0]["ready"])
            assert after["pid"] != before["pid"]
            watch.send_signal(signal.SIGTERM)
        assert watch.returncode == 0


def test_each_line_of_the_log_is_whole_and_names_its_worker() -> None:
    """All processes write to one stream; a program reads each line as JSON."""
    with running("--log-format", "json", "-vv") as agent, ExitStack() as stack:
        for key in range(2, 8):
            published(stack.enter_context(XrceClient(agent.port, key=key)), 200)
        assert agent.agent.stop() == 0
        lines = [json.loads(line) for line in agent.agent.rest()]
    by_worker = {line["worker"] for line in lines if line["event"] == "client_connected"}
    assert by_worker == {1, 2}
    stopped = [line for line in lines if line["event"] == "stopped"]
    (whole,) = (line for line in stopped if "worker" not in line)
    assert whole["samples"] == sum(line["samples"] for line in stopped if "worker" in line) == 1200


def test_only_the_first_process_reports_to_a_service_manager(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It reloads an agent that has nothing to reload, and ends it with a signal for all processes of the service."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(str(tmp_path / "notify"))
        manager.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
        manager.settimeout(seconds(10))
        monkeypatch.setenv("NOTIFY_SOCKET", str(tmp_path / "notify"))
        monkeypatch.setenv("WATCHDOG_USEC", "400000")
        with running() as agent:
            workers = [agent.pid(1), agent.pid(2)]
            agent.agent.process.send_signal(signal.SIGHUP)
            for expected in [b"READY=1", *[b"WATCHDOG=1"] * 5]:
                data, ancillary, _, _ = manager.recvmsg(100, 100)
                assert data == expected
                assert int.from_bytes(ancillary[0][2][:4], sys.byteorder) == agent.agent.process.pid
            assert [agent.pid(1), agent.pid(2)] == workers
            for pid in workers:
                os.kill(pid, signal.SIGTERM)
            assert agent.agent.stop() == 0
            assert not any("worker_stuck" in line or "ended (" in line for line in agent.agent.rest())


def test_the_program_of_the_ros_package_starts_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a launch file starts it, with ROS arguments behind; its end is that of all its processes."""
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}:{os.environ['PATH']}")
    program = ROOT / "cmake/ament/microros_gen_agent/programs/agent"
    with running("--ros-args", "-r", "__node:=agent", program=[str(program)]) as agent:
        workers = [agent.pid(1), agent.pid(2)]
        with XrceClient(agent.port, key=3) as client:
            published(client, 10)
        assert agent.agent.stop(signal.SIGINT) == 0
        assert [pid for pid in workers if Path(f"/proc/{pid}").exists()] == []
