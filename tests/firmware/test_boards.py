# SPDX-License-Identifier: Apache-2.0
"""Each board in QEMU: an agent of a few lines serves it over its UART; then faults, stacks, restarts, noise."""

from __future__ import annotations

import pytest
from runtime.fake_agent import FakeAgent

from firmware.board import BOARDS, Board, Builds, board
from firmware.line import Relay, noisy, scripted_agent

REPORT = (
    "done",
    "published",
    "refused",
    "resent",
    "malformed",
    "dropped",
    "reconnects",
    "lost",
    "stack",
    "fault",
)


def report(running: Board) -> dict[str, int]:
    """Return what the application of c/counter.c says of itself."""
    return dict(zip(REPORT, running.words("counter_report", len(REPORT)), strict=True))


@pytest.mark.parametrize("name", BOARDS)
def test_the_example_publishes_from_each_board(builds: Builds, name: str) -> None:
    built = builds.build(name)
    with board(built) as running, scripted_agent(running.device, FakeAgent()) as agent:
        running.go_on()
        running.wait_for(lambda: len(agent.values()) >= 3)
    assert agent.values()[:3] == [0, 1, 2]


@pytest.mark.parametrize("name", ["qemu-mps2-an385", "qemu-riscv32-virt"])
def test_over_a_bad_line_every_reliable_sample_arrives_once_and_in_order(builds: Builds, name: str) -> None:
    built = builds.build(name)
    image = builds.application(built, "counter.c", "-DCOUNTER_LAST=60")
    agent = FakeAgent()
    with board(built, image) as running, Relay(running.device) as relay:
        relay.fault = noisy(7, 400)
        with scripted_agent(relay.device, agent):
            running.go_on()
            running.wait_for(lambda: report(running)["done"], 30)
            said = report(running)
    assert agent.values() == list(range(1, 61))
    assert relay.lost > 0
    assert relay.spoiled > 0
    assert said["resent"] > 0, said
    assert said["fault"] == 0
    assert 0 < said["stack"] < 2048
