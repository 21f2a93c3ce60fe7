# SPDX-License-Identifier: Apache-2.0
"""How fast the agent is: samples a second both ways, round trip, processor a sample, memory; counted outside of it."""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from tests.bench.agent_sides import (
    DEPTH,
    KEEP_ALL_BEST_EFFORT,
    KEEP_ALL_RELIABLE,
    KEEP_LAST_RELIABLE,
    READER,
    RELIABLE,
    WRITER,
    LoadClient,
    Programs,
    Target,
    load_command,
    started,
)

OTHER_KEYS = 0x08000000
"""From the key of a client to that of the one it sends to."""
SETTLE_S = 0.5
"""Seconds from the peer's finding the agent's endpoint to the agent's surely having found the peer's."""


@dataclass(frozen=True)
class Rate:
    """Samples a second, how many of them were lost, microseconds of the agent's processor for each."""

    samples: int
    lost: int
    per_second: float
    cpu_us: float

    def __str__(self) -> str:
        return f"{self.per_second:9,.0f} /s {self.cpu_us:6.1f} us {self.lost:7,} of {self.samples + self.lost:,} lost"


@dataclass(frozen=True)
class Case:
    """What is sent: bytes of CDR, largest message, stream, and how many a second (0: as many as go)."""

    size: int
    mtu: int
    stream: int
    rate: int = 0

    @property
    def flags(self) -> int:
        """QoS of the DDS side: as reliable as the stream."""
        return KEEP_ALL_RELIABLE if self.stream == RELIABLE else KEEP_ALL_BEST_EFFORT

    def __str__(self) -> str:
        stream = "reliable" if self.stream == RELIABLE else "best effort"
        pace = f", {self.rate:,} /s wanted" if self.rate else ""
        return f"{self.size} B, {stream}, MTU {self.mtu}{pace}"


def client_to_dds(programs: Programs, target: Target, case: Case, count: int, key: int) -> Rate:
    """Let a client send `count` samples; count them at the DDS reader."""
    topic = f"bench_{key:x}"
    with LoadClient(target, key, case.mtu) as client:
        writer, _ = client.make(topic, case.flags, ways=[WRITER])
        counting = programs.peer("count", topic, count, case.flags, -1)
        with started(counting, target.domain) as peer:
            peer.wait_until_ready()
            time.sleep(SETTLE_S)
            load = load_command(programs, "send", client, writer, case.stream, case.size, count, case.rate)
            with (
                _processor(target) as used,
                started(load, 0, descriptors=(client.descriptor,)) as sender,
            ):
                sender.result()
                seen = peer.result()
        client.leave()
    return _rate(seen, used())


def dds_to_client(programs: Programs, target: Target, case: Case, count: int, key: int) -> Rate:
    """Let the DDS writer send `count` samples; count them in the client. Some thousand at most are under way."""
    topic = f"bench_{key:x}"
    with LoadClient(target, key, case.mtu) as client, _pipe() as (receives, sends):
        _, reader = client.make(topic, case.flags, ways=[READER])
        client.read(reader, case.stream)
        sending = programs.peer("send", topic, count, case.flags, case.size, case.rate)
        with started(sending, target.domain, stdin=receives) as peer:
            peer.wait_until_ready()
            time.sleep(SETTLE_S)
            load = load_command(
                programs, "receive", client, reader, case.stream, case.size, count, progress=sends
            )
            descriptors = (client.descriptor, sends)
            with _processor(target) as used, started(load, 0, descriptors=descriptors) as receiver:
                os.close(sends)
                seen = receiver.result()
        client.leave()
    return _rate(seen, used())


def client_to_client(programs: Programs, target: Target, case: Case, count: int, key: int) -> Rate:
    """Let a client send `count` samples to another client of the agent; count them there."""
    topic = f"bench_{key:x}"
    with (
        LoadClient(target, key, case.mtu) as source,
        LoadClient(target, key + OTHER_KEYS, case.mtu) as sink,
    ):
        writer, _ = source.make(topic, case.flags, ways=[WRITER])
        _, reader = sink.make(topic, case.flags, ways=[READER])
        sink.read(reader, case.stream)
        time.sleep(SETTLE_S)
        taking = load_command(programs, "receive", sink, reader, case.stream, case.size, count)
        sending = load_command(programs, "send", source, writer, case.stream, case.size, count, case.rate)
        with (
            _processor(target) as used,
            started(taking, 0, descriptors=(sink.descriptor,)) as receiver,
            started(sending, 0, descriptors=(source.descriptor,)) as sender,
        ):
            sender.result()
            seen = receiver.result()
        source.leave()
        sink.leave()
    return _rate(seen, used())


