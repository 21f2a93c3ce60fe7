# SPDX-License-Identifier: Apache-2.0
"""The client's own speed on this host: against an agent of a few lines of C, so that nothing but the client limits."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.bench.instructions import HERE, IDL, run, version

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
liveliness: none
on_full: block 1 s
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
    print(f"  {'':58} {'64 B':>14} {'1 KiB':>14}")
    with answering(sink) as port:
        out = work / "out"
        build = [sys.executable, "-m", "microros_gen", "build", "-c", str(work / "microros.yaml")]
        run([*build, "-o", str(out), "--interface-path", str(IDL), "--agent", f"127.0.0.1:{port}"])
        load = compiled(work, "client_load.c", [f"-I{out / 'include'}", str(out / "lib/libmicroros.a")])

        def line(title: str, task: str, word: int | None, count: int = COUNT) -> None:
            outputs = [run([str(load), task, str(size), str(count)]).stdout.split() for size in SIZES]
            values = ["; ".join(words) if word is None else words[word] for words in outputs]
            print(f"  {title:58} {values[0]:>14} {values[1]:>14}")

        line("one send() of a datagram, ns", "datagram", 0)
        acknowledge_each(port, 9)  # a batch of 12 has one acknowledgement of 9 within it at most
        line("one rcl_publish, best effort; reliable with room; ns", "publish", None)
        line("samples/s, best effort", "best_effort", 0)
        for each in (1, 4, 8):
            acknowledge_each(port, each)
            line(f"samples/s, reliable, window of 16, 1 in {each} acknowledged", "reliable", 0)
        acknowledge_each(port, 1)
        line("round trip, reliable, median, ns", "echo", 0, COUNT // 10)
        line("round trip, reliable, 99 %, ns", "echo", 1, COUNT // 10)
        for task in ("best_effort", "reliable"):
            reported(port)
            wire = [wire_bytes(load, port, task, size) for size in SIZES]
            print(
                f"  {'bytes to the agent for a sample, ' + task.replace('_', ' '):58} {wire[0]:14.1f} {wire[1]:14.1f}"
            )
    print()


def wire_bytes(load: Path, port: int, task: str, size: int) -> float:
    """Return the bytes of all datagrams to the agent, by sample; session and entities are spread over them."""
    run([str(load), task, str(size), str(COUNT)])
    sent, _, samples = reported(port)
    return sent / samples


def acknowledge_each(port: int, count: int) -> None:
    """Let the agent acknowledge each `count`-th reliable message, 1 to 9."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as line:
        line.sendto(str(count).encode(), ("127.0.0.1", port))


def reported(port: int) -> list[int]:
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
