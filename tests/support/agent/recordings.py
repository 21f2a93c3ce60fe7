# SPDX-License-Identifier: Apache-2.0
"""Recordings of tests: what tcpdump, which is not ours, reads in a file."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from microros_gen.agent.recording.recorder import RecordedTransport, Recorder
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
        self.recorded = RecordedTransport(inner, self.recorder)

    def tell(self, data: bytes, address: str) -> list[bytes]:
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
