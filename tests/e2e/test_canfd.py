# SPDX-License-Identifier: Apache-2.0
"""CAN FD to rclpy: all that SocketCAN has above its sockets, over a bus that a thread of the test plays.

The kernel's own bus is tested where it has one (tests/agent/test_canfd.py says when it has not).
"""

from __future__ import annotations

import random
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.can_bus import EXTENDED, CanBus, record
from tests.support.e2e.images import C_FILES, QUICK, Images, started
from tests.support.e2e.loss import APPLICATION, echo
from tests.support.e2e.programs import check_count, until
from tests.support.patience import seconds
from tests.support.slices import first

pytestmark = pytest.mark.ros

TALKER = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
transport: {type: canfd, id: 0x7f}
session: {connect_timeout: 20 s, create_timeout: 20 s}
pools: {nodes: 1, publishers: 1, name_size: 32, history: 16}
on_full: block 10 s
"""
ENOUGH = 60
ERROR_FRAME = 0x2000_0000
"""The flag of a record that reports an error of the controller (linux/can.h)."""


@pytest.fixture
def bus() -> Iterator[CanBus]:
    with CanBus() as running:
        yield running


@pytest.fixture
def talker(images: Images, tmp_path: Path) -> Path:
    image = images.build(0, TALKER, flags=QUICK)
    return image.application(C_FILES / "can_talker.c", tmp_path / "talker", "-std=c99", "-Wall", "-Werror")


@pytest.mark.parametrize("loss", first([0.1, 0.3]))
def test_both_directions_with_loss(
    images: Images, observer: Observer, domain: int, bus: CanBus, loss: float, tmp_path: Path
) -> None:
    """Every request to create an entity goes in fragments, and some frames of all kinds are lost."""
    text = APPLICATION.format(transport=f'transport: {{type: canfd, device: "{bus.device}", id: 0x1ABCDEF0}}')
    image = images.build(0, text, flags=QUICK)
    program = image.application(C_FILES / "echo.c", tmp_path / "echo", "-std=c99", "-Wall", "-Werror")
    chance = random.Random(7)
    bus.lost = lambda frame: chance.random() < loss
    with running_agent(domain, "--domain", str(domain), transport=("canfd", "--dev", bus.device)):
        counted = echo(observer, program, 200, 60)
    assert counted["resent"]
    assert bus.losses
    assert bus.identifiers() == {0x1ABCDEF0}


def collect(observer: Observer, samples: dict[str, list[int]], wanted: dict[str, int]) -> None:
    """Add samples to those of their topics, until each has a value of at least `wanted`."""
    for topic, value in wanted.items():
        if not samples[topic] or samples[topic][-1] < value:
            for name, found in until(observer, [topic], value, 40).items():
                samples[name] += [sample["data"] for sample in found]


def end(running: subprocess.Popen[str]) -> dict[str, int]:
    """End a talker; return what it says."""
    out, errors = running.communicate(timeout=seconds(40))
    assert (running.returncode, errors) == (0, "")
    return {key: int(value) for key, value in (pair.split("=") for pair in out.split())}


def test_two_clients_of_a_bus_and_frames_of_others(
    observer: Observer, domain: int, bus: CanBus, talker: Path
) -> None:
    """Each client gets what its identifier has; frames of other nodes of the bus change nothing."""
    strange = [
        record(0x99, b"\x05\x01\x02\x03"),  # too short for its length
        record(0x99, b"\x00"),
        record(0x99, bytes(64)),
        record(
            0x11, b"\x18\x80\x00", flags=0
        ),  # not an extended identifier, though the number is that of a client
        record(0x12, b"\x03\x80\x00\x00", flags=EXTENDED | ERROR_FRAME),
        bytes(16),
        record(0x99, b"\x10" + bytes(63))[:40],
    ]
    samples: dict[str, list[int]] = {"/left": [], "/right": []}
    for topic in samples:
        observer.subscribe(topic, "std_msgs/msg/Int32")
    with (
        running_agent(domain, "--domain", str(domain), transport=("canfd", "--dev", bus.device)),
        started(talker, bus.device, "0x11", "0x11", "left") as left,
        started(talker, bus.device, "0x12", "0x12", "right") as right,
    ):
        collect(observer, samples, dict.fromkeys(samples, 1))
        for frame in strange:
            bus.put(frame)
        collect(observer, samples, {topic: values[-1] + ENOUGH for topic, values in samples.items()})
        ends = {"/left": end(left), "/right": end(right)}
        collect(observer, samples, {topic: counted["last"] for topic, counted in ends.items()})
    for topic, values in samples.items():
        assert values == list(range(values[0], ends[topic]["last"] + 1))
        assert (ends[topic]["malformed"], ends[topic]["reconnects"]) == (0, 0)
    assert bus.identifiers() >= {0x11, 0x12, 0x99}


@pytest.mark.system
def test_a_bus_that_goes_away_and_returns(observer: Observer, domain: int, talker: Path) -> None:
    """As an interface that goes down: the agent opens it again, and the client goes on in its order."""
    samples: dict[str, list[int]] = {"/gone": []}
    observer.subscribe("/gone", "std_msgs/msg/Int32")
    with tempfile.TemporaryDirectory() as short:  # a socket has a path of at most 107 bytes
        path = Path(short) / "bus"
        device = f"unix:{path}"
        with ExitStack() as stack:
            first = stack.enter_context(ExitStack())
            first.enter_context(CanBus(path))
            where = ("canfd", "--dev", device)
            agent = stack.enter_context(running_agent(domain, "--domain", str(domain), transport=where))
            running = stack.enter_context(started(talker, device, "0x21", "0x21", "gone"))
            collect(observer, samples, {"/gone": ENOUGH})
            for _ in range(2):
                path.unlink()
                first.close()
                agent.wait_for(f"canfd {device} is gone")
                first.enter_context(CanBus(path))
                agent.wait_for(f"canfd {device} is back")
                collect(observer, samples, {"/gone": samples["/gone"][-1] + ENOUGH})
            counted = end(running)
            collect(observer, samples, {"/gone": counted["last"]})
            assert agent.stop() == 0
            assert any("2 faults of input" in line for line in agent.rest())
    # A busy machine may take longer than the liveliness timeout for an outage.
    check_count(samples["/gone"], counted["reconnects"])


@pytest.mark.variant
def test_an_agent_that_restarts(observer: Observer, domain: int, bus: CanBus, talker: Path) -> None:
    """The client opens a session with the next agent, and goes on in its order."""
    options, where = ("--domain", str(domain)), ("canfd", "--device", bus.device)
    samples: dict[str, list[int]] = {"/again": []}
    observer.subscribe("/again", "std_msgs/msg/Int32")
    with (
        running_agent(domain, *options, transport=where) as agent,
        started(talker, bus.device, "0x1fffffff", "0x77", "again") as running,
    ):
        collect(observer, samples, {"/again": ENOUGH})
        agent.stop(signal.SIGKILL)
        with running_agent(domain, *options, transport=where):
            collect(observer, samples, {"/again": samples["/again"][-1] + ENOUGH})
            counted = end(running)
            collect(observer, samples, {"/again": counted["last"]})
    assert counted["reconnects"]
    check_count(samples["/again"], counted["reconnects"])
