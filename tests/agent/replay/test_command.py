# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent replay` as a program: towards an agent, towards a client, over every transport, wrong use."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.command import DOMAIN, run
from tests.support.agent.process import running_agent
from tests.support.agent.recordings import record_publisher, record_visitor
from tests.support.e2e.can_bus import CanBus
from tests.support.free_ports import free_port
from tests.support.patience import seconds
from tests.support.slices import first


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
def test_a_failure_of_the_field_is_replayed(tmp_path: Path) -> None:
    """A client met a limit of the agent; the same agent answers alike, one with more room otherwise."""
    path = tmp_path / "failure.pcapng"
    limit = ("--limit", "objects=3")
    with (
        running_agent(DOMAIN, *limit, "--record", str(path)) as agent,
        XrceClient(agent.port) as client,
    ):
        assert client.connect() == 0
        with pytest.raises(AssertionError, match="0x87"):
            client.publisher("node", "replayed", "std_msgs/msg/Int32", DOMAIN)
        client.leave()
    with running_agent(DOMAIN, *limit) as agent:
        same = run("replay", str(path), "--at", f"udp4:127.0.0.1:{agent.port}", "--speed", "4")
    assert same.stdout.startswith("client A1B2C3D4 (udp4 ")
    assert same.stdout.endswith(" answers as recorded\n")
    assert same.returncode == 0
    with running_agent(DOMAIN) as agent:
        fixed = run("replay", str(path), "--at", f"udp4:127.0.0.1:{agent.port}", "--fast")
    assert "STATUS: status 135 was recorded, 0 was received" in fixed.stdout
    assert fixed.returncode == 1


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
def test_the_samples_of_a_recording_reach_ros_again(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    with (
        running_agent(DOMAIN, "--record", str(path)) as agent,
        XrceClient(agent.port) as client,
    ):
        assert client.connect() == 0
        writer = client.publisher("node", "replayed", "std_msgs/msg/Int32", DOMAIN)
        for value in range(20):
            client.write(writer, int32_body(value))
        client.drain()
        client.leave()
    with running_agent(DOMAIN) as agent:
        done = run("replay", str(path), "--fast", "--at", f"udp4:127.0.0.1:{agent.port}")
        assert done.returncode == 0, done.stdout
        assert agent.stop() == 0
        assert "agent stopped: 20 samples in" in agent.wait_for("agent stopped")


def both_sides(path: Path, server: str, client: str) -> list[str]:
    """Replay a recording with one process for each side; return what they print."""
    program = [sys.executable, "-m", "microros_gen", "agent", "replay", str(path), "--fast", "--wait", "9"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    agent = subprocess.Popen([*program, "--side", "agent", "--at", server], **pipes)  # type: ignore[call-overload]
    try:
        assert "agent ready" in agent.stderr.readline()
        played = subprocess.run(
            [*program, "--at", client], capture_output=True, text=True, check=False, timeout=seconds(30)
        )
        out, _ = agent.communicate(timeout=seconds(30))
    finally:
        agent.kill()
        agent.wait()
    assert (played.returncode, agent.returncode) == (0, 0), played.stdout + played.stderr + out
    return [played.stdout, out]


@pytest.mark.parametrize("kind", first(["udp4", "tcp6", "udp6", "tcp4"], 2))
def test_both_sides_over_a_network(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "a.pcapng"
    record_publisher(path)
    place = f"{kind}:{'127.0.0.1' if kind.endswith('4') else '[::1]'}:{free_port()}"
    for shown in both_sides(path, place, place):
        assert shown.startswith("client A1B2C3D4 (udp4 127.0.0.1:8888): ")


def test_both_sides_over_a_serial_line(tmp_path: Path) -> None:
    path, link = tmp_path / "a.pcapng", tmp_path / "line"
    record_publisher(path)
    both_sides(path, f"pty:{link}", f"serial:{link}")


def test_both_sides_over_a_can_bus(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    record_visitor(path, "canfd can0", 0x7F)
    with CanBus() as bus:
        both_sides(path, f"canfd:{bus.device}", f"canfd:{bus.device}")
        assert bus.identifiers() == {0x7F}


def test_two_clients_of_a_line(tmp_path: Path) -> None:
    path, link = tmp_path / "a.pcapng", tmp_path / "line"
    record_visitor(path, "serial /dev/ttyUSB0", 1, 2)
    for shown in both_sides(path, f"pty:{link}", f"serial:{link}"):
        assert sorted(line[:15] for line in shown.splitlines()) == ["client 00000001", "client 00000002"]


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (("missing.pcapng",), "missing.pcapng cannot be replayed: No such file or directory"),
        (("text.pcapng",), "does not begin with a section header"),
        (("a.pcapng", "--client", "0x7"), "a.pcapng has no client 0x7. It has A1B2C3D4 [MG-9798]"),
        (("a.pcapng", "--at", "here"), "'here' is not the place of an agent"),
        (("a.pcapng", "--at", "udp4:127.0.0.1"), "MG-9799"),
        (("a.pcapng", "--at", "tcp4:127.0.0.1:1"), "tcp4 127.0.0.1:1 cannot be reached: Connection refused"),
        (("a.pcapng", "--at", "serial:/dev/null"), "MG-9797"),
        (("a.pcapng", "--speed", "0"), "--speed"),
        (("a.pcapng", "udp4"), "unexpected extra argument"),
        (("a.pcapng", "--skip", "NOTHING"), "NOTHING"),
    ],
)
def test_wrong_use(tmp_path: Path, words: tuple[str, ...], shown: str) -> None:
    record_publisher(tmp_path / "a.pcapng")
    (tmp_path / "text.pcapng").write_text("no blocks, only words")
    done = run("replay", *words, path=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert shown in done.stderr


@pytest.mark.parametrize(("before", "removed"), [("udp4", "'udp4'"), ("--domain=3", "--domain")])
def test_it_starts_no_agent(tmp_path: Path, before: str, removed: str) -> None:
    record_publisher(tmp_path / "a.pcapng")
    done = run(before, "replay", str(tmp_path / "a.pcapng"))
    assert done.returncode == 2
    assert f"'replay' plays a recording and starts no agent: remove {removed}" in done.stderr


def test_packets_outside_of_sessions_are_counted(tmp_path: Path) -> None:
    """And nobody answers at the port."""
    path = tmp_path / "a.pcapng"
    record_visitor(path, "udp4 127.0.0.1:8888", 1, begins=False)
    done = run("replay", str(path), "--fast", "--wait", "0.3", "--at", f"udp4:127.0.0.1:{free_port()}")
    assert done.stderr == "2 packets are outside of sessions that the file has from their start\n"
    assert done.stdout.endswith(": packet 4: STATUS_AGENT did not come within 0.3 s\n")
    assert done.returncode == 1
