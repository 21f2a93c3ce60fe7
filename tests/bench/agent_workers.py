# SPDX-License-Identifier: Apache-2.0
"""The agent with several worker processes: rate, processor time of each sample, and memory, with many clients.

The agents run at the same time and are measured in turn, so that what else the machine does changes all of them alike.
"""

from __future__ import annotations

import os
import statistics
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from tests.bench.agent_sides import Target
from tests.support.agent.fleet import Fleet, Rates, fleet
from tests.support.agent.process import AgentProcess, own_domain, running_agent

WORKERS = (1, 2, 4)
CLIENTS = 100
ROUNDS = 5
SECONDS = 2.0
WINDOW = 4


class Side:
    """An agent with a number of workers, and its clients. What it has used is that of all of its processes."""

    def __init__(self, workers: int, agent: AgentProcess, clients: Fleet, domain: int) -> None:
        self.workers = workers
        self.clients = clients
        first = agent.process.pid
        listed = Path(f"/proc/{first}/task/{first}/children").read_text().split()
        self.processes = [Target(agent.port, pid, domain) for pid in (first, *map(int, listed))]
        self.rates: list[float] = []
        self.cpu: list[float] = []

    def cpu_s(self) -> float:
        """Return the seconds of processor of all processes."""
        return sum(process.cpu_s() for process in self.processes)

    def measure(self, run: Callable[[Fleet], Rates]) -> None:
        """Add one round."""
        before = self.cpu_s()
        rates = run(self.clients)
        self.rates.append(rates.per_second)
        self.cpu.append((self.cpu_s() - before) * 1e6 / max(sum(rates.counts), 1))

    def words(self) -> str:
        """Return the medians, and begin again."""
        rate, cpu = statistics.median(self.rates), statistics.median(self.cpu)
        self.rates, self.cpu = [], []
        return f"{rate:9,.0f} /s {cpu:6.0f} us"


def bench_workers(clients: int = CLIENTS) -> None:
    """Print the table."""
    if not (Path(sys.prefix) / "include" / "rcl").exists():
        print("workers: not measured: the ROS 2 wheels are missing")
        return
    print(
        f"workers: {clients} clients as those of `fleet`; medians of {ROUNDS} rounds of {SECONDS:g} s in turn"
    )
    print(f"  load average {os.getloadavg()[0]:.1f}, {len(os.sched_getaffinity(0))} processors")
    domain = own_domain()
    with ExitStack() as stack:
        sides = []
        for workers in WORKERS:
            options = ("--workers", str(workers), "--max-clients", str(clients))
            agent = stack.enter_context(running_agent(domain, *options))
            found = stack.enter_context(fleet())
            found.join(agent.port, domain, clients)
            sides.append(Side(workers, agent, found, domain))
        for title, run in _KINDS.items():
            for _ in range(ROUNDS):
                for side in sides:
                    side.measure(run)
            for side in sides:
                print(f"    {side.workers} workers, {title:<32} {side.words()}", flush=True)
        for side in sides:
            memory = ", ".join(f"{process.memory_mb():.1f}" for process in side.processes)
            print(f"    {side.workers} workers: {memory} MB")
    print()


_KINDS: dict[str, Callable[[Fleet], Rates]] = {
    f"reliable to DDS, {WINDOW} on their way": lambda clients: clients.write(SECONDS, WINDOW),
    "to DDS and back, one by one": lambda clients: clients.exchange(SECONDS),
}
