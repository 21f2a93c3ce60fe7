# SPDX-License-Identifier: Apache-2.0
"""Recordings of tests: what tcpdump, which is not ours, reads in a file."""

from __future__ import annotations

import re
import subprocess
from collections import deque
from collections.abc import Hashable
from pathlib import Path

from microros_gen.agent.recording.recorder import RecordedTransport, Recorder
from tests.support.agent.client import XrceClient
from tests.support.agent.fakes import Bench, FakeTransport
from tests.support.patience import seconds

_PACKET = re.compile(r"(?:\) |\n    )(\S+) > (\S+): (?:\[[^\]]*\] )?UDP, length (\d+)")


def dumped(path: Path) -> list[tuple[str, str, int]]:
    """Return source, destination and number of bytes of every packet, as tcpdump says; checksums hold."""
    done = subprocess.run(
        ["tcpdump", "-nn", "-v", "-r", str(path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds(30),
    )
    assert done.returncode == 0, done.stderr
    assert "bad" not in done.stdout
    found = _PACKET.findall(done.stdout)
    return [(source, destination, int(size)) for source, destination, size in found]


class RecordingBench(Bench):
    """A bench whose messages are recorded; an address is `host:port`."""

    def __init__(self, path: Path, label: str = "udp4 127.0.0.1:8888", **options: object) -> None:
        super().__init__(**options)  # type: ignore[arg-type]
        inner = self.transport
        inner.label = label
        self.recorder = Recorder(path, self.log, clock=lambda: int(self.now * 1e9))
        self.recorder.begin()
        self.recorded = RecordedTransport(inner, self.recorder)

    def tell(self, data: bytes, address: Hashable) -> list[bytes]:
        """Let the agent receive and record a message; return its answers."""
        del self.transport.sent[:]
        self.recorder.write(self.transport, address, data, inbound=True)
        self.agent.receive(data, address, self.recorded)
        self.agent.flush()
        return [answer for _, answer in self.transport.sent]


def fake(label: str = "udp4 127.0.0.1:8888") -> FakeTransport:
    """Return a transport with a label."""
    transport = FakeTransport()
    transport.label = label
    return transport


class BenchLink:
    """What `XrceClient` needs of a socket, to the agent of a bench."""

    def __init__(self, bench: RecordingBench, address: Hashable) -> None:
        self._bench = bench
        self._address = address
        self._answers: deque[bytes] = deque()

    def settimeout(self, seconds: float) -> None:
        """Nothing is waited for."""

    def send(self, data: bytes) -> None:
        """Send a message; its answers can be received."""
        self._answers += self._bench.tell(data, self._address)

    def recv(self, _size: int) -> bytes:
        """Return the next answer."""
        if not self._answers:
            raise TimeoutError
        return self._answers.popleft()

    def close(self) -> None:
        """Nothing is open."""


def record_publisher(path: Path, key: int = 0xA1B2C3D4, session: int = 0x81) -> None:
    """Record a client that creates a writer, sends three samples, one of them in fragments, pings and leaves."""
    bench = RecordingBench(path)
    link = BenchLink(bench, "127.0.0.1:4000")
    with XrceClient(link, key=key, session=session) as client:  # type: ignore[arg-type]
        assert client.connect() == 0
        writer = client.publisher("node", "topic", "std_msgs/msg/String", 0)
        for size in (4, 1500, 8):
            bench.now += 0.5
            client.write(writer, bytes(size))
            client.drain()
        client.ping()
        assert client.leave() == 0
    bench.recorder.close()


def record_visitor(path: Path, label: str, *numbers: int, begins: bool = True) -> None:
    """Record clients on a line or a bus that connect, ping and leave; `begins` False: a ping comes first."""
    bench = RecordingBench(path, label)
    for number in numbers:
        address = f"127.0.0.1:{4000 + number}" if label.startswith("udp") else (label, number)
        link = BenchLink(bench, address)
        with XrceClient(link, key=number) as client:  # type: ignore[arg-type]
            if not begins:
                client.ping(in_session=False)
            assert client.connect() == 0
            client.ping()
            assert client.leave() == 0
    bench.recorder.close()
