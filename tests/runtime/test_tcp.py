# SPDX-License-Identifier: Apache-2.0
"""TCP over real connections: a length before each message, whatever the segments, and a connection that breaks."""

from __future__ import annotations

import socket
import subprocess
import time
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.patience import seconds
from tests.support.plans import POOL, changed
from tests.support.runtime.harness import build, components, render
from tests.support.runtime.tcp import Sender, TcpAgent, framed, serving, together
from tests.support.runtime.udp import UdpAgent
from tests.support.slices import first

PLAN = changed(
    POOL,
    transport__kind="tcp",
    times__connect_timeout_ms=3000,
    times__create_timeout_ms=3000,
    times__liveliness_period_ms=50,
)


def byte_by_byte(peer: socket.socket, answers: list[bytes]) -> None:
    """Send each byte in a separate segment."""
    for byte in b"".join(map(framed, answers)):
        peer.sendall(bytes([byte]))
        time.sleep(0.0002)


def with_rubbish(peer: socket.socket, answers: list[bytes]) -> None:
    """Send, before each answer, a message without bytes and one that is larger than the client's input."""
    for answer in answers:
        peer.sendall(framed(b"") + framed(b"\x81" + bytes(4999)) + framed(answer))


def run(plan: RuntimePlan, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run c/udp.c, which publishes 0 to 99 over whatever transport there is, with sanitizers."""
    program = build(render(folder, plan, components(plan)), ["types.c", "udp.c"], "udp")
    return subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)


@pytest.mark.parametrize(
    ("send", "read"), [(together, 4096), (byte_by_byte, 4096), (together, 1), (with_rubbish, 4096)]
)
def test_whatever_the_segments(send: Sender, read: int, tmp_path: Path) -> None:
    with serving(TcpAgent(send, read)) as agent:
        done = run(changed(PLAN, transport__agent_port=agent.port), tmp_path)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))
    assert agent.connections == 1
    assert not agent.agent.connected, "it took its leave"


@pytest.mark.parametrize("liveliness", ["ping", "none"])
@pytest.mark.parametrize("close_at", first([(12, 30, 31, 80), (12,), (1, 2)]))
def test_a_closed_connection_is_opened_again(
    close_at: tuple[int, ...], liveliness: str, tmp_path: Path
) -> None:
    """The agent closes it and forgets; without liveliness, too, the client reconnects."""
    plan = changed(PLAN, streams__on_full="block", streams__on_full_block_ms=50)
    with serving(TcpAgent()) as agent:
        agent.before = lambda count: count not in close_at
        plan = changed(plan, transport__agent_port=agent.port)
        tree = render(tmp_path, plan, components(plan, liveliness))
        program = build(tree, ["types.c", "udp.c"], "udp")
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.connections == 1 + len(close_at)
    values = agent.agent.values()
    assert sorted(set(values)) == list(range(100))
    assert values[-1] == 99


def test_a_broken_connection_is_reported_as_such(tmp_path: Path) -> None:
    plan = changed(PLAN, streams__on_full="block", streams__on_full_block_ms=50, session__has_state=True)
    with serving(TcpAgent()) as agent:
        agent.before = lambda count: count != 30
        plan = changed(plan, transport__agent_port=agent.port)
        tree = render(tmp_path, plan, components(plan))
        program = build(tree, ["types.c", "watched.c"], "watched")
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    connecting, connected, lost, reconnecting, closed = "1 0", "2 0", "3 4", "4 0", "0 0"
    assert done.stdout.splitlines() == [connecting, connected, lost, reconnecting, connected, closed]


def test_a_slow_peer_blocks_no_other(tmp_path: Path) -> None:
    """It reads a few bytes at a time, with pauses; nothing is lost and nothing is cut."""
    with serving(TcpAgent(read=16, pause_s=0.002)) as agent:
        done = run(
            changed(
                PLAN,
                transport__agent_port=agent.port,
                streams__on_full="block",
                streams__on_full_block_ms=200,
            ),
            tmp_path,
        )
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert agent.agent.values() == list(range(100))
    assert agent.agent.spoiled == 0


@pytest.mark.parametrize("transport", ["tcp", "udp"])
def test_ipv6(transport: str, tmp_path: Path) -> None:
    if transport == "tcp":
        with serving(TcpAgent(host="::1")) as agent:
            done = run(changed(PLAN, transport__agent_host="::1", transport__agent_port=agent.port), tmp_path)
    else:
        udp = UdpAgent("::1")
        udp.start()
        done = run(
            changed(PLAN, transport__kind="udp", transport__agent_host="::1", transport__agent_port=udp.port),
            tmp_path,
        )
        udp.stop()
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert (agent if transport == "tcp" else udp).agent.values() == list(range(100))


@pytest.mark.parametrize(
    ("host", "place"), [("127.0.0.1", "127.0.0.1"), pytest.param("::1", "[::1]", marks=pytest.mark.variant)]
)
def test_no_listener(host: str, place: str, tmp_path: Path) -> None:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as taken:
        taken.bind((host, 0))
        port = taken.getsockname()[1]
        done = run(
            changed(
                PLAN, transport__agent_host=host, transport__agent_port=port, times__connect_timeout_ms=200
            ),
            tmp_path,
        )
    assert done.returncode == 2
    assert done.stdout in (
        f"no transport to {place}:{port}\n",
        f"no agent answers at {place}:{port} within 200 ms\n",
    )


@pytest.mark.parametrize("host", first(["localhost", "1.2.3", "::g", ""]))
def test_what_is_no_address_in_digits(host: str, tmp_path: Path) -> None:
    done = run(changed(PLAN, transport__agent_host=host, times__connect_timeout_ms=50), tmp_path)
    assert done.returncode == 2
    assert done.stdout.startswith("no transport to ")
