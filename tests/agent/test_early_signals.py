# SPDX-License-Identifier: Apache-2.0
"""Signals while the agent starts: nothing is lost, and it ends with its status and without a traceback."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.agent.process import UDP, environment, own_domain, running_agent
from tests.support.patience import deadline, seconds
from tests.support.slices import first

pytestmark = [pytest.mark.ros, pytest.mark.system]

POLICY = "version: 1\nclients:\n  - {name: some, keys: [0x2], publish: [/a]}\n"
PROGRAM = """\
import os, signal
signal.signal(signal.SIGHUP, signal.SIG_DFL)
from microros_gen.cli.agent import {module}

def signaled(*given, original={module}.{function}, **named):
    os.kill(os.getpid(), signal.{signal})
    return original(*given, **named)

{module}.{function} = signaled
from microros_gen.cli.main import main
main()
"""
"""The agent, which gets a signal when it calls a function. The tests may run where a hang-up is ignored (nohup)."""
PLACES = [
    ("start", "read_files", "1"),
    ("start", "open_bridge", "1"),
    ("start", "client_state_node", "1"),
    ("start", "read_files", "2"),
    ("workers", "open_transports", "2"),
    ("workers", "client_state_node", "2"),
]


def program(module: str, function: str, number: str) -> list[str]:
    text = PROGRAM.format(module=module, function=function, signal=number)
    return [sys.executable, "-c", text, "agent"]


@pytest.fixture
def policy(tmp_path: Path) -> str:
    path = tmp_path / "policy.yaml"
    path.write_text(POLICY)
    return str(path)


@pytest.mark.parametrize(("module", "function", "workers"), PLACES)
def test_a_reload_during_the_start_is_done_when_the_agent_serves(
    policy: str, module: str, function: str, workers: str
) -> None:
    options = ("--policy", policy, "--workers", workers)
    with running_agent(own_domain(), *options, program=program(module, function, "SIGHUP")) as agent:
        while sum("policy: 1 rules" in line for line in agent.log) < 2:
            agent.wait_for("policy: 1 rules")
        assert agent.stop() == 0


@pytest.mark.parametrize("number", first(["SIGTERM", "SIGINT"]))
@pytest.mark.parametrize(("module", "function", "workers"), PLACES)
def test_a_stop_during_the_start_ends_the_agent_in_order(
    policy: str, tmp_path: Path, module: str, function: str, workers: str, number: str
) -> None:
    """What was recorded before stays, and nobody is told that the agent is ready."""
    recording = tmp_path / "a.pcapng"
    recording.write_bytes(b"an earlier one")
    options = ("--policy", policy, "--workers", workers, "--record", str(recording))
    done = subprocess.run(
        [*program(module, function, number), *UDP, *options],
        env=environment(own_domain()),
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(40),
    )
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    assert "Traceback" not in done.stderr
    assert recording.read_bytes() == b"an earlier one"


def test_without_files_to_read_again_a_hangup_ends_the_start_as_it_did() -> None:
    done = subprocess.run(
        [*program("start", "read_files", "SIGHUP"), *UDP],
        env=environment(own_domain()),
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(40),
    )
    assert done.returncode == -signal.SIGHUP, done.stderr


def test_a_second_signal_ends_a_start_that_hangs() -> None:
    text = PROGRAM.format(module="start", function="read_files", signal="SIGTERM")
    hangs = text.replace(
        "    return original", "    os.kill(os.getpid(), signal.SIGTERM)\n    return original"
    )
    done = subprocess.run(
        [sys.executable, "-c", hangs, "agent", *UDP],
        env=environment(own_domain()),
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(40),
    )
    assert (done.returncode, done.stdout) == (-signal.SIGTERM, "")


def children(pid: int) -> list[int]:
    """Return the workers of an agent; a thread that starts others may be any."""
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def test_signals_for_all_processes_of_a_service_do_not_end_workers_that_start() -> None:
    """A service manager sends SIGTERM to each; only the first process decides what it means."""
    process = subprocess.Popen(
        [sys.executable, "-m", "microros_gen", "agent", *UDP, "--workers", "2", "--status-socket", "none"],
        env=environment(own_domain()),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    with process:
        end = deadline(20)
        while len(found := children(process.pid)) < 2:
            assert time.monotonic() < end
            time.sleep(0.001)
        for worker in found:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                os.kill(worker, number)
        assert process.stdout is not None
        lines = []
        for line in process.stdout:
            lines.append(line)
            if "agent ready" in line:
                assert children(process.pid) == found
                process.send_signal(signal.SIGTERM)
    assert process.returncode == 0, "".join(lines)
    assert not any("worker_ended" in line or "started again" in line for line in lines)
    assert any("agent ready" in line for line in lines)
