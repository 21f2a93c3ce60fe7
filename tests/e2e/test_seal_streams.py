# SPDX-License-Identifier: Apache-2.0
"""Sealed messages over TCP and over a serial line: devices over Mbed TLS, an agent with their keys, and rclpy."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.e2e.images import QUICK, Images
from tests.support.e2e.line_relay import LineRelay
from tests.support.e2e.live import Live
from tests.support.e2e.sealed import (
    KEY,
    OTHER,
    PSK,
    begin,
    sealed_program,
    wait_until_it_arrives,
    write_keys,
)
from tests.support.free_ports import free_port
from tests.support.patience import seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]
PLAIN = f"""\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32, std_msgs/msg/String]
pools: {{nodes: 2, publishers: 3, name_size: 32}}
limits: {{"*": {{string: 16}}}}
session: {{key: {KEY}, connect_timeout: 3 s}}
"""


@pytest.fixture
def options(domain: int, tmp_path: Path) -> tuple[str, ...]:
    """Options of an agent with the key of the device."""
    write_keys(tmp_path / "keys", {KEY: PSK})
    return ("--domain", str(domain), "--psk-file", str(tmp_path / "keys"))


@pytest.fixture
def key(monkeypatch: pytest.MonkeyPatch) -> None:
    """The device has its key."""
    monkeypatch.setenv("SEAL_PSK", PSK)


@pytest.fixture(scope="module")
def port() -> int:
    return free_port(socket.SOCK_STREAM)


@pytest.fixture(scope="module")
def tcp_program(tmp_path_factory: pytest.TempPathFactory, port: int) -> Path:
    transport = f'{{type: tcp, agent: "127.0.0.1:{port}", seal: psa}}'
    return sealed_program(tmp_path_factory.mktemp("sealed_tcp"), transport, "-DLIVE_NO_UDP")


@pytest.fixture
def tcp_agent(domain: int, port: int, options: tuple[str, ...]) -> Iterator[AgentProcess]:
    with running_agent(domain, *options, transport=("tcp4", "--port", str(port))) as running:
        yield running


@pytest.fixture(scope="module")
def line_and_program(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The name of the line, and the program that opens it."""
    folder = tmp_path_factory.mktemp("sealed_serial")
    line = folder / "line"
    transport = f'{{type: serial, device: "{line}", seal: psa}}'
    return line, sealed_program(folder, transport, "-DLIVE_NO_UDP")


def publish_all(live: Live, observer: Observer, values: range) -> None:
    """Publish numbers over a session that works; all arrive, once and in order."""
    observer.ask(do="samples")
    for value in values:
        live.ok(f"publish 0 {value}")
        live.ok(f"flush {seconds(10) * 1000:.0f}")
    found: list[int] = []
    while values[-1] not in found:
        found += [v["data"] for _, v in observer.got(1, topic="/chatter")]
    assert [value for value in found if value >= values[0]] == list(values)


@pytest.mark.usefixtures("key")
def test_tcp_and_restarts_of_both_sides(
    domain: int, port: int, options: tuple[str, ...], tcp_program: Path, observer: Observer
) -> None:
    observer.subscribe("/chatter", INT32)
    where = ("tcp4", "--port", str(port))
    with Live(tcp_program) as live:
        with running_agent(domain, *options, transport=where) as agent:
            begin(live, "-")
            wait_until_it_arrives(live, observer, 1)
            publish_all(live, observer, range(100, 120))
            live.ok("ping 1000 5")
            agent.process.kill()
            agent.process.wait()
        with running_agent(domain, *options, transport=where) as agent:
            wait_until_it_arrives(live, observer, 1000)
            live.kill()
            with Live(tcp_program) as again:
                begin(again, "-")
                wait_until_it_arrives(again, observer, 2000)
                again.ok("close")


@pytest.mark.variant
def test_tcp_says_that_a_key_is_refused(
    tcp_agent: AgentProcess, tcp_program: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SEAL_PSK", OTHER)
    with Live(tcp_program) as live:
        answer = live.call(f"open {KEY} -")
        assert answer.text == f"seal: the agent at 127.0.0.1 has another key for the client {KEY}, or none"
    assert "seal_other_key" in tcp_agent.wait_for("was refused")


def test_tcp_refuses_a_device_without_a_seal(tcp_agent: AgentProcess, images: Images, port: int) -> None:
    image = images.build(0, f'{PLAIN}transport: {{type: tcp, agent: "127.0.0.1:{port}"}}\n', flags=QUICK)
    with Live(images.live(image)) as plain:
        answer = plain.call(f"open {KEY} -")
        assert answer.text == f"the agent at 127.0.0.1:{port} refuses the session: DENIED"
    assert "seal_missing" in tcp_agent.wait_for("was refused")


@pytest.mark.usefixtures("key")
def test_serial_line_that_loses_frames(
    domain: int, options: tuple[str, ...], line_and_program: tuple[Path, Path], observer: Observer
) -> None:
    """Bytes are changed and missing; every sample arrives, also after a restart of each side."""
    name, program = line_and_program
    observer.subscribe("/chatter", INT32)
    with LineRelay(name, 115_200, 0.005, 7) as line, Live(program) as live:
        where = ("serial", "--device", line.agent, "--baud", "115200")
        with running_agent(domain, *options, transport=where) as agent:
            begin(live, "-")
            wait_until_it_arrives(live, observer, 1)
            publish_all(live, observer, range(100, 140))
            agent.process.kill()
            agent.process.wait()
        with running_agent(domain, *options, transport=where):
            wait_until_it_arrives(live, observer, 1000)
            live.kill()
            with Live(program) as again:
                begin(again, "-")
                wait_until_it_arrives(again, observer, 2000)
                again.call("close")  # its answer may be lost
        assert line.changed
        assert line.missing


def test_serial_line_says_that_a_key_is_refused(
    domain: int,
    options: tuple[str, ...],
    line_and_program: tuple[Path, Path],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    name, program = line_and_program
    monkeypatch.setenv("SEAL_PSK", OTHER)
    with (
        running_agent(domain, *options, transport=("pty", "--link", str(name))) as agent,
        Live(program) as live,
    ):
        answer = live.call(f"open {KEY} -")
        assert answer.text == f"seal: the agent at {name} has another key for the client {KEY}, or none"
        assert "seal_other_key" in agent.wait_for("was refused")
