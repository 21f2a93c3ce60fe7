# SPDX-License-Identifier: Apache-2.0
"""One agent with up to 1,000 clients: its memory, and whether all get the same when all want more than it can."""

from __future__ import annotations

import os
import statistics
import sys
import time
from pathlib import Path

from tests.bench.agent_sides import Target
from tests.support.agent.fleet import Fleet, Rates, fleet
from tests.support.agent.process import own_domain, running_agent

STEPS = (100, 1000)
SECONDS = 10.0
WINDOW = 4
SETTLE_S = 2.0


def bench_fleet() -> None:
    """Print the table."""
    if not (Path(sys.prefix) / "include" / "rcl").exists():
        print("fleet: not measured: the ROS 2 wheels are missing")
        return
    print("fleet: clients with a node, a writer and a reader of a topic each; one process has all of them")
    print(
        f"  load average {os.getloadavg()[0]:.1f}; UDP on this machine, samples of 64 B, {SECONDS:g} s for each rate"
    )
    domain = own_domain()
    with running_agent(domain, "--max-clients", str(STEPS[-1])) as agent, fleet() as clients:
        target = Target(agent.port, agent.process.pid, domain)
        print(f"  {0:>5} clients: {target.memory_mb():6.1f} MB, {target.threads()} threads")
        for count in STEPS:
            began, cpu = time.monotonic(), target.cpu_s()
            clients.join(target.port, domain, count)
            taken = f"created in {time.monotonic() - began:.1f} s, {target.cpu_s() - cpu:.1f} s of the agent"
            time.sleep(SETTLE_S)
            print(
                f"  {count:>5} clients: {target.memory_mb():6.1f} MB, {target.threads()} threads; {taken}",
                flush=True,
            )
            _print_rates(clients, target)
        print(f"  afterwards: {target.memory_mb():6.1f} MB")
    print()


def _print_rates(clients: Fleet, target: Target) -> None:
    for title, window in (
        (f"reliable to DDS, {WINDOW} on their way", WINDOW),
        ("to DDS and back, one by one", 0),
    ):
        before = target.cpu_s()
        rates = clients.write(SECONDS, window) if window else clients.exchange(SECONDS)
        used = target.cpu_s() - before
        print(f"    {title:<32} {_words(rates)}; {used * 1e6 / max(sum(rates.counts), 1):.0f} us", flush=True)


def _words(rates: Rates) -> str:
    lowest = statistics.quantiles(rates.counts, n=100)[0] / statistics.mean(rates.counts)
    return (
        f"{rates.per_second:8,.0f} /s; of the mean: slowest {rates.slowest:.2f}, 1 % {lowest:.2f},"
        f" fastest {rates.fastest:.2f}"
    )
