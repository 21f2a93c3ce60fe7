# SPDX-License-Identifier: Apache-2.0
"""One agent with several transports as a program: clients of each in the graph, configuration, signals, a manager."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from microros_gen.agent.readiness import notify, watchdog
from microros_gen.agent.transport.discovery import GROUP
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.command import run
from tests.support.agent.observer import observing
from tests.support.agent.process import READY, own_domain, running_agent
from tests.support.agent.serial_link import SerialLink
from tests.support.agent.tcp_link import TcpLink
from tests.support.free_ports import free_port
from tests.support.paths import ROOT
from tests.support.patience import seconds
from tests.support.slices import first, spread_rows

pytestmark = pytest.mark.builds

DOMAIN = own_domain()
INT32 = "std_msgs/msg/Int32"
ALL = ("udp4", "--port", "0", "udp6", "--port", "0", "tcp4", "--port", "0", "tcp6", "--port", "0", "pty")


@pytest.mark.ros
@pytest.mark.parametrize("number", first([signal.SIGINT, signal.SIGTERM]))
def test_clients_of_every_transport_are_in_the_graph_and_leave_it(number: int, tmp_path: Path) -> None:
    link = tmp_path / "board"
    with running_agent(DOMAIN, "--link", str(link), transport=ALL) as agent, observing(DOMAIN) as observer:
        places = [agent.wait_for(READY).rpartition(" ")[2] for _ in range(4)]
        ports = [int(place.rpartition(":")[2]) for place in places[:3]]
        udp6 = socket.socket(socket.AF_INET6, socket.SOCK_DGRAM)
        udp6.connect(("::1", ports[0]))
        links = (udp6, TcpLink("127.0.0.1", ports[1]), TcpLink("::1", ports[2]), SerialLink(places[3]))
        clients = [XrceClient(agent.port), *(XrceClient(each, key=n + 1) for n, each in enumerate(links))]  # type: ignore[arg-type]
        writers = []
        for index, client in enumerate(clients):
            assert client.connect() == 0
            observer.subscribe(f"/from_{index}", INT32)
            writers.append(client.publisher(f"node_{index}", f"from_{index}", INT32, DOMAIN))
        names = {f"/node_{index}" for index in range(5)}
        observer.see(
            lambda graph: (
                names <= set(graph["nodes"]) and all(graph["publishers"].get(f"/from_{n}") for n in range(5))
            )
        )
        for index, (client, writer) in enumerate(zip(clients, writers, strict=True)):
            client.wait_until_subscribed(writer, int32_body(index), observer, f"/from_{index}")
        assert agent.stop(number) == 0
        observer.see(lambda graph: not names & set(graph["nodes"]), timeout_s=3)
        assert not link.exists()


@pytest.mark.ros
def test_a_configuration_file(tmp_path: Path) -> None:
    port = free_port()
    path = tmp_path / "agent.yaml"
    path.write_text(
        "version: 1\ntransports:\n  - udp4: {port: 0}\n  - tcp4: {port: 0}\n"
        f"discovery: {{port: {port}}}\nlimits: {{clients: 1}}\nlog: {{format: json}}\n"
    )
    with running_agent(DOMAIN, transport=("-c", str(path))) as agent:
        first = json.loads(agent.log[-1])
        assert (first["event"], first["transport"]) == ("ready", "udp4")
        agent.port = int(first["address"].rpartition(":")[2])
        assert json.loads(agent.wait_for('"ready"'))["transport"] == "tcp4"
        assert json.loads(agent.wait_for('"ready"'))["address"] == f"{GROUP}:{port}"
        with XrceClient(agent.port) as client, XrceClient(agent.port, key=2) as other:
            assert client.connect() == 0
            assert client.ping() == 1
            assert other.connect() == 0x87  # RESOURCES: the file allows one
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asker:
            asker.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
            asker.settimeout(seconds(3))
            asker.sendto(bytes.fromhex("80000000020108000009fffd03000000"), (GROUP, port))
            assert agent.port.to_bytes(2, "little") in asker.recv(1000)
        assert agent.stop() == 0


@pytest.mark.ros
def test_a_client_of_another_definition_is_named(tmp_path: Path) -> None:
    """Its manifest says a hash that neither this machine nor the subscriber has."""
    reported = {"std_msgs/msg/Int32": {"hash": "RIHS01_" + "12" * 32}}
    path = tmp_path / "manifest.json"
    path.write_text(
        json.dumps({"types": reported, "entities": {"nodes": [{"namespace": "/", "name": "old"}]}})
    )
    with running_agent(DOMAIN, "--manifest", str(path)) as agent, XrceClient(agent.port) as client:
        client.connect()
        client.publisher("old", "aged", INT32, DOMAIN)
        client.publisher("new", "fresh", INT32, DOMAIN, number=2)
        with observing(DOMAIN) as observer:
            observer.subscribe("/aged", INT32)
            observer.subscribe("/fresh", INT32)
            line = agent.wait_for("was generated with the type RIHS01_1212")
            assert "/aged" in line
            assert "/observer has RIHS01_b6578ded" in line
            agent.stop()
        rest = agent.wait_for("agent stopped")
        assert not [line for line in (*agent.log, rest) if "/fresh" in line and "differ" in line]


@pytest.mark.ros
def test_every_message_as_json() -> None:
    """Both directions, decoded, and the bytes themselves."""
    with running_agent(DOMAIN, "-vv", "--log-format", "json") as agent, XrceClient(agent.port) as client:
        client.connect()
        question = json.loads(agent.wait_for('"way": "from"'))
        assert question["event"] == "message"
        assert bytes.fromhex(question["bytes"])[8:12] == b"XRCE"
        (create,) = question["submessages"]
        assert (create["name"], create["key"], create["mtu"]) == ("CREATE_CLIENT", "a1 b2 c3 d4", 512)
        answer = json.loads(agent.wait_for('"way": "to"'))
        assert answer["submessages"][0]["status"] == "OK"


def test_faults_of_the_file_are_reported_before_everything_else(tmp_path: Path) -> None:
    (tmp_path / "agent.yaml").write_text("version: 1\ntransports: [upd4: {}]\ndomain: x\n")
    result = run("--config", "agent.yaml", path=tmp_path)
    assert result.returncode == 2
    assert (
        "agent.yaml:2:14: error: unknown key 'upd4' in 'transports[0]'. Did you mean 'udp4'?" in result.stderr
    )
    assert "agent.yaml:3:9: error: 'domain' must be a whole number" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    spread_rows(
        [
            ((), "the agent has no transport. Name one, as `microros-gen agent udp4 --port 8888`"),
            (("upd4",), "unknown transport 'upd4'. Did you mean 'udp4'?"),
            (("udp",), "unknown transport 'udp'. Choose udp4 or udp6"),
            (("udp4", "--port", "0", "tpc4"), "unknown transport 'tpc4'. Did you mean 'tcp4'?"),
            (
                ("udp4", "--port", "0", "--domain", "1", "tcp4", "--domain", "2"),
                "--domain has two values, 1 and 2",
            ),
            (("pty", "--discovery"), "discovery needs a UDP or TCP transport"),
            (("udp4", "--limit", "client=1"), "unknown limit 'client'. Did you mean 'clients'?"),
            (("udp4", "--manifest", "none.json"), "none.json cannot be read"),
            (("udp4", "--interface-path", "none"), "the interface path 'none'"),
            (("-c", "none.yaml"), "none.yaml cannot be read: No such file or directory"),
            (
                ("tcp4", "--port", "0", "--bind", "192.0.2.77"),
                "'192.0.2.77' is not an IPv4 address of this machine",
            ),
        ],
        3,
    ),
)
def test_wrong_use_says_what_to_do(arguments: tuple[str, ...], wanted: str, tmp_path: Path) -> None:
    result = run(*arguments, path=tmp_path)
    assert result.returncode == 2, result.stderr
    assert wanted in result.stderr


def test_a_service_manager_is_notified(tmp_path: Path) -> None:
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(str(tmp_path / "notify"))
        manager.settimeout(1)
        notify("READY=1", {"NOTIFY_SOCKET": str(tmp_path / "notify")})
        assert manager.recv(100) == b"READY=1"
    notify("READY=1", {"NOTIFY_SOCKET": str(tmp_path / "notify")})  # it is gone
    notify("READY=1", {})


def test_the_watchdog_is_fed_twice_in_its_period() -> None:
    sent: list[str] = []
    care = watchdog({"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": str(os.getpid())}, sent.append)
    counts = []
    for tenths in range(1000, 1030):
        care(tenths / 10)
        counts.append(len(sent))
    assert (counts[0], counts[9], counts[10], counts[-1]) == (1, 1, 2, 3)
    assert set(sent) == {"WATCHDOG=1"}


@pytest.mark.parametrize(
    "environ",
    [
        {},
        {"WATCHDOG_USEC": "0"},
        {"WATCHDOG_USEC": "1e6"},
        {"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": "1"},
    ],
)
def test_nothing_is_sent_without_a_watchdog(environ: dict[str, str]) -> None:
    sent: list[str] = []
    watchdog(environ, sent.append)(1000.0)
    assert sent == []


@pytest.mark.ros
def test_an_agent_feeds_the_watchdog_of_its_service(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only while its main loop runs: a stopped process says nothing."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(str(tmp_path / "notify"))
        manager.settimeout(seconds(10))
        monkeypatch.setenv("NOTIFY_SOCKET", str(tmp_path / "notify"))
        monkeypatch.setenv("WATCHDOG_USEC", "400000")
        with running_agent(DOMAIN) as agent:
            reported = [manager.recv(100) for _ in range(3)]
            assert reported == [b"READY=1", b"WATCHDOG=1", b"WATCHDOG=1"]
            agent.process.send_signal(signal.SIGSTOP)
            os.waitpid(agent.process.pid, os.WUNTRACED)  # it stands still
            manager.setblocking(False)
            with suppress(BlockingIOError):
                while manager.recv(100):
                    pass
            manager.settimeout(1.0)
            with pytest.raises(TimeoutError):
                manager.recv(100)
            agent.process.send_signal(signal.SIGCONT)
            manager.settimeout(seconds(10))
            assert manager.recv(100) == b"WATCHDOG=1"


UNIT = ROOT / "examples/agent/microros-agent.service"


def test_the_unit_of_systemd_is_sound(tmp_path: Path) -> None:
    """As systemd reads it, with a program that exists in place of the installed one."""
    if shutil.which("systemd-analyze") is None:
        pytest.skip("no systemd-analyze: apt-get install systemd")
    text, count = re.subn(r"(?m)^ExecStart=\S+", f"ExecStart={sys.executable}", UNIT.read_text())
    assert count == 1
    unit = tmp_path / UNIT.name
    unit.write_text(text)
    done = subprocess.run(
        ["systemd-analyze", "verify", str(unit)],
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(30),
    )
    complaints = [line for line in done.stderr.splitlines() if UNIT.name in line]
    assert (done.returncode, complaints) == (0, []), done.stderr
    broken = tmp_path / "broken.service"
    broken.write_text(text.replace("ProtectSystem=strict", "ProtectSystem=tight"))
    other = subprocess.run(
        ["systemd-analyze", "verify", str(broken)],
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(30),
    )
    assert "protect system" in other.stderr


def test_the_unit_starts_the_agent_with_options_that_there_are() -> None:
    (line,) = re.findall(r"(?m)^ExecStart=\S+ agent (.*)$", UNIT.read_text())
    result = run(*line.replace("/etc/microros/agent.yaml", str(ROOT / "examples/agent/none.yaml")).split())
    assert "none.yaml cannot be read" in result.stderr
    assert re.search(r"(?m)^Type=notify$", UNIT.read_text())
    assert re.search(r"(?m)^WatchdogSec=\d+$", UNIT.read_text())


def test_the_unit_allows_the_sockets_of_each_transport() -> None:
    """The families that the agent's sources name, and netlink for DDS: no more, no less."""
    sources = (ROOT / "microros_gen/agent").rglob("*.py")
    named = {name for path in sources for name in re.findall(r"\bAF_[A-Z0-9]+\b", path.read_text())}
    (line,) = re.findall(r"(?m)^RestrictAddressFamilies=(.*)$", UNIT.read_text())
    assert "AF_CAN" in named
    assert sorted(line.split()) == sorted(named | {"AF_NETLINK"})


def test_the_unit_lets_fast_dds_set_the_schedule_of_its_threads() -> None:
    """Otherwise it logs an error for each of the seven threads of a participant."""
    lines = re.findall(r"(?m)^SystemCallFilter=(.*)$", UNIT.read_text())
    assert lines[:2] == ["@system-service", "~@privileged @resources"]
    assert {"sched_setscheduler", "setpriority"} <= set(lines[-1].split())
    assert "RestrictRealtime=yes" in UNIT.read_text()
