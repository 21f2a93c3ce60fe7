# SPDX-License-Identifier: Apache-2.0
"""Transports other than UDP on the host: a serial line, and functions of an application, to rclpy."""

from __future__ import annotations

import shutil
import socket
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.images import QUICK, Images, ends_well, started
from tests.support.e2e.programs import check_count, run_to, until
from tests.support.free_ports import free_port
from tests.support.patience import seconds
from tests.support.slices import first

pytestmark = pytest.mark.ros

CUSTOM = Path(__file__).parents[1] / "runtime" / "c" / "custom.c"
APPLICATION = """\
version: 1
profiles: [pure_sender]
transport: {{type: {transport}}}
session: {{key: {key}, connect_timeout: 20 s, create_timeout: 20 s}}
nodes:
  - name: talker
    publishers: [{{topic: {topic}, type: std_msgs/msg/Int32}}]
pools: {{history: 16}}
on_full: block 2 s
"""
LAST = 199
"""The last value that the first of two agents must forward."""
SAMPLES = 3 * LAST
"""Samples of a program with one session: nine seconds, since DDS discovery takes some on a busy machine."""


@pytest.mark.parametrize("way", first(["line", "udp"]))
def test_functions_of_an_application(
    images: Images, observer: Observer, domain: int, way: str, tmp_path: Path
) -> None:
    """An application as those for micro-ROS are written: packets as they are, and frames on a stream of bytes."""
    text = APPLICATION.format(transport="custom", key=11 if way == "udp" else 12, topic=f"custom_{way}")
    image = images.build(0, text, flags=QUICK)
    source = tmp_path / "custom.c"
    slower = (
        CUSTOM.read_text()
        .replace("VALUES = 100", f"VALUES = {SAMPLES}")
        .replace("sleep_ms(2)", "sleep_ms(15)")
    )
    source.write_text(slower.replace('"chatter"', f'"custom_{way}"'))
    (tmp_path / "types.h").write_text("#include <std_msgs/msg/int32.h>\n")
    program = image.application(source, tmp_path / "custom", "-std=c99")
    transport = ("udp4", "--port", "0") if way == "udp" else ("pty",)
    with running_agent(domain, "--domain", str(domain), transport=transport) as agent:
        observer.subscribe(f"/custom_{way}", "std_msgs/msg/Int32")
        with started(program, way, str(agent.port) if way == "udp" else agent.device) as running:
            samples = until(observer, [f"/custom_{way}"], SAMPLES - 1)
            running.communicate(timeout=seconds(15))
            assert running.returncode == 0
    run_to(SAMPLES - 1, [sample["data"] for sample in samples[f"/custom_{way}"]])


def test_tcp_and_an_agent_that_restarts(images: Images, observer: Observer, domain: int) -> None:
    """The connection breaks with the agent; the example goes on over another one by itself."""
    port = free_port(socket.SOCK_STREAM)
    text = APPLICATION.format(transport=f'tcp, agent: "127.0.0.1:{port}"', key=14, topic="tcp")
    flags = (*QUICK, f"-DEXAMPLE_SAMPLES={4 * LAST}", "-DEXAMPLE_PERIOD_MS=15")
    image = images.build(0, text, flags=flags)
    where = ("tcp4", "--port", str(port))
    observer.subscribe("/tcp", "std_msgs/msg/Int32")
    with (
        running_agent(domain, "--domain", str(domain), transport=where) as agent,
        started(image.program) as running,
    ):
        until(observer, ["/tcp"], LAST)
        agent.stop()
        with running_agent(domain, "--domain", str(domain), transport=where):
            samples = until(observer, ["/tcp"], 4 * LAST - 1)
            running.communicate(timeout=seconds(15))
    check_count([sample["data"] for sample in samples["/tcp"]])
    shutil.rmtree(image.out.parent)  # its port is this test's


@pytest.mark.system
def test_an_agent_that_is_searched_for(images: Images, observer: Observer, domain: int) -> None:
    """The image knows a port of the multicast group alone; the agent, and one after it, listen wherever they like."""
    port = free_port(socket.SOCK_STREAM)
    text = APPLICATION.replace("pure_sender", "ad_hoc_discoverable_sender").format(
        transport=f'udp, agent: "discover:{port}"', key=15, topic="found"
    )
    image = images.build(0, text, flags=(*QUICK, f"-DEXAMPLE_SAMPLES={4 * LAST}", "-DEXAMPLE_PERIOD_MS=15"))
    options = ("--domain", str(domain), "--discovery-port", str(port))
    observer.subscribe("/found", "std_msgs/msg/Int32")
    with (
        running_agent(domain, *options) as agent,
        started(image.out / "bin" / "ad_hoc_discoverable_sender") as running,
    ):
        until(observer, ["/found"], LAST)
        agent.stop()
        with running_agent(domain, *options):
            samples = until(observer, ["/found"], 4 * LAST - 1)
            running.communicate(timeout=seconds(15))
    check_count([sample["data"] for sample in samples["/found"]])
    shutil.rmtree(image.out.parent)  # its port is this test's


def test_a_serial_line(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    """The profile's example over a pseudo-terminal whose name the application file has."""
    line = tmp_path / "line"
    text = APPLICATION.format(transport=f'serial, device: "{line}"', key=13, topic="serial")
    flags = (*QUICK, f"-DEXAMPLE_SAMPLES={SAMPLES}", "-DEXAMPLE_PERIOD_MS=15")
    image = images.build(0, text, flags=flags)
    with running_agent(domain, "--domain", str(domain), transport=("pty", "--link", str(line))):
        observer.subscribe("/serial", "std_msgs/msg/Int32")
        with started(image.program) as running:
            samples = until(observer, ["/serial"], SAMPLES - 1)
            ends_well(running)
    run_to(SAMPLES - 1, [sample["data"] for sample in samples["/serial"]])
    shutil.rmtree(image.out.parent)  # its line is this test's
