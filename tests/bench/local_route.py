# SPDX-License-Identifier: Apache-2.0
"""Processor time of a message from the publish call to the callback, inside an image and over the agent and DDS."""

from __future__ import annotations

import os
import statistics
import sys
from pathlib import Path

from tests.bench.client import compiled
from tests.bench.instructions import IDL, run, version
from tests.support.agent.process import running_agent
from tests.support.free_ports import free_ports

COUNTS = {"only": 2_000_000, "never": 2_000}
"""Messages of a turn, by the value of `local`."""
TURNS = 3
DOMAIN = 78
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {type: udp, agent: "127.0.0.1:PORT"}
nodes:
  - name: device
    domain_id: DOMAIN
    publishers: [{topic: count, type: std_msgs/msg/Int32, local: WHERE}]
    subscriptions: [{topic: count, type: std_msgs/msg/Int32, local: WHERE}]
"""


def bench_local_route(work: Path) -> None:
    """Build both programs, let them run in turns, and print a line."""
    [port] = free_ports(1)
    work.mkdir()
    programs = {where: _program(work / where, where, port) for where in COUNTS}
    times: dict[str, list[float]] = {"only": [], "never": [], "agent": []}
    with running_agent(DOMAIN, "--domain", str(DOMAIN), transport=("udp4", "--port", str(port))) as agent:
        for _ in range(TURNS):
            for where, program in programs.items():
                before = _spent_us(agent.process.pid)
                times[where].append(int(run([str(program), str(COUNTS[where])]).stdout) / 1000)
                if where == "never":
                    times["agent"].append((_spent_us(agent.process.pid) - before) / COUNTS[where])
    local, device, agents = (statistics.median(times[key]) for key in ("only", "never", "agent"))
    print(
        f"local_route: Int32, reliable, {version('cc')}, -O2, UDP on loopback; us of processor time a message, median\n"
        f"  inside the image {local:.3f}; over the agent: device {device:.1f}, agent and DDS {agents:.1f}; "
        f"{local / device:.4f} of the device, {local / (device + agents):.5f} of the whole way\n"
    )


def _program(home: Path, where: str, port: int) -> Path:
    home.mkdir()
    text = APPLICATION.replace("WHERE", where).replace("PORT", str(port)).replace("DOMAIN", str(DOMAIN))
    (home / "microros.yaml").write_text(text)
    out = home / "out"
    build = [sys.executable, "-m", "microros_gen", "build", "-c", str(home / "microros.yaml"), "-o", str(out)]
    run([*build, "--interface-path", str(IDL)])
    return compiled(home, "local_route.c", [f"-I{out / 'include'}", str(out / "lib/libmicroros.a")])


def _spent_us(process: int) -> float:
    """Return the processor time that a process has used, in user mode and in the kernel (proc(5), stat)."""
    words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK") * 1e6
