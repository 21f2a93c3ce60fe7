# SPDX-License-Identifier: Apache-2.0
"""The table of attacks: what each does to an honest client, to a new one, and to the agent; and all of them at once.

The honest client sends a sample each 20 ms on a reliable stream, an rclpy process sends it back, and the client gets it
on a reliable stream: that is a round trip. Each line has its own agent.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import select
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Create
from tests.bench.agent_attackers import ATTACKS
from tests.support.agent.client import (
    dds_type,
    int32_body,
    participant_blob,
    reader_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.process import environment
from tests.support.agent.soak_client import SoakClient
from tests.support.agent.soak_links import UdpLink

HERE = Path(__file__).resolve().parent
INT32 = dds_type("std_msgs/msg/Int32")
KEEP_ALL = 1
EVERY_S = 0.02
SETTLE_S, GRACE_S, TRY_S = 1.0, 5.0, 0.5
HONEST, NEW = 0x0A0A0A0A, 0x0B0B0B0B
ALL = "all"
TRANSPORTS = ("udp4", "--port", "0", "tcp4", "--port", "0")


@dataclass
class Line:
    """What one attack did."""

    attack: str
    sessions_lost: int
    samples: int
    lost: int
    trips_ms: list[float] = field(repr=False)
    new_s: float
    memory_mb: float
    descriptors: int
    processor: float
    log_bytes: int
    limit_mb: float
    """The memory that the agent said at its start not to exceed; infinite: none."""

    def trip_ms(self, share: float) -> float:
        """Return the round trip that this share of all is not slower than; what never came is infinite."""
        ordered = sorted([*self.trips_ms, *[math.inf] * self.lost])
        return ordered[min(len(ordered) - 1, int(share * len(ordered)))]

    def __str__(self) -> str:
        new = f"{self.new_s:6.2f}" if self.new_s < math.inf else "  none"
        return (
            f"    {self.attack:<6} {self.sessions_lost:8} {self.lost:5} of {self.samples:<5}"
            f" {self.trip_ms(0.5):7.1f} {self.trip_ms(0.99):7.1f} {max(self.trips_ms, default=math.inf):7.1f} {new}"
            f" {self.memory_mb:8.1f} {self.descriptors:6} {100 * self.processor:5.0f} {self.log_bytes:9,}"
        )


HEAD = (
    f"    {'attack':<6} {'sessions':>8} {'samples':>14} {'round trip, ms':>23} {'new entity':>6}"
    f" {'memory':>8} {'descr.':>6} {'CPU':>5} {'log':>9}\n"
    f"    {'':<6} {'lost':>8} {'lost':>14} {'median':>7} {'p99':>7} {'worst':>7} {'s':>6}"
    f" {'MB':>8} {'':>6} {'%':>5} {'bytes':>9}"
)


class Honest:
    """The client that is to notice nothing."""

    def __init__(self, port: int, domain: int, key: int = HONEST) -> None:
        self._client = SoakClient(key, 0x81, 512, self._heard)
        self._client.link = self._link = UdpLink(port, self._client.hear)
        self._domain = domain
        self._sent_at: dict[int, float] = {}
        self.trips_ms: list[float] = []
        self.sent = 0

    def connect(self, node: str, timeout_s: float) -> float:
        """Open a session and create a node that writes and reads; return how long that took, or infinity."""
        began, hello_at = time.monotonic(), 0.0
        requests: list[int] = []
        while (now := time.monotonic()) < began + timeout_s:
            if not self._client.connected and now >= hello_at:
                hello_at = now + TRY_S
                self._client.introduce()
            if self._client.connected and not requests:
                requests = [self._client.ask(partial(_create, *entity)) for entity in self._entities(node)]
            self.turn(0.01)
            if requests and all(number in self._client.statuses for number in requests):
                assert set(self._client.statuses.values()) <= {0, 1}, self._client.statuses
                return time.monotonic() - began
        return math.inf

    def read(self) -> None:
        """Ask for all that comes."""
        self._client.ask(lambda request: ReadData(request, 0x16, 0x80, 0, None, DeliveryControl(0xFFFF)))

    def send(self, new: bool = True) -> None:
        """Send the next sample."""
        self._sent_at[self.sent] = time.monotonic()
        body = int32_body(self.sent)
        self._client.ask(lambda request: WriteData(request, 0x15, body))
        self.sent += new

    def turn(self, seconds: float) -> None:
        """Take what comes for so long, and say again what is due."""
        end = time.monotonic() + seconds
        while (now := time.monotonic()) < end:
            select.select([self._link], [], [], end - now)
            self._link.read()
            self._client.tick(time.monotonic())

    def forget(self) -> None:
        """Reset the counters."""
        self._sent_at.clear()
        self.trips_ms.clear()
        self.sent = 0

    @property
    def waits(self) -> int:
        """How many samples did not come back."""
        return len(self._sent_at)

    def leave(self) -> None:
        """End the session."""
        self._client.leave()
        self._link.close()

    def _heard(self, data: Data) -> None:
        sent_at = self._sent_at.pop(struct.unpack("<i", data.data)[0], None)
        if sent_at is not None:
            self.trips_ms.append(1000 * (time.monotonic() - sent_at))

    def _entities(self, node: str) -> list[tuple[int, bytes, int, int]]:
        return [
            (0x11, participant_blob(node), 0, self._domain),
            (0x12, topic_blob(f"rt/{node}_up", INT32), 0x11, 0),
            (0x22, topic_blob(f"rt/{node}_down", INT32), 0x11, 0),
            (0x13, b"\0\0", 0x11, 0),
            (0x14, b"\0\0", 0x11, 0),
            (0x15, writer_blob(0x12, KEEP_ALL, 0), 0x13, 0),
            (0x16, reader_blob(0x22, KEEP_ALL, 0), 0x14, 0),
        ]


def _create(object_id: int, body: bytes, parent: int, domain: int, request: int) -> Create:
    return Create(request, object_id, object_id & 0x0F, Format.BINARY, body, parent, domain, True, True)


class AgentUnderTest:
    """The agent's process, and what the system says of it."""

    def __init__(self, process: subprocess.Popen[str], log: Path, ports: dict[str, int]) -> None:
        self.process = process
        self.log = log
        self.udp, self.tcp = ports["udp4"], ports["tcp4"]
        self.descriptors = 0

    def cpu_s(self) -> float:
        """Return the seconds of processor that it used."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def peak_mb(self) -> float:
        """Return the most memory that it had."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.partition("VmHWM:")[2].split()[0]) * 1024 / 1e6

    def limit_mb(self) -> float:
        """Return the limit of memory that its log begins with."""
        events = (json.loads(line) for line in self.log.read_text().splitlines() if line.startswith("{"))
        limits: dict[str, float] = next(event for event in events if event["event"] == "limits")
        return limits.get("memory_bytes", math.inf) / 1e6

    def look(self) -> None:
        """Count its descriptors."""
        with contextlib.suppress(OSError):
            self.descriptors = max(
                self.descriptors, len(list(Path(f"/proc/{self.process.pid}/fd").iterdir()))
            )

    def sessions_lost(self, key: int) -> int:
        """Return how often the log says that a client was lost."""
        events = [json.loads(line) for line in self.log.read_text().splitlines() if line.startswith("{")]
        lost = ("client_silent", "client_gone", "client_again", "same_key_twice")
        return sum(e.get("event") in lost and e.get("client") == f"{key:08X}" for e in events)


