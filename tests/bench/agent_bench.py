# SPDX-License-Identifier: Apache-2.0
"""The table of the agent's bench: this project's agent, or with its port and process any other that runs already."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

from tests.bench.agent_rates import (
    Case,
    Rate,
    client_to_client,
    client_to_dds,
    dds_to_client,
    dds_to_dds,
    loopback_trip,
    median_of,
    memory,
    round_trip,
)
from tests.bench.agent_sides import BEST_EFFORT, RELIABLE, Programs, Target, build_programs, own_agent

RUNS = 3
SAMPLES = 60_000
FRAGMENTED = 30_000
TRIPS = 10_000
PACED = 17_000
"""Samples a second on a best-effort stream; the rate at which the public agent was recorded."""
CLIENTS = (1, 10, 100)
Measure = Callable[[Programs, Target, Case, int, int], Rate]
_WAYS: tuple[tuple[str, Measure], ...] = (
    ("client to DDS", client_to_dds),
    ("DDS to client", dds_to_client),
    ("client to client", client_to_client),
)


@dataclass(frozen=True)
class Row:
    """A case, its number of samples, and what is recorded of the public agent, by way."""

    case: Case
    samples: int
    recorded: Mapping[str, str] = field(default_factory=dict)


ROWS = (
    Row(Case(64, 512, RELIABLE), SAMPLES, {"client to DDS": "43,000 /s, 28 us"}),
    Row(Case(1024, 2048, RELIABLE), SAMPLES, {"client to DDS": "44,000 /s"}),
    Row(Case(1024, 512, RELIABLE), FRAGMENTED, {"client to DDS": "18,000 /s"}),
    Row(Case(64, 512, BEST_EFFORT, PACED), SAMPLES, {"client to DDS": "17,000 /s, 11.5 us"}),
    Row(Case(1024, 2048, BEST_EFFORT, PACED), SAMPLES),
)
TRIP_RECORDED = "83 to 95 us median, 172 us p99"
MEMORY_RECORDED = {0: "15 MB", 1: "20 MB", 10: "39 MB", 100: "400 MB, 608 threads"}


def bench_agent(
    work: Path,
    other: Target | None = None,
    compared: Target | None = None,
    only: str | None = None,
    samples: int = SAMPLES,
    runs: int = RUNS,
) -> None:
    """Print the table; `other`: an agent that runs already, in place of one that is started here.

    `compared`: an agent that runs already; rates and round trips are of both in turn, with the ratios of rates. Memory
    is not measured then.
    `only`: a part of the names of the rates to measure (way and case, as printed), and nothing else than these.
    `samples`: the number in each run, half of it in fragments.
    """
    programs = build_programs(work)
    if programs is None:
        print("agent: not measured: the ROS 2 wheels or a C compiler is missing")
        return
    print(
        "agent: one client over UDP on this machine; counted at a DDS reader in another process, or in the client"
    )
    print(
        f"  KEEP_ALL; median of {runs} runs, losses of the worst; us: user and system time of the agent a sample"
    )
    rates = _Rates(programs, count(0xB0000000 + (os.getpid() & 0xFFFF) * 0x1000), only or "", samples, runs)
    with _target(other) as target:
        _calibrate(programs, target.domain)
        if compared is not None:
            rates.print_ratios(target, compared)
            if only is None:
                _print_trips(programs, [target, compared], rates.keys)
            return
        print(
            "  recorded: the public agent 2.4.3 in another machine's minutes (verification/figures.md), not of this run"
        )
        rates.print(target)
        if only is None:
            _print_trips(programs, [target], rates.keys)
    if only is None:
        with _target(other) as target:
            print_memory(target)
    print()


def print_memory(target: Target) -> None:
    """Print the memory of an agent with as many clients as the recorded one had."""
    print("  memory, clients with a node, 2 publishers, 2 subscriptions; reliable, KEEP_LAST 10")
    for clients, megabytes, threads in memory(target, CLIENTS):
        seen = f"{megabytes:6.1f} MB, {threads} threads"
        print(f"    {f'{clients} clients':<38} {seen:<58} {MEMORY_RECORDED[clients]}", flush=True)


@contextmanager
def _target(other: Target | None) -> Iterator[Target]:
    if other is not None:
        yield other
        return
    with own_agent(1 + os.getpid() % 100) as target:
        yield target


def _calibrate(programs: Programs, domain: int) -> None:
    """Show what the machine does without any agent in these minutes; the sides are not what limits."""
    print(f"  load average {os.getloadavg()[0]:.1f}; without any agent, in the same minutes:")
    print(f"    {'UDP datagram to a process and back':<38} {loopback_trip(programs, TRIPS)}")
    for size in (64, 1024):
        rate = dds_to_dds(programs, domain, size, SAMPLES)
        print(f"    {f'the same DDS writer to reader, {size} B':<38} {rate.per_second:9,.0f} /s")


@dataclass(frozen=True)
class _Rates:
    """Measures the rates of agents: `samples` in each of `runs` runs, of the cases with `only` in their names."""

    programs: Programs
    keys: Iterator[int]
    only: str
    samples: int
    runs: int

    def print(self, target: Target) -> None:
        """Print the rates of one agent, and those that are recorded of the public one."""
        for title, measure in _WAYS:
            print(f"  {title:<99} recorded")
            for row in self._rows(title):
                rate = median_of([self._once(measure, row, target) for _ in range(self.runs)])
                recorded = row.recorded.get(title, "")
                print(f"    {row.case!s:<48} {rate!s:<48} {recorded}", flush=True)

    def print_ratios(self, target: Target, compared: Target) -> None:
        """Print the rates of two agents, measured in turn, and the ratio of rates and of processor times."""
        for title, measure in _WAYS:
            print(f"  {title:<53}{'this agent':<48} {'the other one':<48} rate, us: ratios")
            for row in self._rows(title):
                pairs = [
                    (self._once(measure, row, target), self._once(measure, row, compared))
                    for _ in range(self.runs)
                ]
                first, second = (median_of(rates) for rates in zip(*pairs, strict=True))
                ratios = f"{first.per_second / second.per_second:.2f}, {first.cpu_us / second.cpu_us:.2f}"
                print(f"    {row.case!s:<50} {first!s:<48} {second!s:<48} {ratios}", flush=True)

    def _rows(self, title: str) -> Iterator[Row]:
        return (row for row in ROWS if self.only in f"{title}, {row.case}")

    def _once(self, measure: Measure, row: Row, target: Target) -> Rate:
        return measure(
            self.programs, target, row.case, row.samples * self.samples // SAMPLES, next(self.keys)
        )


def _print_trips(programs: Programs, targets: Sequence[Target], keys: Iterator[int]) -> None:
    """Print the round trips of each agent, measured in turn."""
    print("  client, agent, DDS, agent, client; 64 B")
    for stream, title in ((RELIABLE, "reliable"), (BEST_EFFORT, "best effort")):
        runs = [
            [round_trip(programs, each, stream, TRIPS, next(keys)) for each in targets] for _ in range(RUNS)
        ]
        middles = [
            sorted(trips, key=lambda trip: trip.median_us)[RUNS // 2] for trips in zip(*runs, strict=True)
        ]
        shown = " ".join(f"{middle!s:<58}" for middle in middles)
        print(f"    {title:<38} {shown} {TRIP_RECORDED if stream == RELIABLE else ''}", flush=True)