def dds_to_dds(programs: Programs, domain: int, size: int, count: int) -> Rate:
    """Let the same writer and reader talk without any agent: what they can, both reliable with KEEP_ALL."""
    topic = f"bench_dds_{size}"
    with _pipe() as (receives, sends):
        counting = programs.peer("count", topic, count, 1, sends)
        sending = programs.peer("send", topic, count, 1, size, 0)
        with (
            started(counting, domain, descriptors=(sends,)) as reader,
            started(sending, domain, stdin=receives) as writer,
        ):
            os.close(sends)
            writer.wait_until_ready()
            reader.wait_until_ready()
            writer.result()
            seen = reader.result()
    return _rate(seen, 0.0)


@dataclass(frozen=True)
class Trip:
    """Microseconds of round trips."""

    samples: int
    lost: int
    median_us: float
    p99_us: float

    def __str__(self) -> str:
        return (
            f"{self.median_us:7.1f} us median {self.p99_us:7.1f} us p99 {self.lost:4} of {self.samples} lost"
        )


def round_trip(programs: Programs, target: Target, stream: int, count: int, key: int) -> Trip:
    """Let a client send samples of 64 B to its own reader, through DDS."""
    case = Case(64, 512, stream)
    with LoadClient(target, key) as client:
        writer, reader = client.make(f"bench_{key:x}", case.flags)
        client.read(reader, stream)
        time.sleep(SETTLE_S)
        load = load_command(programs, "ping", client, writer, stream, case.size, count)
        with started(load, 0, descriptors=(client.descriptor,)) as ping:
            seen = ping.result()
        client.leave()
    return Trip(**seen)


def loopback_trip(programs: Programs, count: int) -> Trip:
    """Send datagrams of 80 bytes between two processes and back: the machine alone."""
    command = [str(programs.load), "loopback", "0", "0", "80", str(count), "512", "1", "0", "0", "0", "-1"]
    with started(command, 0) as run:
        return Trip(**run.result())


def memory(target: Target, steps: Sequence[int]) -> list[tuple[int, float, int]]:
    """Return clients, MB and threads of the agent, for numbers of clients with two topics each, both ways.

    The endpoints have ROS 2's default QoS. 104 readers with KEEP_ALL would take all of the agent's `history_bytes`.
    """
    clients: list[LoadClient] = []
    seen = [(0, target.memory_mb(), target.threads())]
    try:
        for step in steps:
            while len(clients) < step:
                client = LoadClient(target, 0x10000 + len(clients))
                for number in (1, 2):
                    client.make(
                        f"bench_{len(clients)}_{number}", KEEP_LAST_RELIABLE, number=number, depth=DEPTH
                    )
                clients.append(client)
            time.sleep(2 * SETTLE_S)
            seen.append((step, target.memory_mb(), target.threads()))
    finally:
        for client in clients:
            client.leave()
            client.socket.close()
    return seen


def median_of(runs: Iterable[Rate]) -> Rate:
    """Return the run with the median rate; what was lost in any of them shows."""
    seen = sorted(runs, key=lambda rate: rate.per_second)
    middle = seen[len(seen) // 2]
    worst = max(seen, key=lambda rate: rate.lost)
    cpu = statistics.median(rate.cpu_us for rate in seen)
    return Rate(worst.samples, worst.lost, middle.per_second, cpu)


def _rate(seen: dict[str, Any], cpu_s: float) -> Rate:
    samples = seen["samples"]
    return Rate(samples, seen["lost"], samples / max(seen["seconds"], 1e-9), cpu_s * 1e6 / max(samples, 1))


@contextmanager
def _processor(target: Target) -> Iterator[Callable[[], float]]:
    """Give a function that returns the seconds of processor that the agent used inside the context."""
    before = target.cpu_s()
    used: list[float] = []
    yield lambda: used[0]
    used.append(target.cpu_s() - before)


@contextmanager
def _pipe() -> Iterator[tuple[int, int]]:
    """Give both ends of a pipe; the one to write to is closed by whoever handed it on."""
    receives, sends = os.pipe()
    try:
        yield receives, sends
    finally:
        os.close(receives)
