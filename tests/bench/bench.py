# SPDX-License-Identifier: Apache-2.0
"""`make bench`: generate and build, encode and decode besides Fast CDR, instructions, parameters, life cycle, flash of
types, firmware, whole images, images for an Arduino, the client, links of boards, tasks, the agent, the same
with 1,000 clients and under attack.

Times depend on the machine; so each is next to that of a peer that ran in the same minutes. Instruction counts come
from callgrind or QEMU and repeat exactly with one compiler.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

from tests.bench.agent_attacks import bench_attacks
from tests.bench.agent_bench import RUNS, SAMPLES, bench_agent
from tests.bench.agent_fleet import bench_fleet
from tests.bench.agent_sides import Target
from tests.bench.agent_workers import bench_workers
from tests.bench.avr import bench_avr
from tests.bench.changed_limits import times_of_changed_limits
from tests.bench.client import bench_client
from tests.bench.codec import bench_codec
from tests.bench.footprint import bench_footprint
from tests.bench.generation import bench_generate, row, timed, tool
from tests.bench.images import bench_images
from tests.bench.instructions import bench_instructions
from tests.bench.lifecycle import bench_lifecycle
from tests.bench.local import bench_local
from tests.bench.local_route import bench_local_route
from tests.bench.parameters import bench_parameters
from tests.bench.peer import bench_peer
from tests.bench.tasks import bench_tasks
from tests.bench.type_flash import bench_type_flash

PARTS = (
    "generate",
    "build",
    "instructions",
    "parameters",
    "lifecycle",
    "local",
    "local_route",
    "codec",
    "types",
    "footprint",
    "images",
    "avr",
    "client",
    "peer",
    "tasks",
    "agent",
    "fleet",
    "workers",
    "attacks",
)


def main() -> int:
    """Run the selected parts and print one table each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", default=PARTS, metavar="PART", help=", ".join(PARTS))
    parser.add_argument(
        "--agent",
        nargs=3,
        type=int,
        metavar=("PORT", "PROCESS", "DOMAIN"),
        help="measure another, which runs",
    )
    parser.add_argument(
        "--compared",
        nargs=3,
        type=int,
        metavar=("PORT", "PROCESS", "DOMAIN"),
        help="measure the agent's rates in turn with those of another, which runs",
    )
    parser.add_argument(
        "--rates",
        metavar="PART",
        help="of the agent, only rates with this in their names, as 'DDS to client, 64 B'",
    )
    parser.add_argument("--samples", type=int, default=SAMPLES, help="in each run of the agent's rates")
    parser.add_argument("--runs", type=int, default=RUNS, help="of each of the agent's rates")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        if "generate" in options.parts:
            bench_generate(work)
        if "build" in options.parts:
            bench_build(work)
        if "instructions" in options.parts:
            bench_instructions(work)
        if "parameters" in options.parts:
            bench_parameters(work / "parameters")
        if "lifecycle" in options.parts:
            bench_lifecycle(work / "lifecycle")
        if "local" in options.parts:
            bench_local(work / "local")
        if "local_route" in options.parts:
            bench_local_route(work / "local_route")
        if "codec" in options.parts:
            bench_codec(work / "codec")
        if "types" in options.parts:
            bench_type_flash(work)
        if "footprint" in options.parts:
            bench_footprint(work / "footprint")
        if "images" in options.parts:
            bench_images(work / "images")
        if "avr" in options.parts:
            bench_avr(work / "avr")
        if "client" in options.parts:
            bench_client(work / "client")
        if "peer" in options.parts:
            bench_peer(work / "peer")
        if "tasks" in options.parts:
            bench_tasks(work / "tasks")
        if "agent" in options.parts:
            other = Target(*options.agent) if options.agent else None
            compared = Target(*options.compared) if options.compared else None
            bench_agent(work / "agent", other, compared, options.rates, options.samples, options.runs)
        if "fleet" in options.parts:
            bench_fleet()
        if "workers" in options.parts:
            bench_workers()
        if "attacks" in options.parts:
            bench_attacks()
    return 0


def bench_build(work: Path) -> None:
    """`build` of pure_sender for the host."""
    out = work / "pure_sender"
    cache = work / "cache"
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    command = tool("build", "--profile", "pure_sender", "-o", str(out))
    print("build: pure_sender with std_msgs/msg/Int32 for the host")
    print("  wall time and processor time of the whole process and the host's C compiler; median of 3")
    row("from nothing", timed(command, environment, 3, out, cache), "1.5 s")
    row("with objects of earlier builds", timed(command, environment, 3, out), "1.0 s")
    row("unchanged", timed(command, environment, 3), "")
    print("  after a limit changed (median of 2; objects that are compiled, the store of objects is off):")
    for what, seconds, compiled in times_of_changed_limits(work / "limits", environment):
        row(f"{what}: {compiled}", seconds, "0.5 s")
    print()


if __name__ == "__main__":
    sys.exit(main())
