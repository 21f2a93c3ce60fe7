# SPDX-License-Identifier: Apache-2.0
"""Sealed messages over UDP: devices over Mbed TLS, an agent with their keys, and rclpy."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.e2e.images import Image, Images
from tests.support.e2e.live import Live
from tests.support.e2e.relay import Relay, rough
from tests.support.e2e.sealed import (
    KEY,
    OTHER,
    PSK,
    begin,
    sealed_program,
    wait_until_it_arrives,
    write_keys,
)
from tests.support.patience import seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]


@pytest.fixture(scope="module")
def planned() -> Iterator[Relay]:
    """The relay at the address of the plan, which a ping without a session asks."""
    with Relay() as relay:
        yield relay


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory, planned: Relay) -> Path:
    folder = tmp_path_factory.mktemp("sealed")
    return sealed_program(folder, "{seal: psa}", agent=f"127.0.0.1:{planned.port}")


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    file = tmp_path / "keys"
    write_keys(file, {KEY: PSK})
    return file


@pytest.fixture
def agent(domain: int, keys: Path) -> Iterator[AgentProcess]:
    with running_agent(domain, "--domain", str(domain), "--psk-file", str(keys)) as running:
        yield running


@pytest.fixture
def live(program: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Live]:
    monkeypatch.setenv("SEAL_PSK", PSK)
    with Live(program) as running:
        yield running


def test_samples_arrive_and_none_is_in_the_clear(agent: AgentProcess, live: Live, observer: Observer) -> None:
    observer.subscribe("/chatter", INT32)
    seen: list[bytes] = []
    with Relay() as relay:
        relay.connect(agent.port)
        relay.cut = lambda data: seen.append(data) or data  # type: ignore[func-returns-value]
        begin(live, relay.port)
        wait_until_it_arrives(live, observer, 1)
        live.ok("close")
    assert {data[0] for data in seen} == {1, 2, 3}
    assert all(word not in data for word in (b"talker", b"chatter", b"XRCE") for data in seen)


def test_all_samples_arrive_over_a_bad_network(agent: AgentProcess, live: Live, observer: Observer) -> None:
    """Datagrams are lost, come twice and out of order; the records of the copies are refused."""
    observer.subscribe("/chatter", INT32)
    with Relay() as relay:
        relay.connect(agent.port)
        relay.fault = rough(7)
        begin(live, relay.port)
        wait_until_it_arrives(live, observer, 1)
        observer.ask(do="samples")
        for value in range(100, 140):
            live.ok(f"publish 0 {value}")
            live.ok(f"flush {seconds(5) * 1000:.0f}")
        found: list[int] = []
        while 139 not in found:
            found += [v["data"] for _, v in observer.got(1, topic="/chatter")]
        assert [value for value in found if value >= 100] == list(range(100, 140))
        relay.fault = lambda: [0.0]
        live.ok("close")
    assert agent.wait_for("seal_replayed")


def test_session_goes_on_after_a_restart_of_the_agent(
    domain: int, keys: Path, live: Live, observer: Observer
) -> None:
    observer.subscribe("/chatter", INT32)
    with Relay() as relay:
        for first in (1, 1000):
            with running_agent(domain, "--domain", str(domain), "--psk-file", str(keys)) as agent:
                relay.connect(agent.port)
                if first == 1:
                    begin(live, relay.port)
                wait_until_it_arrives(live, observer, first)
                if first == 1:
                    agent.process.kill()
                    agent.process.wait()
                else:
                    live.ok("close")


def test_device_that_restarts_begins_another_session(
    agent: AgentProcess, program: Path, live: Live, observer: Observer, monkeypatch: pytest.MonkeyPatch
) -> None:
    observer.subscribe("/chatter", INT32)
    begin(live, agent.port)
    wait_until_it_arrives(live, observer, 1)
    live.kill()
    monkeypatch.setenv("SEAL_PSK", PSK)
    with Live(program) as again:
        begin(again, agent.port)
        wait_until_it_arrives(again, observer, 1000)
        again.ok("close")


def test_device_says_that_its_key_is_refused(
    agent: AgentProcess, program: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SEAL_PSK", OTHER)
    with Live(program) as live:
        answer = live.call(f"open {KEY} {agent.port}")
        assert answer.text == f"seal: the agent at 127.0.0.1 has another key for the client {KEY}, or none"
    assert "seal_other_key" in agent.wait_for("was refused")


def test_device_without_a_key_says_so(
    agent: AgentProcess, program: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("SEAL_PSK", raising=False)
    with Live(program) as live:
        answer = live.call(f"open {KEY} {agent.port}")
        assert answer.text == f"seal: microros_seal_psk has no key for the client {KEY}"


def test_device_with_the_client_key_of_another_is_refused(agent: AgentProcess, live: Live) -> None:
    answer = live.call(f"open 0x78 {agent.port}")
    assert answer.text == f"the agent at 127.0.0.1:{agent.port} refuses the session: DENIED"
    assert "seal_other_client" in agent.wait_for("was refused")


def test_device_without_a_seal_is_refused(agent: AgentProcess, images: Images, pool_image: Image) -> None:
    with Live(images.live(pool_image)) as plain:
        answer = plain.call(f"open {KEY} {agent.port}")
        assert answer.text == f"the agent at 127.0.0.1:{agent.port} refuses the session: DENIED"
    assert "seal_missing" in agent.wait_for("was refused")


def test_device_does_not_talk_to_an_agent_without_a_seal(domain: int, live: Live) -> None:
    with running_agent(domain) as plain:
        answer = live.call(f"open {KEY} {plain.port}")
    assert "no answer from the agent at 127.0.0.1 to the handshake" in answer.text


def test_ping_with_and_without_a_session(agent: AgentProcess, live: Live, planned: Relay) -> None:
    assert live.call("ping 50 1").code != 0
    planned.connect(agent.port)
    live.ok("ping 1000 10")
    begin(live, agent.port)
    live.ok("ping 1000 10")
    live.ok("close")
    live.ok("ping 1000 10")
    planned.connect(0)


def test_ping_with_options(
    agent: AgentProcess, domain: int, live: Live, observer: Observer, tmp_path: Path
) -> None:
    """Each address is another agent, and has its own handshake; the session with the first one continues."""
    observer.subscribe("/chatter", INT32)
    port, silent = agent.port, 1
    live.ok(f"ping_at {port} 1000 10")
    other, foreign = tmp_path / "other", tmp_path / "foreign"
    write_keys(other, {KEY: PSK})
    write_keys(foreign, {KEY: OTHER})
    with (
        running_agent(domain, "--domain", str(domain), "--psk-file", str(other)) as second,
        running_agent(domain, "--domain", str(domain), "--psk-file", str(foreign)) as third,
    ):
        live.ok(f"ping_at {second.port} 1000 10")
        begin(live, port)
        live.ok(f"ping_at {port} 1000 10")
        live.ok(f"ping_at {second.port} 1000 10")
        assert live.call(f"ping_at {third.port} 100 2").code != 0
        assert live.call(f"ping_at {silent} 100 2").code != 0
        assert "seal_other_key" in third.wait_for("was refused")
    wait_until_it_arrives(live, observer, 1)
    assert live.ok("statistics").lines[0].split()[-2] == "reconnects=0"
    live.ok("close")
    live.ok(f"ping_at {port} 1000 10")


def test_keys_are_read_again(
    agent: AgentProcess, keys: Path, program: Path, live: Live, observer: Observer
) -> None:
    """A session ends with its key; that of another key goes on, and a damaged file changes nothing."""
    observer.subscribe("/chatter", INT32)
    begin(live, agent.port)
    wait_until_it_arrives(live, observer, 1)
    write_keys(keys, {KEY: PSK, 0x78: OTHER})
    agent.process.send_signal(signal.SIGHUP)
    assert agent.wait_for("sealed: keys of 2 clients")
    keys.write_text(f"{KEY:#x} {PSK}\n0x78 {OTHER[:-2]}\n")
    agent.process.send_signal(signal.SIGHUP)
    fault = agent.wait_for(f"{keys}:2:1")
    assert "64 hexadecimal digits" in fault
    assert OTHER[:8] not in fault
    assert agent.wait_for("stay in force")
    wait_until_it_arrives(live, observer, 100)
    assert live.ok("statistics").lines[0].split()[-2] == "reconnects=0"
    write_keys(keys, {0x78: OTHER})
    agent.process.send_signal(signal.SIGHUP)
    assert f"{KEY:08X}" in agent.wait_for("its key was removed")
    assert agent.wait_for("seal_unknown_key")
    write_keys(keys, {KEY: PSK})
    agent.process.send_signal(signal.SIGHUP)
    wait_until_it_arrives(live, observer, 1000)
    live.ok("close")
