# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run` and the demo, as a user starts them."""

from __future__ import annotations

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.process import environment
from tests.support.e2e.images import QUICK, Image, Images, run
from tests.support.e2e.relay import Relay
from tests.support.free_ports import free_port
from tests.support.paths import ROOT
from tests.support.patience import seconds

pytestmark = pytest.mark.system

RUN = [sys.executable, "-m", "microros_gen", "run"]
DECLARED = """\
version: 1
profiles: [pure_sender]
nodes:
  - {name: runner, domain_id: DOMAIN, publishers: [{topic: run, type: std_msgs/msg/Int32}]}
"""


@pytest.fixture(scope="module")
def port() -> int:
    """A port that nobody has at the moment: the agent of `run` has to get it."""
    return free_port()


@pytest.fixture(scope="module")
def image(images: Images, port: int, domain: int) -> Image:
    return images.build(port, DECLARED.replace("DOMAIN", str(domain)), flags=QUICK)


@pytest.fixture(scope="module")
def short_image(images: Images, port: int, domain: int) -> Image:
    return images.build(port, DECLARED.replace("DOMAIN", str(domain)), flags=(*QUICK, "-DEXAMPLE_SAMPLES=5"))


@contextmanager
def running(domain: int, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Run a command in a separate process group, as a shell does; nothing of it remains."""
    process = subprocess.Popen(
        [*RUN, *arguments],
        env=environment(domain),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=seconds(10))


def is_free(port: int) -> bool:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def group_is_gone(leader: int) -> bool:
    try:
        os.killpg(leader, 0)
    except ProcessLookupError:
        return True
    return False


@pytest.mark.ros
@pytest.mark.parametrize("way", ["SIGINT to all", "SIGTERM to run"])
def test_run_ends_with_a_signal(image: Image, port: int, domain: int, way: str) -> None:
    with running(domain, str(image.out)) as process:
        assert process.stderr is not None
        assert any("node /runner" in line for line in iter(process.stderr.readline, "")), "no node"
        if way == "SIGINT to all":  # as a terminal does
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.send_signal(signal.SIGTERM)
        out, rest = process.communicate(timeout=seconds(15))
        assert process.returncode == 0, rest
        assert out == f"agent ready: udp4 127.0.0.1:{port}\n"
        assert "Traceback" not in rest
        assert "agent stopped" in rest
        assert group_is_gone(process.pid)
    assert is_free(port)


@pytest.mark.ros
@pytest.mark.parametrize("delay_s", [0.3, 0.8])
def test_run_ends_with_a_signal_while_it_starts(image: Image, port: int, domain: int, delay_s: float) -> None:
    with running(domain, str(image.out)) as process:
        time.sleep(delay_s)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=seconds(15))
        assert process.returncode in (0, -signal.SIGTERM), errors  # the latter: Python had not begun yet
        assert "Traceback" not in errors
        assert group_is_gone(process.pid)
    assert is_free(port)


@pytest.mark.ros
def test_run_has_the_status_of_the_image(short_image: Image, domain: int) -> None:
    with running(domain, str(short_image.out)) as process:
        _, errors = process.communicate(timeout=seconds(20))
        assert process.returncode == 0, errors
        assert "agent stopped: 5 samples" in errors
    alone = run([*RUN, "--no-agent", str(short_image.out)], env=environment(domain))
    assert alone.returncode == 1
    assert "start: no agent answers at 127.0.0.1:" in alone.stderr


@pytest.mark.ros
def test_run_with_the_port_in_use(profile_image: Image, relay: Relay, domain: int) -> None:
    done = run([*RUN, str(profile_image.out)], env=environment(domain))
    assert done.returncode == 1
    assert f"UDP port {relay.port} is in use" in done.stderr
    assert "the agent did not start" in done.stderr


# The demo, in a copy: its output folder lies two above it

SET_BY_ROS = [
    "/brightness rises to 5.0",
    "set gain to 10.0: accepted",
    "set gain to 1000.0: refused: Parameter {gain} doesn't comply with floating point range.",
    "set color to green: refused: rejected by the callback",
    "/brightness rises to 50.0",
    "/diagnostics reports 1 change",
    "/rosout: gain changes",
    "/rosout: the color green is not available",
]


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    examples = tmp_path_factory.mktemp("demo") / "examples"
    for name in ("demo", "parameters"):
        shutil.copytree(ROOT / "examples" / name, examples / name)
    for name in ("example.h", "processes.py"):
        shutil.copy(ROOT / "examples" / name, examples)
    return examples / "demo"


def run_demo(demo: Path, domain: int, **variables: str) -> subprocess.CompletedProcess[str]:
    settings = {**environment(domain), "XDG_CACHE_HOME": str(demo / "cache"), **variables}
    return run([sys.executable, str(demo / "demo.py")], env=settings)


@pytest.mark.ros
def test_the_demo(demo: Path, domain: int) -> None:
    done = run_demo(demo, domain)
    assert done.returncode == 0, done.stdout + done.stderr
    printed = [line.strip() for line in done.stdout.splitlines()]
    parameters, firmware = (
        next(i for i, line in enumerate(printed) if line.startswith(part))
        for part in ("5. parameters", "6. firmware")
    )
    lines, board = printed[:parameters], printed[firmware:]
    measured = [line for line in lines if line.startswith("received /imu/data  stamp=")]
    counted = [int(line.partition("data=")[2]) for line in lines if line.startswith("received /count")]
    assert len(measured) >= 20
    assert all("frame_id='imu_node'" in line and "linear_acceleration=(" in line for line in measured)
    assert counted == list(range(counted[0], counted[0] + len(counted)))
    (rate,) = (line for line in lines if line.startswith("rate"))
    assert re.fullmatch(r"rate +[0-9.]+ samples/s on /imu/data, 0 lost on /count", rate)
    assert 5 < float(rate.split()[1]) <= 11
    (latency,) = (line for line in lines if line.startswith("latency"))
    median, worst = map(float, re.findall(r"([0-9.]+) ms", latency))
    assert 0 < median <= worst < 1000
    shown = [line for line in printed[parameters:firmware] if line.startswith(("set ", "/"))]
    assert shown == SET_BY_ROS
    if shutil.which("arm-none-eabi-gcc") and shutil.which("qemu-system-arm"):
        from_board = [int(line.partition("data=")[2]) for line in board if line.startswith("received /count")]
        assert len(from_board) >= 5
        assert from_board == list(range(from_board[0], from_board[0] + len(from_board)))
    else:
        assert any("apt-get install" in line for line in board)


@pytest.mark.ros
def test_the_demo_says_which_part_failed(demo: Path, domain: int) -> None:
    done = run_demo(demo, domain, CC="false")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == "demo: build: the image could not be built (see above)"

    listener = demo / "subscriber.py"
    listener.write_text(
        listener.read_text().replace('"--timeout", type=float, default=20.0', '"--timeout", default=3.0')
    )
    done = run_demo(demo, domain, CFLAGS="-DEXAMPLE_SAMPLES=3")
    assert done.returncode == 1
    assert "20 of each were expected" in done.stderr
    assert done.stderr.splitlines()[-1] == (
        "demo: listener: it did not get its samples; the image ended with status 0"
    )
