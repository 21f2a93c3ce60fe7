# SPDX-License-Identifier: Apache-2.0
"""Instructions of publish on this host, counted by callgrind inside rcl_publish."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

HERE = Path(__file__).resolve().parent
IDL = HERE.parents[1] / "microros_gen" / "idl"
APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: bench
    publishers:
      - {topic: best_effort, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}
      - {topic: reliable, type: std_msgs/msg/Int32}
"""


def bench_instructions(work: Path) -> None:
    """Build a program and print its table."""
    if shutil.which("valgrind") is None:
        sys.exit("instructions need valgrind: apt-get install valgrind")
    out = work / "instructions"
    config = work / "instructions.yaml"
    config.write_text(APPLICATION)
    with agent() as port:
        command = [sys.executable, "-m", "microros_gen", "build", "-c", str(config), "-o", str(out)]
        run([*command, "--interface-path", str(IDL), "--agent", f"127.0.0.1:{port}"])
        # The program itself is not optimized, so that the counted call stays one; the library is (-O2).
        program = work / "publish"
        compiler = ["cc", "-std=c99", "-O0", "-g", f"-I{out / 'include'}", str(HERE / "publish.c")]
        run([*compiler, str(out / "lib/libmicroros.a"), "-o", str(program)])
        print(f"instructions: callgrind inside the call, {version('cc')}, -O2, this host; no system calls")
        print(f"{'publish of std_msgs/msg/Int32':<58} {'here':>8}")
        for name in ("best_effort", "reliable"):
            print(f"  {name.replace('_', ' '):<56} {count(program, name, 'rcl_publish', work):8.0f}")
    print()


def count(program: Path, what: str, function: str, work: Path) -> float:
    """Return instructions per call of `function` in a run of `program what`."""
    valgrind = ["valgrind", "--tool=callgrind", f"--toggle-collect={function}"]
    result = run([*valgrind, f"--callgrind-out-file={work / 'callgrind.out'}", str(program), what])
    calls = re.search(r"^(\d+) calls", result.stdout, re.MULTILINE)
    collected = re.search(r"Collected : (\d+)", result.stderr)
    if not calls or not collected:
        sys.exit(f"callgrind gave no count:\n{result.stdout}{result.stderr}")
    return int(collected.group(1)) / int(calls.group(1))


def version(compiler: str) -> str:
    """Return the compiler's first line of --version."""
    return run([compiler, "--version"]).stdout.splitlines()[0]


def run(command: list[str]) -> subprocess.CompletedProcess[str]:
    """Run `command`; end the bench with its output when it fails."""
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{result.stdout}{result.stderr}")
    return result


@contextmanager
def agent() -> Iterator[int]:
    """Start an agent on a free port."""
    command = [sys.executable, "-m", "microros_gen", "agent", "udp4", "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert process.stdout is not None
    try:
        ready = process.stdout.readline()
        yield int(ready.rsplit(":", 1)[1])
    finally:
        process.terminate()
        process.wait(timeout=10)
