# SPDX-License-Identifier: Apache-2.0
"""The client's own speed on this host: against an agent of a few lines of C, so that nothing but the client limits."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from instructions import HERE, IDL, run, version

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
liveliness: none
pools: {history: 16}
nodes:
  - name: bench
    publishers:
      - {topic: best_effort, type: std_msgs/msg/String, qos: {reliability: best_effort}}
      - {topic: reliable, type: std_msgs/msg/String}
    subscriptions: [{topic: echo, type: std_msgs/msg/String}]
limits: {"*": {string: 1050}}
"""
SIZES = (64, 1024)
COUNT = 50_000


def bench_client(work: Path) -> None:
    """Build both sides and print the table."""
    work.mkdir()
    (work / "microros.yaml").write_text(APPLICATION)
    sink = compiled(work, "client_sink.c", [])
    print(
        f"client: {version('cc')}, -O2, UDP on loopback, an agent of C without DDS; one run of {COUNT:,} samples"
    )
    print(f"  {'':42} {'64 B':>10} {'1 KiB':>10}")
    with answering(sink) as port:
        out = work / "out"
        build = [sys.executable, "-m", "microros_gen", "build", "-c", str(work / "microros.yaml")]
        run([*build, "-o", str(out), "--interface-path", str(IDL), "--agent", f"127.0.0.1:{port}"])
        load = compiled(work, "client_load.c", [f"-I{out / 'include'}", str(out / "lib/libmicroros.a")])

        def line(title: str, task: str, word: int, count: int = COUNT) -> None:
            values = [run([str(load), task, str(size), str(count)]).stdout.split()[word] for size in SIZES]
            print(f"  {title:42} {values[0]:>10} {values[1]:>10}")

        line("one send() of a datagram, ns", "datagram", 0)
        line("one rcl_publish, best effort, ns", "publish", 0)
        line("samples/s, best effort", "best_effort", 0)
        line("samples/s, reliable, window of 16", "reliable", 0)
        line("round trip, reliable, median, ns", "echo", 0, COUNT // 10)
        line("round trip, reliable, 99 %, ns", "echo", 1, COUNT // 10)
        for task in ("best_effort", "reliable"):
            told(port)
            wire = [wire_bytes(load, port, task, size) for size in SIZES]
            print(
                f"  {'bytes to the agent for a sample, ' + task.replace('_', ' '):42} {wire[0]:10.1f} {wire[1]:10.1f}"
            )
    print()


def wire_bytes(load: Path, port: int, task: str, size: int) -> float:
    """Return the bytes of all datagrams to the agent, by sample; session and entities are spread over them."""
    run([str(load), task, str(size), str(COUNT)])
    sent, _, samples = told(port)
    return sent / samples


def told(port: int) -> list[int]:
    """Return bytes, datagrams and samples that the agent saw since the last time."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as line:
        line.settimeout(5)
        line.sendto(b"?", ("127.0.0.1", port))
        return [int(word) for word in line.recv(200).split()]


def compiled(work: Path, source: str, more: list[str]) -> Path:
    """Return the program of a C file of this folder."""
    program = work / Path(source).stem
    run(
        [
            "cc",
            "-std=gnu99",
            "-O2",
            "-Wall",
            "-Wextra",
            "-Werror",
            str(HERE / source),
            *more,
            "-o",
            str(program),
        ]
    )
    return program


@contextmanager
def answering(sink: Path) -> Iterator[int]:
    """Run the agent's side; give its port."""
    process = subprocess.Popen([str(sink)], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        yield int(process.stdout.readline().split()[1])
    finally:
        process.kill()
        process.communicate()
