# SPDX-License-Identifier: Apache-2.0
"""Jitter of work at 1 kHz beside a saturated reliable stream: in a task, and under a plain executor, in turns."""

from __future__ import annotations

import socket
import sys
import threading
from collections.abc import Mapping
from pathlib import Path

from tests.bench.instructions import HERE, IDL, run
from tests.support.runtime.fake_agent import FakeAgent

ROUNDS = 3
COMMON = """\
version: 1
profiles: [pure_sender]
components: [+executor, +timers]
liveliness: none
on_full: block 1 s
nodes:
  - name: device
    publishers: [{topic: load, type: std_msgs/msg/Int32}]
"""
APPLICATIONS: Mapping[str, str] = {
    "executor": "    timers: [{name: control, period: 1 ms}]\n    executors: [{name: control, handles: [control]}]\n",
    "tasks": """\
    executors: [{name: control}, {name: load}]
tasks:
  - {name: control, executor: control, rate: 1 kHz, criticality: high}
  - {name: load, executor: load, period: 1 s, criticality: low}
  - {name: session, session: true, criticality: middle}
""",
}


def bench_tasks(work: Path) -> None:
    """Print the jitter of each round."""
    work.mkdir()
    programs = {name: _program(work, name, text) for name, text in APPLICATIONS.items()}
    print(
        "tasks: deviation of the time between two runs from 1 ms, microseconds; messages of a full reliable stream"
    )
    print("                50 %   99 %    most   messages/s  priorities")
    for _ in range(ROUNDS):
        for name, (program, served) in programs.items():
            threading.Thread(target=_serve, args=(served,), daemon=True).start()
            median, most_of, most, published, has_priorities = run([str(program)]).stdout.split()
            rate = int(published) // 5
            has = "yes" if int(has_priorities) else "none"
            print(f"  {name:10} {median:>7} {most_of:>6} {most:>7} {rate:>12}  {has}")
            served.sendto(b"", served.getsockname())  # ends the agent
    print()


def _serve(served: socket.socket) -> None:
    """Answer as an agent does, until an empty datagram comes."""
    agent = FakeAgent()
    while True:
        datagram, peer = served.recvfrom(2048)
        if not datagram:
            return
        agent.log.clear()  # it would grow with each message
        agent.written.clear()
        for answer in agent.receive(datagram):
            served.sendto(answer, peer)


def _program(work: Path, name: str, text: str) -> tuple[Path, socket.socket]:
    served = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    served.bind(("127.0.0.1", 0))
    config, out, program = work / f"{name}.yaml", work / name, work / f"{name}_program"
    config.write_text(COMMON + text)
    command = [sys.executable, "-m", "microros_gen", "build", "-c", str(config), "-o", str(out)]
    run([*command, "--interface-path", str(IDL), "--agent", f"127.0.0.1:{served.getsockname()[1]}"])
    flags = ["-DBENCH_TASKS"] if name == "tasks" else []
    compiler = ["cc", "-std=gnu99", "-O2", *flags, f"-I{out / 'include'}", str(HERE / "tasks.c")]
    run([*compiler, str(out / "lib/libmicroros.a"), "-pthread", "-o", str(program)])
    return program, served
