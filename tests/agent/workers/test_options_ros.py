# SPDX-License-Identifier: Apache-2.0
"""`--workers` with `--psk-file`, `--record` and `adopt: true`, and forged messages while clients connect."""

from __future__ import annotations

import io
import json
import os
import signal
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.packets import decode
from tests.support.agent.client import BEST_EFFORT, XrceClient, connected, int32_body
from tests.support.agent.entities_file import content
from tests.support.agent.process import own_domain
from tests.support.agent.ros_client import INT32
from tests.support.agent.sealed_link import RECORD, SealedLink, Within
from tests.support.agent.serial_link import SerialLink
from tests.support.agent.tcp_link import TcpLink
from tests.support.agent.worker_agents import Running, running
from tests.support.patience import deadline
from tests.support.slices import first

pytestmark = [pytest.mark.ros, pytest.mark.system]
PSK = {key: bytes(range(key, key + 32)) for key in range(2, 8)}


@contextmanager
def at_the_socket_of(client: XrceClient, key: int, mtu: int = 512) -> Iterator[XrceClient]:
    """Another client that sends from the same address, as a datagram with a forged source does."""
    forged = XrceClient(client.socket, key=key, mtu=mtu)  # type: ignore[arg-type]
    yield forged


def test_a_forged_create_client_changes_nothing_for_who_is_connecting(tmp_path: Path) -> None:
    """Between the answer and the first message in the session only the front knows where it goes."""
    policy = tmp_path / "policy.yaml"
    policy.write_text("version: 1\nclients:\n  - name: some\n    keys: ['0x3-0x7']\n")
    with running("--policy", str(policy)) as agent, ExitStack() as stack:
        for key in (3, 5):
            client = stack.enter_context(XrceClient(agent.port, key=key))
            for refused, mtu, status in ((2, 512, 0x83), (4, 1, 0x85), (8, 512, 0x83)):
                with at_the_socket_of(client, refused, mtu) as forged:
                    assert client.connect() == 0
                    assert forged.connect() == status
                    assert client.ping() == 1, "its next message goes to its worker"
            agent.client(f"{key:08X}", state="connected")
        client = stack.enter_context(XrceClient(agent.port, key=7))
        assert client.connect() == 0
        os.kill(agent.pid(1), signal.SIGKILL)
        agent.agent.wait_for("worker 1 serves again")
        assert client.ping() == 1, "the end of the other worker changes nothing"
        again = stack.enter_context(XrceClient(agent.port, key=4))
        assert again.connect() == 0
        os.kill(agent.pid(1), signal.SIGKILL)
        agent.agent.wait_for("worker 1 serves again")
        assert again.ping() == 0, "its own worker knows no newcomer any more"
        assert again.connect() == 0
        assert again.ping() == 1


def keys_file(path: Path, *keys: int) -> Path:
    path.touch(mode=0o600)
    path.write_text("".join(f"{key:#x} {PSK[key].hex()}\n" for key in keys))
    return path


def test_sealed_clients_of_every_transport_in_two_workers(tmp_path: Path) -> None:
    keys = keys_file(tmp_path / "keys", 2, 3, 4, 5, 6)
    options = ("--psk-file", str(keys), "tcp4", "--port", "0", "pty")
    with running(*options) as agent, ExitStack() as stack:
        tcp = int(agent.logged("ready: tcp4").rpartition(":")[2])
        links: dict[int, Within] = {
            2: connected(agent.port),
            3: connected(agent.port),
            4: TcpLink("127.0.0.1", tcp),
            5: TcpLink("127.0.0.1", tcp),
            6: SerialLink(agent.logged("ready: serial")),
        }
        opened: dict[int, XrceClient] = {}
        for key, within in links.items():
            sealed = SealedLink(within, key, PSK[key])
            opened[key] = client = stack.enter_context(XrceClient(sealed, key=key))  # type: ignore[arg-type]
            assert client.connect() == 0
            writer = client.publisher(f"sealed{key}", f"sealed{key}", INT32, own_domain())
            for value in range(50):
                client.write(writer, int32_body(value))
            client.drain()
            known = agent.client(f"{key:08X}", state="connected", nodes=[f"/sealed{key}"])
            assert known["worker"] == key % 2 + 1
        agent.until(lambda s: s["agent"]["samples"]["from_clients"] == 250)
        plain = stack.enter_context(XrceClient(agent.port, key=2))
        assert plain.connect() == 0x83
        check_replays(agent, opened[2])
        check_that_keys_are_read_again(agent, keys, opened)


def check_replays(agent: Running, client: XrceClient) -> None:
    """What was sent is sent again, from the same address and from another one: it reaches no session."""
    link = client.socket
    assert isinstance(link, SealedLink)
    record = link.record(b"")
    for _ in range(3):
        link.within.send(record)
    with XrceClient(agent.port) as stranger:
        for _ in range(3):
            stranger.socket.send(record)
        wrong = bytearray(record)
        wrong[4] ^= 1  # an index of the other worker
        stranger.socket.send(bytes(wrong))
        link.within.send(bytes(wrong))
    assert record[0] == RECORD
    faults = agent.until(lambda s: s["agent"]["faults"].get("seal_no_session", 0) >= 5)["agent"]["faults"]
    assert faults["seal_replayed"] >= 2
    assert client.ping() == 1


