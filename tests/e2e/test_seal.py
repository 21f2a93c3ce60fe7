# SPDX-License-Identifier: Apache-2.0
"""Sealed datagrams: devices over Mbed TLS, an agent with their keys, and rclpy."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.e2e.images import C_FILES, POOLS, Image, Images, run
from tests.support.e2e.live import Live
from tests.support.e2e.relay import Relay, rough
from tests.support.patience import deadline

pytestmark = [pytest.mark.ros, pytest.mark.system]
KEY = 0x77
PSK, OTHER = bytes(range(32)).hex(), bytes(range(1, 33)).hex()
SEALED = f"""\
{POOLS}\
liveliness: ping
transport: {{seal: psa}}
session:
  key: {KEY}
  liveliness_period: 200 ms
  round_trip: 50 ms
  liveliness_timeout: 1 s
  retry_max: 400 ms
  connect_timeout: 3 s
  create_timeout: 5 s
"""


@pytest.fixture(scope="module")
def planned() -> Iterator[Relay]:
    """The relay at the address of the plan, which a ping without a session asks."""
    with Relay() as relay:
        yield relay


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory, planned: Relay) -> Path:
    folder = tmp_path_factory.mktemp("sealed")
    config, out, program = folder / "microros.yaml", folder / "out", folder / "live"
    config.write_text(SEALED)
    place = f"127.0.0.1:{planned.port}"
    compiler.generate(compiler.Options(config=config, interface_paths=(shipped_folder(),), agent=place), out)
    sources = [str(out / name) for name in (out / "sources.txt").read_text(encoding="utf-8").split()]
    own = [str(C_FILES / name) for name in ("live.c", "seal_key.c")]
    done = run(
        [
            *("gcc", "-O0", "-g", "-std=c99", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
            *("-DLIVE_PING", f"-I{out / 'include'}", *own, *sources, "-lmbedcrypto", "-o", str(program)),
        ],
        timeout_s=240,
    )
    assert done.returncode == 0, done.stderr
    return program


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    file = tmp_path / "keys"
    file.write_text(f"{KEY:#x} {PSK}\n")
    file.chmod(0o600)
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


def begin(live: Live, port: int) -> None:
    for command in (f"open {KEY} {port}", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        live.ok(command)


def wait_until_it_arrives(live: Live, observer: Observer, first: int) -> None:
    """Publish numbers from `first` on until one arrives."""
    end = deadline(20)
    while not [v for _, v in observer.ask(do="samples") if v["data"] >= first]:
        assert time.monotonic() < end, "no sample arrives"
        live.call(f"publish 0 {first}")
        time.sleep(0.05)
        live.call("flush 500")


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
            live.ok("flush 5000")
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
