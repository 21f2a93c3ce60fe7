# SPDX-License-Identifier: Apache-2.0
"""Reliable streams over bad networks: rclpy publishes, a device gives each sample back, rclpy gets all, once, in order.

Both directions at once: what is lost, doubled or out of order on either way shows in what comes back.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, QUICK, Images
from tests.support.e2e.line_relay import LineRelay
from tests.support.e2e.loss import APPLICATION, echo
from tests.support.e2e.relay import Relay, cutting, lossy

pytestmark = pytest.mark.ros


def over_udp(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay, count: int, timeout_s: float
) -> None:
    image = images.build(relay.port, APPLICATION.format(transport=""), flags=QUICK)
    program = image.application(C_FILES / "echo.c", image.out.parent / "echo", "-std=c99", "-Wall", "-Werror")
    relay.connect(agent.port)
    relay.fault, relay.cut = lossy(count), cutting(count)
    before = relay.shortened
    counted = echo(observer, program, count, timeout_s)
    print(f"datagrams that came cut: {relay.shortened - before}")
    assert counted["resent"] > count // 8
    assert relay.shortened - before > count // 50


def over_a_line(
    images: Images, observer: Observer, domain: int, folder: Path, count: int, timeout_s: float
) -> None:
    """A line of 115200 baud, a part of whose frames is cut or changed."""
    device = folder / "line"
    text = APPLICATION.format(transport=f'transport: {{type: serial, device: "{device}"}}')
    image = images.build(0, text, flags=QUICK)
    program = image.application(C_FILES / "echo.c", folder / "echo", "-std=c99", "-Wall", "-Werror")
    with (
        LineRelay(device, 115_200, 0.01, count) as line,
        running_agent(
            domain, "--domain", str(domain), transport=("serial", "--device", line.agent, "--baud", "115200")
        ),
    ):
        counted = echo(observer, program, count, timeout_s)
        print(f"bytes changed in {line.changed} pieces, missing in {line.missing}")
    assert counted["resent"]
    assert line.changed
    assert line.missing


@pytest.mark.system
def test_nothing_is_lost_over_a_bad_network(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay
) -> None:
    over_udp(images, observer, agent, relay, 400, 60)


@pytest.mark.variant
@pytest.mark.system
def test_nothing_is_lost_over_6lowpan(images: Images, observer: Observer, domain: int) -> None:
    """IPv6 with datagrams of at most 80 bytes, as frames of IEEE 802.15.4 hold them (D1.4, 4.9.1), and with loss."""
    count = 200
    with (
        Relay("::1") as relay,
        running_agent(
            domain, "--domain", str(domain), transport=("udp6", "--port", "0", "--bind", "::1")
        ) as agent,
    ):
        transport = f"transport: {{type: udp, agent: '[::1]:{relay.port}', mtu: 80}}"
        image = images.build(0, APPLICATION.format(transport=transport), flags=QUICK)
        program = image.application(
            C_FILES / "echo.c", image.out.parent / "echo", "-std=c99", "-Wall", "-Werror"
        )
        relay.connect(agent.port)
        relay.fault = lossy(count)
        counted = echo(observer, program, count, 60)
    assert counted["resent"] > count // 8
    assert 60 < relay.largest <= 80


@pytest.mark.system
def test_nothing_is_lost_over_a_bad_line(
    images: Images, observer: Observer, domain: int, tmp_path: Path
) -> None:
    over_a_line(images, observer, domain, tmp_path, 300, 60)


@pytest.mark.long
def test_a_hundred_thousand_over_a_bad_network(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay
) -> None:
    over_udp(images, observer, agent, relay, 100_000, 7200)


@pytest.mark.long
def test_many_over_a_bad_line(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    over_a_line(images, observer, domain, tmp_path, 20_000, 3600)
