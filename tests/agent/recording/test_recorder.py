# SPDX-License-Identifier: Apache-2.0
"""The recorder: its file in tcpdump, comments, a full disk, a file in use, an agent that is killed."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

import pytest

from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.packets import decode
from microros_gen.agent.recording.recorder import Recorder
from microros_gen.agent.transport.base import SealedAddress
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import UserError
from tests.support.agent import captured
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.command import DOMAIN, run
from tests.support.agent.process import READY, running_agent
from tests.support.agent.recordings import RecordingBench, dumped, fake
from tests.support.agent.serial_link import SerialLink
from tests.support.agent.tcp_link import TcpLink
from tests.support.patience import seconds

CREATE_CLIENT = bytes.fromhex(captured.CREATE_CLIENT)


def test_both_directions_with_the_time_and_names(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    bench = RecordingBench(path)
    node = "81 80 00 00 01 07 1e 00 00 0a 00 11 01 03 00 00 10 00 00 00 00 01 00 00 08 00 00 00"
    node += " 6d 79 5f 6e 6f 64 65 00 4d 00"
    (status,) = bench.tell(CREATE_CLIENT, "127.0.0.1:4000")
    bench.now += 1.5
    bench.tell(bytes.fromhex(node), "127.0.0.1:4000")
    found = list(pcapng.read_packets(BytesIO(path.read_bytes())))
    assert [packet.comment for packet in found[:3]] == [
        "client A1B2C3D4",
        "",
        "client A1B2C3D4: node my_node",
    ]
    assert [packet.direction for packet in found[:3]] == [1, 2, 1]
    assert found[2].time_ns - found[0].time_ns == 1_500_000_000
    answer = decode(found[1].data)
    assert answer is not None
    assert answer.message == status
    shown = dumped(path)
    assert shown[:2] == [
        ("127.0.0.1.4000", "127.0.0.1.8888", len(CREATE_CLIENT)),
        ("127.0.0.1.8888", "127.0.0.1.4000", len(status)),
    ]
    assert len(shown) == len(found)


def test_an_interface_for_each_transport(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    recorder = Recorder(path, RecordingBench(tmp_path / "other").log)
    recorder.begin()
    recorder.write(fake("serial /dev/ttyUSB0"), ("serial /dev/ttyUSB0", 3), b"x" * 20, inbound=True)
    recorder.write(fake("canfd can0"), ("canfd can0", 0x1FFF_FFFF), b"y" * 9, inbound=False)
    recorder.write(fake("udp6 [::1]:8888"), "[::2]:99", b"", inbound=True)
    sealed = SealedAddress(("serial /dev/ttyUSB0", 4), 0xA1B2C3D4)
    recorder.write(fake("serial /dev/ttyUSB0"), sealed, b"z", inbound=True)
    recorder.close()
    assert [p.interface.name for p in pcapng.read_packets(BytesIO(path.read_bytes()))] == [
        "serial /dev/ttyUSB0",
        "canfd can0",
        "udp6 [::1]:8888",
        "serial /dev/ttyUSB0",
    ]
    agent = "fd58:5243:4500::1:0:0.8888"
    assert dumped(path) == [
        ("fd58:5243:4500::3.8888", agent, 20),
        (agent, "fd58:5243:4500::1fff:ffff.8888", 9),
        ("::2.99", "::1.8888", 0),
        ("fd58:5243:4500::4.8888", agent, 1),
    ]


@contextmanager
def largest_file(size: int) -> Iterator[None]:
    """Let no file of this process grow beyond `size` bytes meanwhile, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)


def test_a_full_disk_stops_nothing(tmp_path: Path) -> None:
    """The packets in the file are whole; lost ones are counted, reported once and noted in the next packet."""
    path = tmp_path / "a.pcapng"
    bench = RecordingBench(path)
    with largest_file(1000):
        for _ in range(20):
            assert bench.tell(CREATE_CLIENT, "127.0.0.1:4000"), "the agent answers"
    written = list(pcapng.read_packets(BytesIO(path.read_bytes())))
    assert 2 < len(written) == bench.recorder.written < 40
    assert bench.recorder.lost == 40 - len(written)
    assert bench.text.getvalue().count("takes no more") == 1
    assert len(dumped(path)) == len(written)
    bench.tell(CREATE_CLIENT, "127.0.0.1:4000")
    more = list(pcapng.read_packets(BytesIO(path.read_bytes())))[len(written) :]
    assert [packet.dropped for packet in more] == [40 - len(written), 0]
    bench.recorder.close()
    assert f"{len(written) + 2} messages in {path}; {40 - len(written)} lost" in bench.text.getvalue()


