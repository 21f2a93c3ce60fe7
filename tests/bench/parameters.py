# SPDX-License-Identifier: Apache-2.0
"""Instructions of a parameter server on this host, counted by callgrind inside the call."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from tests.bench.instructions import HERE, IDL, agent, count, run, version

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
entities: preconfigured
errors: code
nodes: [{name: device}]
"""
CALLS = 20
COUNTED = {
    "init, seven entities, without waiting for an agent": ("rclc_parameter_server_init_default", 1),
    "set of an integer, with its event": ("rclc_parameter_set_int", CALLS),
    "get of an integer": ("rclc_parameter_get_int", CALLS),
}
"""What is counted: the function, and how often the program calls it."""


def bench_parameters(work: Path) -> None:
    """Build a program and print its table."""
    if shutil.which("valgrind") is None:
        sys.exit("instructions need valgrind: apt-get install valgrind")
    work.mkdir()
    config = work / "microros.yaml"
    config.write_text(APPLICATION)
    out = work / "out"
    with agent() as port:
        command = [sys.executable, "-m", "microros_gen", "build", "-c", str(config), "-o", str(out)]
        run([*command, "--interface-path", str(IDL), "--agent", f"127.0.0.1:{port}"])
        program = work / "parameters"
        compiler = ["cc", "-std=c99", "-O0", "-g", f"-I{out / 'include'}", str(HERE / "parameters.c")]
        run([*compiler, str(out / "lib/libmicroros.a"), "-o", str(program)])
        print(f"parameters: callgrind inside the call, {version('cc')}, -O2, this host; no system calls")
        for what, (function, calls) in COUNTED.items():
            # The program prints the calls of `set` and `get`.
            total = count(program, what, function, work) * CALLS
            print(f"  {what:<56} {total / calls:8.0f}")
    print()