@contextmanager
def agent_under_test(folder: Path, domain: int, options: Sequence[str]) -> Iterator[AgentUnderTest]:
    """Run an agent with UDP and TCP."""
    log = folder / "agent.log"
    with log.open("w") as out:
        process = subprocess.Popen(
            [
                sys.executable,
                *(os.environ.get("AGENT_MAIN", "-m microros_gen").split()),
                "agent",
                "--log-format",
                "json",
                *options,
                *TRANSPORTS,
            ],
            env=environment(domain),
            stdout=subprocess.PIPE,
            stderr=out,
            text=True,
        )
    try:
        assert process.stdout is not None
        reported = [json.loads(process.stdout.readline()) for _ in range(2)]
        ports = {line["transport"]: int(line["address"].rpartition(":")[2]) for line in reported}
        yield AgentUnderTest(process, log, ports)
    finally:
        process.terminate()
        try:
            process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextmanager
def echo(domain: int) -> Iterator[None]:
    """Run the rclpy process."""
    command = [sys.executable, str(HERE / "agent_echo.py")]
    with subprocess.Popen(command, env=environment(domain), stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "echoing\n"
            yield
        finally:
            process.kill()


@contextmanager
def attacking(attack: str, agent: AgentUnderTest, domain: int, seconds: float) -> Iterator[None]:
    """Run one attack in a separate process; it has begun when the context begins."""
    numbers = (agent.udp, agent.tcp, domain, seconds)
    command = [sys.executable, str(HERE / "agent_attackers.py"), attack, *map(str, numbers)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield
        finally:
            process.kill()


def measure(
    attacks: Sequence[str], name: str, domain: int, seconds: float, options: Sequence[str] = ()
) -> Line:
    """Return the line of some attacks at once."""
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        agent = stack.enter_context(agent_under_test(Path(folder), domain, options))
        honest = Honest(agent.udp, domain)
        assert honest.connect("honest", 30) < math.inf, "the agent does not answer"
        honest.read()
        _warm_up(honest)
        log_before, cpu_before, began = agent.log.stat().st_size, agent.cpu_s(), time.monotonic()
        for attack in attacks:
            stack.enter_context(attacking(attack, agent, domain, seconds + 5))
        _run(honest, agent, seconds / 2)
        newcomer = Honest(agent.udp, domain, NEW)
        new_s = _meanwhile(honest, agent, newcomer)
        _run(honest, agent, max(0.0, began + seconds - time.monotonic()))
        elapsed_s = time.monotonic() - began
        processor = (agent.cpu_s() - cpu_before) / elapsed_s
        end = time.monotonic() + GRACE_S
        while honest.waits and time.monotonic() < end:
            honest.turn(0.1)
        return Line(
            name,
            agent.sessions_lost(HONEST),
            honest.sent,
            honest.waits,
            honest.trips_ms,
            new_s,
            agent.peak_mb(),
            agent.descriptors,
            processor,
            agent.log.stat().st_size - log_before,
            agent.limit_mb(),
        )


def _warm_up(honest: Honest) -> None:
    """Send until a sample comes back: then the rclpy process and the agent have found each other, both ways."""
    end = time.monotonic() + 30
    while not honest.trips_ms:
        assert time.monotonic() < end, "nothing comes back"
        honest.send()
        honest.turn(0.1)
    honest.turn(SETTLE_S)
    honest.forget()


def _run(honest: Honest, agent: AgentUnderTest, seconds: float) -> None:
    end = time.monotonic() + seconds
    at = time.monotonic()
    while at < end:
        honest.send()
        at = max(at + EVERY_S, time.monotonic() - 5 * EVERY_S)
        honest.turn(max(0.0, at - time.monotonic()))
        if honest.sent % 10 == 0:
            agent.look()


def _meanwhile(honest: Honest, agent: AgentUnderTest, newcomer: Honest) -> float:
    """Let a new client come while the honest one goes on; return how long it took."""
    began, hello_at, requested = time.monotonic(), 0.0, False
    client = newcomer._client
    numbers: list[int] = []
    while (now := time.monotonic()) < began + 10:
        if not client.connected and now >= hello_at:
            hello_at = now + TRY_S
            client.introduce()
        if client.connected and not requested:
            requested = True
            numbers = [client.ask(partial(_create, *entity)) for entity in newcomer._entities("newcomer")]
        with contextlib.suppress(AssertionError):  # refused: it tries again
            newcomer.turn(0.002)
        if requested and all(number in client.statuses for number in numbers):
            newcomer.leave()
            return time.monotonic() - began
        _run(honest, agent, EVERY_S / 2)
    return math.inf


def bench_attacks(seconds: float = 6.0, names: Sequence[str] = ()) -> None:
    """Print the table."""
    domain = 1 + os.getpid() % 100
    print(
        "agent under attack: an honest client, an rclpy process that answers it, a client that comes meanwhile"
    )
    print(f"  {seconds:.0f} s each; CPU: user and system time of the agent, of one core; memory: its most")
    print(HEAD)
    with echo(domain):
        for name in names or ("none", *ATTACKS, ALL):
            attacks = {"none": [], ALL: list(ATTACKS)}.get(name, [name])
            line = measure(attacks, name, domain, seconds)
            print(line, flush=True)
    print(f"  memory that the agent says at its start not to exceed: {line.limit_mb:.0f} MB\n")


if __name__ == "__main__":
    bench_attacks(float(sys.argv[1]), sys.argv[2:])