def test_malformed_messages_are_recorded_too(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    bench = RecordingBench(path)
    messages = [b"", b"\x81", b"\x80\0\0\0\0\1\xff\xff", b"\x81\x80\0\0\1\1\x08\0" + bytes(8)]
    messages += [CREATE_CLIENT[:size] for size in range(len(CREATE_CLIENT))]
    for message in messages:
        bench.recorder.write(bench.transport, "127.0.0.1:4000", message, inbound=True)
    found = [decode(packet.data) for packet in pcapng.read_packets(BytesIO(path.read_bytes()))]
    assert [datagram.message for datagram in found if datagram] == messages


@pytest.mark.parametrize("name", ["missing/a.pcapng", ".", "pipe"])
def test_a_file_that_cannot_be_written(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(UserError, match="MG-9793"):
        Recorder(tmp_path / name, RecordingBench(tmp_path / "other").log)


def test_a_recording_stays_until_the_next_one_begins(tmp_path: Path) -> None:
    old, new = tmp_path / "old.pcapng", tmp_path / "new.pcapng"
    old.write_bytes(b"precious")
    log = RecordingBench(tmp_path / "other").log
    for path in (old, new):
        Recorder(path, log).give_up()
    assert old.read_bytes() == b"precious"
    assert not new.exists()
    recorder = Recorder(old, log)
    assert old.read_bytes() == b"precious"
    recorder.begin()
    recorder.close()
    assert list(pcapng.read_packets(BytesIO(old.read_bytes()))) == []


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.parametrize(
    "option", ["--metrics", pytest.param("--page", marks=pytest.mark.variant), "--status-socket"]
)
def test_an_agent_that_cannot_start_leaves_an_existing_recording(tmp_path: Path, option: str) -> None:
    path = tmp_path / "a.pcapng"
    path.write_bytes(b"precious")
    with socket.create_server(("127.0.0.1", 0)) as busy:
        port = busy.getsockname()[1]
        place = str(tmp_path / "no" / "folder") if option == "--status-socket" else str(port)
        done = run("--record", str(path), option, place, "udp4", "--port", "0")
    assert done.returncode == 2
    assert ("[MG-9788]" if option == "--status-socket" else "[MG-9792]") in done.stderr
    assert path.read_bytes() == b"precious"


def test_a_file_of_another_agent_stays(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    bench = RecordingBench(path)
    bench.tell(CREATE_CLIENT, "127.0.0.1:4000")
    before = path.read_bytes()
    with pytest.raises(UserError, match="another agent writes it"):
        Recorder(path, bench.log)
    assert path.read_bytes() == before


def test_tshark_names_clients(tmp_path: Path) -> None:
    if shutil.which("tshark") is None:
        pytest.skip("no tshark: apt-get install tshark")
    path = tmp_path / "a.pcapng"
    RecordingBench(path).tell(CREATE_CLIENT, "127.0.0.1:4000")
    fields = [f"-e{name}" for name in ("frame.comment", "frame.interface_name", "udp.payload")]
    command = ["tshark", "-r", str(path), "-T", "fields", *fields]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=seconds(60))
    assert done.stdout.splitlines()[0].split("\t") == [
        "client A1B2C3D4",
        "udp4 127.0.0.1:8888",
        CREATE_CLIENT.hex(),
    ]


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
def test_an_agent_of_every_transport_that_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "a.pcapng"
    transports = ("udp4", "--port", "0", "udp6", "--port", "0", "tcp4", "--port", "0", "pty")
    with running_agent(DOMAIN, transport=("record", "-o", str(path), *transports)) as agent:
        places = [agent.wait_for(READY).rpartition(" ")[2] for _ in range(3)]
        first, second = (int(place.rpartition(":")[2]) for place in places[:2])
        udp6 = socket.socket(socket.AF_INET6, socket.SOCK_DGRAM)
        udp6.connect(("::1", first))
        port = int(agent.device.rpartition(":")[2])
        counts = []
        for key, link in enumerate((port, udp6, TcpLink("127.0.0.1", second), SerialLink(places[2])), 1):
            with XrceClient(link, key=key) as client:  # type: ignore[arg-type]
                assert client.connect() == 0
                writer = client.publisher(f"node_{key}", "recorded", "std_msgs/msg/Int32", DOMAIN)
                client.write(writer, int32_body(key))
                client.drain()
            counts.append(len(dumped(path)))
        agent.stop(signal.SIGKILL)
    assert counts == sorted(set(counts))
    found = list(pcapng.read_packets(BytesIO(path.read_bytes())))
    assert len(dumped(path)) == len(found) >= counts[-1]
    comments = [packet.comment for packet in found if "node" in packet.comment]
    assert comments == [f"client 0000000{key}: node node_{key}" for key in (1, 2, 3, 4)]
    assert len({packet.interface.name for packet in found}) == 4


def test_an_agent_says_that_it_cannot_record(tmp_path: Path) -> None:
    done = run("udp4", "--port", "0", "--record", str(tmp_path / "missing/a.pcapng"))
    assert done.returncode == 2
    assert "missing/a.pcapng cannot be written: No such file or directory" in done.stderr
    assert "[MG-9793]" in done.stderr


def test_the_file_is_named_in_the_configuration(tmp_path: Path) -> None:
    config = tmp_path / "agent.yaml"
    config.write_text("version: 1\ntransports: [udp4: {port: 0}]\nrecord: missing/a.pcapng\n")
    done = run("--config", str(config))
    assert done.returncode == 2
    assert f"{config}:3:9" in done.stderr
    assert "MG-9793" in done.stderr
    assert AgentOptions().record is None
