# SPDX-License-Identifier: Apache-2.0
"""The round trip between two boards on a link, and over an agent and DDS: the same programs, in turns in one run."""

from __future__ import annotations

import statistics
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from tests.bench.client import compiled
from tests.bench.instructions import IDL, run, version
from tests.support.agent.process import running_agent
from tests.support.free_ports import free_ports

NAMES = ("there", "back")
SIZES = (64, 256)
COUNT, TURNS = 2_000, 5
DOMAIN = 77
HOST = "127.0.0.1"


def application(own: str, peer: bool, agent: int) -> str:
    """Return the application of a board that publishes /`own` and hears the other topic."""
    other = NAMES[1 - NAMES.index(own)]
    key, system = (", peer: only", f"system: {{file: ../system.yaml, board: {own}}}\n") if peer else ("", "")
    return f"""\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
limits: {{"*": {{string: 300}}}}
{system}transport: {{type: udp, agent: "{HOST}:{agent}"}}
session: {{key: {NAMES.index(own) + 1}}}
nodes:
  - name: bench
    domain_id: {DOMAIN}
    publishers: [{{topic: /{own}, type: std_msgs/msg/String{key}}}]
    subscriptions: [{{topic: /{other}, type: std_msgs/msg/String{key}}}]
"""


def built(folder: Path, peer: bool, agent: int) -> tuple[Path, Path]:
    """Return the programs of both boards."""
    ports = free_ports(2)
    ends = ", ".join(f'{own}: "{HOST}:{port}"' for own, port in zip(NAMES, ports, strict=True))
    boards = "".join(f"  {own}: {{application: {own}/microros.yaml}}\n" for own in NAMES)
    folder.mkdir()
    (folder / "system.yaml").write_text(
        f"version: 1\nboards:\n{boards}links: [{{type: udp, ends: {{{ends}}}}}]\n"
    )
    for own in NAMES:
        (folder / own).mkdir()
        (folder / own / "microros.yaml").write_text(application(own, peer, agent))
    first, second = (_program(folder / own) for own in NAMES)
    return first, second


def _program(home: Path) -> Path:
    out = home / "out"
    build = [sys.executable, "-m", "microros_gen", "build", "-c", str(home / "microros.yaml"), "-o", str(out)]
    run([*build, "--interface-path", str(IDL)])
    return compiled(home, "peer_round.c", [f"-I{out / 'include'}", str(out / "lib/libmicroros.a")])


@contextmanager
def echoing(program: Path) -> Iterator[None]:
    """Run the board that answers."""
    process = subprocess.Popen([program, "/back", "/there"])
    try:
        yield
    finally:
        process.kill()
        process.wait()


def bench_peer(work: Path) -> None:
    """Build both pairs and print the table."""
    [port] = free_ports(1)
    work.mkdir()
    pairs = {"link": built(work / "link", True, port), "agent": built(work / "agent", False, port)}
    print(
        f"peer: {version('cc')}, -O2, UDP on loopback; round trip, reliable, {TURNS} turns of {COUNT:,}; us, "
        "median of the medians; of 99 %"
    )
    with ExitStack() as stack:
        stack.enter_context(
            running_agent(DOMAIN, "--domain", str(DOMAIN), transport=("udp4", "--port", str(port)))
        )
        for size in SIZES:
            times: dict[str, list[list[float]]] = {way: [] for way in pairs}
            for _ in range(TURNS):
                for way, (first, second) in pairs.items():
                    with echoing(second):
                        words = run([str(first), "/there", "/back", str(size), str(COUNT)]).stdout.split()
                    times[way].append([int(word) / 1000 for word in words])
            middle = {
                way: [statistics.median(row) for row in zip(*rows, strict=True)]
                for way, rows in times.items()
            }
            ratio = middle["link"][0] / middle["agent"][0]
            shown = "; ".join(f"{way} {half:6.1f}, {most:6.1f}" for way, (half, most) in middle.items())
            print(f"  {size:4} B   {shown}; ratio {ratio:.2f}")
    print()