def check_that_keys_are_read_again(agent: Running, keys: Path, opened: dict[int, XrceClient]) -> None:
    """Sessions of unchanged keys go on, a worker that starts again has the new ones, and a fault changes nothing."""
    keys_file(keys, 3, 4, 5, 7)
    agent.agent.process.send_signal(signal.SIGHUP)
    agent.agent.wait_for("sealed: keys of 4 clients")
    agent.client("00000002", state="gone")
    agent.client("00000006", state="gone")
    for key in (3, 4, 5):
        assert opened[key].ping() == 1
    keys.write_text("nothing\n")
    agent.agent.process.send_signal(signal.SIGHUP)
    agent.agent.wait_for("the keys before it stay in force")
    os.kill(agent.pid(2), signal.SIGKILL)
    agent.agent.wait_for("worker 2 serves again")
    with pytest.raises(AssertionError, match="refused"):
        SealedLink(connected(agent.port), 2, PSK[2])
    assert opened[4].ping() == 1
    with XrceClient(SealedLink(connected(agent.port), 7, PSK[7]), key=7) as new:  # type: ignore[arg-type]
        assert new.connect() == 0
        assert new.ping() == 1


def test_a_recording_has_the_messages_of_all_workers_in_their_order(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    with running("--record", str(path), "tcp4", "--port", "0", "pty") as agent, ExitStack() as stack:
        tcp = int(agent.logged("ready: tcp4").rpartition(":")[2])
        line = SerialLink(agent.logged("ready: serial"))
        links = [agent.port, agent.port, TcpLink("127.0.0.1", tcp), line]
        clients = [stack.enter_context(XrceClient(link, key=key)) for key, link in enumerate(links, 2)]  # type: ignore[arg-type]
        writers = []
        for client in clients:
            assert client.connect() == 0
            name = f"recorded{client.key[3]}"
            writers.append(client.publisher(name, name, INT32, own_domain()))
        for value in range(100):
            for client, writer in zip(clients, writers, strict=True):
                client.write(writer, int32_body(value), BEST_EFFORT)
        for client in clients:
            client.ping()
        os.kill(agent.pid(1), signal.SIGKILL)
        agent.agent.wait_for("worker 1 serves again")
        assert clients[0].connect() == 0
        agent.until(lambda s: len(s["clients"]) == 4)
        assert agent.agent.stop() == 0
        rest = agent.agent.rest()
    packets = list(pcapng.read_packets(io.BytesIO(path.read_bytes())))
    times = [packet.time_ns for packet in packets]
    assert times == sorted(times)
    comments = [packet.comment for packet in packets if packet.comment]
    for key in range(2, 6):
        assert f"client {key:08X}: node recorded{key}" in comments
    assert comments.count("client 00000002") == 2, "the worker that started again records, too"
    assert {packet.interface.name.partition(" ")[0] for packet in packets} == {"udp4", "tcp4", "serial"}
    sent = [datagram for packet in packets if packet.direction == 1 and (datagram := decode(packet.data))]
    samples = [each for each in sent if each.message[1:2] == b"\1"]
    assert len(samples) == 400
    assert len({each.source for each in samples}) == 4
    assert any(f"recorded {len(packets)} messages" in each for each in rest)


@pytest.mark.parametrize("key", first([2, 3]))
def test_a_client_of_an_earlier_agent_is_adopted_by_its_worker(tmp_path: Path, key: int) -> None:
    """Its messages name no key; of two to adopt, the other one is in session, at another worker."""
    entities = tmp_path / "entities.json"
    both = content("0x2", adopt=True)
    both["clients"] += content("0x3", adopt=True)["clients"]
    entities.write_text(json.dumps(both))
    with running("--entities", str(entities), "--limit", "adopt_after_s=0.5") as agent, ExitStack() as stack:
        orphan, other = (stack.enter_context(XrceClient(agent.port, key=k)) for k in (key, 5 - key))

        def say_for(s: float) -> None:
            end = time.monotonic() + s
            while time.monotonic() < end:
                orphan.write(5, int32_body(1), BEST_EFFORT)
                time.sleep(0.05)

        say_for(1.5)
        assert agent.status()["clients"] == [], "it may be either of both"
        assert other.connect() == 0
        assert other.ping() == 1
        end = deadline(15)
        while f"{key:08X}" not in {client["key"] for client in agent.status()["clients"]}:
            assert time.monotonic() < end
            say_for(0.2)
        adopted = agent.client(f"{key:08X}", state="connected")
        assert adopted["worker"] == key % 2 + 1
        say_for(0.3)
        agent.until(lambda s: s["agent"]["samples"]["from_clients"] > 3)
