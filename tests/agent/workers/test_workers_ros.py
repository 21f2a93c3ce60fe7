# SPDX-License-Identifier: Apache-2.0
"""`--workers`: clients of all transports, in processes, with rclpy; one that is killed, one that hangs, and the end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from microros_gen.agent.monitoring.asking import ask
from microros_gen.agent.wire.session_messages import Info
from tests.support.agent.client import BEST_EFFORT, XrceClient, connected, int32_body
from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain
from tests.support.agent.ros_client import INT32
from tests.support.agent.serial_link import SerialLink
from tests.support.agent.tcp_link import TcpLink
from tests.support.agent.worker_agents import Running, clients, ended, running
from tests.support.patience import deadline

pytestmark = [pytest.mark.ros, pytest.mark.system]


@pytest.fixture(scope="module")
def shared() -> Iterator[Running]:
    with running() as agent:
        yield agent


def test_clients_of_every_transport_in_two_workers() -> None:
    """Each key is served by its worker, over whichever transport, and rclpy sees every sample in its order."""
    domain = own_domain()
    with ExitStack() as stack:
        running_one = stack.enter_context(running("tcp4", "--port", "0", "pty", "--diagnostics"))
        agent = running_one.agent
        tcp = int(running_one.logged("ready: tcp4").rpartition(":")[2])
        device = running_one.logged("ready: serial")
        observer = stack.enter_context(observing(domain))
        observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", reliable=True)
        links: list[int | TcpLink | SerialLink] = [
            agent.port,
            agent.port,
            TcpLink("127.0.0.1", tcp),
            TcpLink("127.0.0.1", tcp),
            SerialLink(device),
        ]
        opened = [stack.enter_context(XrceClient(link, key=key)) for key, link in enumerate(links, 1)]  # type: ignore[arg-type]
        writers = []
        for key, client in enumerate(opened, 1):
            assert client.connect() == 0
            writers.append(client.publisher(f"node{key}", f"numbers{key}", INT32, domain))
            observer.subscribe(f"/numbers{key}", INT32, reliable=True)
            client.wait_until_subscribed(writers[-1], int32_body(-1), observer, f"/numbers{key}")
        for value in range(100):
            for client, writer in zip(opened, writers, strict=True):
                client.write(writer, int32_body(value))
        for client in opened:
            client.drain()
        numbers = {f"/numbers{key}": [] for key in range(1, 6)}  # type: dict[str, list[int]]
        diagnosed: set[str] = set()
        end = deadline(15)
        while (any(len(n) < 100 for n in numbers.values()) or len(diagnosed) < 5) and time.monotonic() < end:
            for topic, sample in observer.ask(do="samples"):
                if topic == "/diagnostics":
                    diagnosed = diagnosed | {status["hardware_id"] for status in sample["status"]}
                elif sample["data"] >= 0:
                    numbers[topic].append(sample["data"])
            time.sleep(0.05)
        assert numbers == {topic: list(range(100)) for topic in numbers}
        assert diagnosed == {f"{key:08X}" for key in range(1, 6)}
        known = clients(running_one.until(lambda s: len(s["clients"]) == 5))
        assert {key: client["worker"] for key, client in known.items()} == {
            f"{key:08X}": key % 2 + 1 for key in range(1, 6)
        }
        assert known["00000003"]["transport"].startswith("tcp4")
        assert known["00000005"]["transport"].startswith("serial")
        assert known["00000001"]["nodes"] == ["/node1"]


def test_a_client_that_moves_keeps_its_worker_and_its_session(shared: Running) -> None:
    """The header of its messages has the key: the front passes them on from whichever address."""
    with XrceClient(shared.port, key=0x11, session=0x01) as client:
        assert client.connect() == 0
        client.publisher("moves", "moves", INT32, own_domain())
        for _ in range(3):
            before = client.socket
            client.socket = moved = connected(shared.port)
            before.close()
            assert client.ping() == 1
        place = ":".join(map(str, moved.getsockname()))
        known = shared.client("00000011", address=place)
        assert (known["worker"], known["sessions"], known["nodes"]) == (2, 1, ["/moves"])


@pytest.mark.parametrize(("first_session", "session"), [(0x81, 0x82), (0x81, 0x81), (0x01, 0x01)])
def test_another_key_at_an_address_has_its_own_worker(
    shared: Running, first_session: int, session: int
) -> None:
    """As a board with random keys that restarts: the worker of the first key had its own socket for the address."""
    old, new = (f"{first_session:02X}{session:02X}002{last}" for last in (1, 2))
    with XrceClient(shared.port, key=int(old, 16), session=first_session) as first:
        assert first.connect() == 0
        first.publisher("first", "first", INT32, own_domain())
        shared.client(old, worker=2)
        second = XrceClient(shared.port, key=int(new, 16), session=session)
        second.socket.close()
        second.socket = first.socket
        assert second.connect() == 0
        writer = second.publisher("second", "second", INT32, own_domain())
        for value in range(100):
            second.write(writer, int32_body(value))
        second.drain()
        shared.client(old, state="gone")
        shared.client(new, state="connected", worker=1)


def test_a_refused_client_does_not_end_the_one_at_its_address(tmp_path: Path) -> None:
    """Anyone can send a CREATE_CLIENT with that address; the policy, or its content, refuses this one."""
    policy = tmp_path / "policy.yaml"
    policy.write_text("version: 1\nclients:\n  - name: some\n    keys: ['0x00000003', '0x00000004']\n")
    with running("--policy", str(policy)) as agent, XrceClient(agent.port, key=3) as first:
        assert first.connect() == 0
        assert first.ping() == 1, "it is in session, and its worker has a socket for it"
        for key, mtu, status in ((2, 512, 0x83), (4, 1, 0x85)):
            forged = XrceClient(agent.port, key=key, mtu=mtu)
            forged.socket.close()
            forged.socket = first.socket
            assert forged.connect() == status
            assert first.ping() == 1
        agent.client("00000003", state="connected", sessions=1)


def test_no_sample_is_lost_or_overtaken_while_clients_connect_and_leave(shared: Running) -> None:
    """Between bind and connect a socket of one worker gets datagrams of clients of the other one."""
    domain = own_domain()
    with ExitStack() as stack:
        steady = [stack.enter_context(XrceClient(shared.port, key=0x30 + n)) for n in range(4)]
        writers = []
        for number, client in enumerate(steady):
            assert client.connect() == 0
            writers.append(client.publisher(f"steady{number}", f"steady{number}", INT32, domain))
        for round_ in range(30):
            visitor = XrceClient(shared.port, key=0x40 + round_)
            assert visitor.connect() == 0
            for client, writer in zip(steady, writers, strict=True):
                client.write(writer, int32_body(round_), BEST_EFFORT)
            assert (
                visitor.create(0x11, 1, b"", 0) != 0 or visitor.ping() == 1
            )  # its first message opens the session
            for client, writer in zip(steady, writers, strict=True):
                client.write(writer, int32_body(round_), BEST_EFFORT)
            visitor.leave()
            visitor.socket.close()
        for client in steady:
            assert client.ping() == 1
        for number in range(4):
            assert shared.client(f"{0x30 + number:08X}", nodes=[f"/steady{number}"])["lost"] == 0


def test_a_killed_worker_is_started_again_and_only_its_clients_notice() -> None:
    domain = own_domain()
    with ExitStack() as stack:
        agent = stack.enter_context(running("--metrics", "0", "tcp4", "--port", "0"))
        page = agent.logged("metrics: ")
        tcp = int(agent.logged("ready: tcp4").rpartition(":")[2])
        even, odd = (stack.enter_context(XrceClient(agent.port, key=key)) for key in (2, 3))
        over_tcp = stack.enter_context(XrceClient(TcpLink("127.0.0.1", tcp), key=4))  # type: ignore[arg-type]
        for number, client in enumerate((even, odd, over_tcp)):
            assert client.connect() == 0
            client.publisher(f"killed{number}", f"killed{number}", INT32, domain)
        before = agent.until(lambda s: len(s["clients"]) == 3)
        killed, kept = agent.pid(1), agent.pid(2)
        os.kill(killed, signal.SIGKILL)
        agent.agent.wait_for("worker 1 ended (signal SIGKILL)")
        agent.client("00000002", state="silent", last_error="worker 1 ended")
        agent.client("00000003", state="connected")
        assert odd.ping() == 1
        agent.agent.wait_for("worker 1 serves again")
        with pytest.raises(ConnectionError):
            over_tcp.take(Info)
        assert even.ping() == 0, "the new worker knows no session"
        assert even.connect() == 0
        writer = even.publisher("again", "again", INT32, domain)
        even.write(writer, int32_body(1))
        even.drain()
        agent.client("00000002", state="connected", nodes=["/again"])
        again = agent.status()
        assert [worker["restarts"] for worker in again["agent"]["workers"]] == [1, 0]
        assert agent.pid(1) != killed
        assert agent.pid(2) == kept
        assert again["agent"]["samples"]["from_clients"] >= before["agent"]["samples"]["from_clients"] + 1
        _, metrics = ask_url(page)
        assert 'microros_agent_worker_restarts_total{worker="1"} 1' in metrics
        assert 'microros_agent_worker_ready{worker="2"} 1' in metrics


def ask_url(url: str) -> tuple[int, str]:
    from urllib.request import urlopen

    with urlopen(url) as answer:
        return answer.status, answer.read().decode()


def test_a_stopped_worker_is_not_ready_and_the_others_answer() -> None:
    with running() as agent:
        assert ask(agent.place, "/readyz") == (200, b"ok\n")
        pid = agent.pid(2)
        os.kill(pid, signal.SIGSTOP)
        stopped = agent.until(
            lambda s: [worker["ready"] for worker in s["agent"]["workers"]] == [True, False]
        )
        assert stopped["agent"]["workers"][1]["pid"] == pid
        assert ask(agent.place, "/healthz") == (200, b"ok\n")
        assert ask(agent.place, "/readyz") == (503, b"worker 2 is not ready\n")
        os.kill(pid, signal.SIGCONT)
        agent.until(lambda s: all(worker["ready"] for worker in s["agent"]["workers"]))


def test_the_end_is_orderly_and_leaves_no_process() -> None:
    """Both kinds of signals to the whole group, as a terminal and a service manager send them."""
    domain = own_domain()
    with running() as agent, XrceClient(agent.port, key=5) as client:
        pids = [agent.pid(1), agent.pid(2)]
        assert client.connect() == 0
        writer = client.publisher("last", "last", INT32, domain)
        client.write(writer, int32_body(1))
        client.drain()
        for pid in pids:
            os.kill(pid, signal.SIGTERM)
            os.kill(pid, signal.SIGINT)
        assert client.ping() == 1, "a worker ends when its front says so"
        assert agent.agent.stop() == 0
        log = agent.agent.rest()
        assert any("agent stopped: 1 samples in" in line and not line.startswith("worker") for line in log)
        assert not any("ended (" in line for line in log)
        assert all(map(ended, pids))


def test_workers_end_with_a_front_that_is_killed() -> None:
    with running() as agent:
        pids = [agent.pid(1), agent.pid(2)]
        agent.agent.process.kill()
        end = deadline(10)
        while not all(map(ended, pids)):
            assert time.monotonic() < end
            time.sleep(0.05)


def test_a_policy_holds_in_all_workers_and_is_read_again(tmp_path: Path) -> None:
    policy = tmp_path / "policy.yaml"
    policy.write_text("version: 1\nclients:\n  - name: some\n    keys: ['0x00000002', '0x00000003']\n")
    with running("--policy", str(policy)) as agent:
        for key, status in ((2, 0), (3, 0), (4, 0x83), (5, 0x83)):
            with XrceClient(agent.port, key=key) as client:
                assert client.connect() == status
        policy.write_text(
            "version: 1\nclients:\n  - name: some\n    keys: [0x4]\n  - name: others\n    keys: [0x5]\n"
        )
        agent.agent.process.send_signal(signal.SIGHUP)
        agent.agent.wait_for("policy: 2 rules")
        for key, status in ((2, 0x83), (3, 0x83), (4, 0), (5, 0)):
            with XrceClient(agent.port, key=key) as client:
                assert client.connect() == status


def test_a_worker_that_starts_again_has_the_policy_in_force(tmp_path: Path) -> None:
    """Not the one in the file, which was refused."""
    policy = tmp_path / "policy.yaml"
    policy.write_text("version: 1\nclients:\n  - name: some\n    keys: ['0x00000002']\n")
    with running("--policy", str(policy)) as agent:
        policy.write_text(
            "version: 1\nclients:\n  - name: some\n    keys: [0x4]\n  - name: others\n    keys: [0x5]\n"
        )
        agent.agent.process.send_signal(signal.SIGHUP)
        agent.agent.wait_for("policy: 2 rules")
        policy.write_text("version: 1\nclients: nobody\n")
        agent.agent.process.send_signal(signal.SIGHUP)
        agent.agent.wait_for("the one before stays in force")
        os.kill(agent.pid(1), signal.SIGKILL)
        agent.agent.wait_for("worker 1 serves again")
        for key, status in ((2, 0x83), (4, 0)):
            with XrceClient(agent.port, key=key) as client:
                assert client.connect() == status


def test_workers_import_nothing_from_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "click.py").write_text("raise SystemExit('from the current folder')\n")
    monkeypatch.chdir(tmp_path)
    program = Path(sys.executable).with_name("microros-gen")
    command = [str(program), "agent", "udp4", "--port", "0", "--workers", "2", "--status-socket", "none"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as agent:
        assert agent.stdout is not None
        lines = []
        for line in agent.stdout:
            lines.append(line)
            if "agent ready" in line:
                agent.send_signal(signal.SIGTERM)
    assert agent.returncode == 0, "".join(lines)
