# SPDX-License-Identifier: Apache-2.0
"""Each board in QEMU: an agent of a few lines serves it over its UART; then faults, stacks, restarts, noise."""

from __future__ import annotations

import os
import time

import pytest

from tests.support.firmware.board import BOARDS, Builds, board, report
from tests.support.firmware.line import Relay, noisy, scripted_agent
from tests.support.patience import seconds
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import first, only

FAULTS = {
    "qemu-microbit": ("0x90000000", 3),
    "qemu-mps2-an386": ("0xa0000000", 3),
    "qemu-riscv32-virt": ("0x00000800", 7),
}
"""For a board an address where nothing is, and the number of the exception that a write to it raises."""
DEVICE_KEY = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
session: {key: device}
"""


IMPATIENT = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
session: {liveliness_period: 200 ms, liveliness_timeout: 300 ms, retry_max: 500 ms}
"""
CORES = ("qemu-mps2-an386", "qemu-riscv32-virt")
"""A board of each architecture: `make test` has these."""


@pytest.mark.parametrize("name", only(CORES, BOARDS))
def test_the_example_publishes_from_each_board(builds: Builds, name: str) -> None:
    built = builds.merged(name)
    with board(built) as running, scripted_agent(running.device, FakeAgent()) as agent:
        running.go_on()
        running.wait_for(lambda: len(agent.values()) >= 3)
    assert agent.values()[:3] == [0, 1, 2]


@pytest.mark.system
@pytest.mark.parametrize("name", first(["qemu-mps2-an385", "qemu-riscv32-virt"]))
def test_over_a_bad_line_every_reliable_sample_arrives_once_and_in_order(builds: Builds, name: str) -> None:
    built = builds.merged(name)
    image = builds.application(built, "counter.c", "-DCOUNTER_LAST=60")
    agent = FakeAgent()
    with board(built, image) as running, Relay(running.device) as relay:
        relay.fault = noisy(7, 400)
        with scripted_agent(relay.device, agent):
            running.go_on()
            running.wait_for(lambda: report(running)["done"], 30)
            statistics = report(running)
    assert agent.values() == list(range(1, 61))
    assert relay.lost > 0
    assert relay.spoiled > 0
    assert statistics["resent"] > 0, statistics
    assert statistics["fault"] == 0
    assert 0 < statistics["stack"] < 2048


@pytest.mark.parametrize("name", only(CORES, FAULTS))
def test_a_fault_restarts_the_board_and_leaves_its_cause(builds: Builds, name: str) -> None:
    built = builds.merged(name)
    address, cause = FAULTS[name]
    image = builds.application(built, "fault.c", f"-DFAULT_ADDRESS={address}u")
    with board(built, image, restarts=True) as running:
        running.go_on()
        running.wait_for(lambda: running.words("fault_report")[0])
        _, number, status, place, pc, where = running.words("fault_report", 6)
    assert number == cause
    assert 0 <= pc - (where & ~1) < 32
    if name != "qemu-microbit":
        assert place == int(address, 16)
    if name == "qemu-mps2-an386":
        assert status == 0x8200  # BFARVALID, PRECISERR


@pytest.mark.system
@pytest.mark.parametrize("name", first(["qemu-microbit", "qemu-mps2-an385"]))
def test_a_stack_that_overflows_meets_the_end_of_ram_and_leaves_a_cause(builds: Builds, name: str) -> None:
    built = builds.merged(name)
    image = builds.application(built, "fault.c", "-DFAULT_STACK")
    with board(built, image, restarts=True) as running:
        running.go_on()
        running.wait_for(lambda: running.words("fault_report")[0])
        _, number, _, _, pc, _ = running.words("fault_report", 6)
    assert number == 3
    assert pc == 0


def test_a_main_that_returns_restarts_the_board_until_there_is_an_agent(builds: Builds) -> None:
    built = builds.merged("qemu-mps2-an386")
    with board(built, restarts=True) as running:
        running.go_on()
        time.sleep(2.5)  # a second of waiting for the agent, a second of pause
        with scripted_agent(running.device, FakeAgent()) as agent:
            running.wait_for(lambda: agent.values())
    with board(built) as running:
        running.go_on()
        assert running.process.wait(timeout=seconds(20)) == 0


@pytest.mark.parametrize("loop", first(["begins again", "keeps the session"]))
def test_the_usual_loops_outlive_an_outage_of_the_agent(builds: Builds, loop: str) -> None:
    """The one line is the session's: a ping while it is looked for must not close it."""
    built = builds.merged("qemu-mps2-an385", IMPATIENT)
    keeps = loop == "keeps the session"
    image = builds.application(built, "usual_loop.c", *(["-DLOOP_KEEPS"] if keeps else []))
    agent = FakeAgent()

    def silent_pings() -> int:
        return running.words("loop_report", 3)[2]

    with board(built, image) as running, scripted_agent(running.device, agent):
        running.go_on()
        for _ in range(2):
            before, silent = len(agent.values()), silent_pings()
            running.wait_for(lambda before=before: len(agent.values()) > before + 5)  # type: ignore[misc]
            agent.silent = True
            running.wait_for(lambda silent=silent: silent_pings() >= silent + 4)  # type: ignore[misc]
            agent.restart()
            agent.silent = False
        before = len(agent.values())
        running.wait_for(lambda: len(agent.values()) > before + 5)
        started = running.words("loop_report", 4)[3]
    assert (started == 1) == keeps


def test_bytes_not_read_in_time_are_counted_and_the_line_recovers(builds: Builds) -> None:
    built = builds.merged("qemu-mps2-an386")
    image = builds.application(built, "counter.c", "-DCOUNTER_LAST=20", "-DCOUNTER_PERIOD_MS=100u")
    agent = FakeAgent()
    with board(built, image) as running, scripted_agent(running.device, agent):
        running.go_on()
        running.wait_for(lambda: len(agent.values()) > 2)
        flood = os.open(
            running.device, os.O_RDWR | os.O_NOCTTY
        )  # open_raw would discard what the agent has yet to read
        for _ in range(16):
            os.write(flood, b"\x7e" * 3 + bytes(range(64)) * 4)
        os.close(flood)
        running.wait_for(lambda: report(running)["done"])
        statistics = report(running)
    assert statistics["lost"] > 0
    assert agent.values() == list(range(1, 21))


def test_a_device_with_a_unique_number_is_known_by_it(builds: Builds) -> None:
    built = builds.merged("qemu-microbit", DEVICE_KEY)
    with board(built) as running, scripted_agent(running.device, FakeAgent()) as agent:
        running.go_on()
        running.wait_for(lambda: agent.values())
        number = running.memory(0x10000060, 8)
    key = 2166136261
    for byte in number:
        key = (key ^ byte) * 16777619 % 2**32
    assert agent.log[0][16:20] == key.to_bytes(4, "big")
