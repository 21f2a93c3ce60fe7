# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run` with an image for a board: QEMU, the agent of this project, and rclpy."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.e2e.programs import check_count
from tests.support.firmware.board import Builds, board, build, need, report
from tests.support.firmware.line import Relay, noisy
from tests.support.firmware.running import BOARD, program, started
from tests.support.patience import seconds


def children(process: subprocess.Popen[str]) -> dict[str, int]:
    """Return the processes that `process` started: `agent` or `qemu-system-arm` → number."""
    task = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    found = {}
    for number in map(int, task):
        words = Path(f"/proc/{number}/cmdline").read_bytes().decode().split("\0")
        found["agent" if "agent" in words else Path(words[0]).name] = number
    return found


def is_alive(number: int) -> bool:
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return True


ROOMY = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\npools: {history: 16}\n"
"""An agent on a busy machine may be silent for longer than four samples take."""
PATIENT = (
    "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
    "session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}\n"
)
"""And for longer than a session lasts by default, or a creation may take."""


@pytest.mark.system
@pytest.mark.ros
def test_rclpy_hears_the_board_after_its_agent_was_replaced(
    builds: Builds, observer: Observer, domain: int
) -> None:
    built = builds.merged(BOARD, ROOMY)
    need(BOARD, emulator=True)
    observer.subscribe("/int32", "std_msgs/msg/Int32", reliable=True)
    with started("run", str(built.out), "--domain", str(domain), domain=domain) as run:
        device = run.wait_for("emulator ready: serial ").split()[3]
        run.wait_for(f"agent ready: serial {device}")
        first = [sample["data"] for _, sample in observer.got(5, 30)]
        parts = children(run.process)
        os.kill(parts["agent"], signal.SIGKILL)
        with started("agent", "serial", "--dev", device, "--domain", str(domain), domain=domain) as other:
            other.wait_for("agent ready")
            other.wait_for("connected")
            second = [sample["data"] for _, sample in observer.got(5, 30)]
            assert run.process.poll() is None
        assert run.stop(signal.SIGINT) == 0
    assert first == list(range(first[0], first[0] + len(first)))
    check_count(second)
    assert second[-1] > first[-1]
    assert not is_alive(parts["qemu-system-arm"])


@pytest.mark.system
@pytest.mark.ros
def test_over_a_bad_line_rclpy_gets_every_reliable_sample_and_the_agent_says_what_was_lost(
    builds: Builds, observer: Observer, domain: int
) -> None:
    built = builds.merged(BOARD, PATIENT)
    image = builds.application(built, "counter.c", "-DCOUNTER_LAST=200", "-DCOUNTER_PERIOD_MS=20u")
    observer.subscribe("/count", "std_msgs/msg/Int32", reliable=True)
    with (
        board(built, image) as running,
        Relay(running.device) as relay,
        started("agent", "serial", "--dev", relay.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        observer.ask(do="samples")  # of another test's board
        running.go_on()
        agent.wait_for("publisher /count")
        relay.fault = noisy(11, 400)
        samples = values_until(observer, 200)
        running.wait_for(lambda: running.words("counter_report")[0], 30)
        statistics = report(running)
        agent.stop()
        output = agent.wait_for("faults of input")
    assert samples[0] < 150  # DDS gives nothing of before the subscription was found
    assert samples == list(range(samples[0], 201))
    assert relay.lost > 0
    assert relay.spoiled > 0
    assert int(output.split(" faults of input")[0].rpartition(" ")[2]) > 0
    assert statistics["resent"] > 0
    assert statistics["reconnects"] == 0


def values_until(observer: Observer, last: int) -> list[int]:
    """Return what arrives, up to the value `last`."""
    found: list[int] = []
    while last not in found:
        found += [value["data"] for _, value in observer.got(1, 30)]
    return found


def test_without_an_agent_it_prints_how_to_start_one(builds: Builds) -> None:
    built = builds.build(BOARD)
    need(BOARD, emulator=True)
    with started("run", str(built.out), "--no-agent") as run:
        device = run.wait_for("emulator ready: serial ").split()[3]
        assert f"microros-gen agent serial --dev {device} --baud 115200" in run.wait_for("its agent: ")
        time.sleep(0.2)
        parts = children(run.process)
        assert list(parts) == ["qemu-system-arm"]
        assert run.stop() == 0
    assert not is_alive(parts["qemu-system-arm"])


def test_a_missing_emulator_is_named_with_its_package(builds: Builds, tmp_path: Path) -> None:
    built = builds.build(BOARD)
    env = {**os.environ, "PATH": str(tmp_path)}
    done = subprocess.run(
        program("run", str(built.out)), env=env, text=True, capture_output=True, check=False
    )
    assert done.returncode == 2
    assert "the image runs in qemu-system-arm, which is not on the PATH" in done.stderr
    assert "apt-get install qemu-system-arm" in done.stderr


@pytest.mark.ros
def test_an_agent_that_cannot_start_ends_the_run(builds: Builds, tmp_path: Path) -> None:
    built = builds.build(BOARD)
    need(BOARD, emulator=True)
    (tmp_path / "rclpy.py").write_text("raise ImportError('none here')\n")
    env = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        program("run", str(built.out)),
        env=env,
        text=True,
        capture_output=True,
        check=False,
        timeout=seconds(30),
    )
    assert done.returncode == 1
    assert "the agent did not start" in done.stderr


@pytest.mark.system
def test_a_library_alone_does_not_run(tmp_path: Path) -> None:
    need("cortex-m3")
    assert build(tmp_path, "cortex-m3").returncode == 0
    done = subprocess.run(program("run", str(tmp_path / "out")), text=True, capture_output=True, check=False)
    assert done.returncode == 2
    assert "contains only a library: target cortex-m3 has no image" in done.stderr
