# SPDX-License-Identifier: Apache-2.0
"""Encode and decode besides Fast CDR through the C type support of the ROS 2 wheels, in the same run.

One program a side, from the same messages (codec_messages.c) and the same loops (codec_main.c), both -O2: this
project's generated code in C, and the handles of rosidl_typesupport_fastrtps_c in the libraries of the wheels. Calls
go through the type support handle, without optimization across it.
"""

from __future__ import annotations

import os
import re
import shutil
import statistics
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
IDL = HERE.parents[1] / "microros_gen" / "idl"
FLAGS = ["-O2", "-Wall", "-Wextra", "-Werror"]
ROUNDS = 5
CALLS = 1000
PACKAGES = ("std_msgs", "geometry_msgs", "sensor_msgs", "builtin_interfaces")
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+cdr_decode]
interfaces:
  - std_msgs/msg/Int32
  - std_msgs/msg/String
  - sensor_msgs/msg/Imu
  - sensor_msgs/msg/JointState
  - sensor_msgs/msg/LaserScan
  - geometry_msgs/msg/TwistStamped
  - sensor_msgs/msg/PointCloud2
pools: {publishers: 1}
transport: {type: udp, mtu: 65500}
limits:
  "*": {string: 32, sequence: 6}
  sensor_msgs/msg/LaserScan: {ranges: 360, intensities: 360}
  sensor_msgs/msg/PointCloud2: {data: 65024}
"""


@dataclass(frozen=True)
class Message:
    """A message of codec_messages.c; instructions of Micro-CDR's encode and decode, recorded (figures.md)."""

    name: str
    label: str
    micro_cdr: tuple[int, int] | None = None


MESSAGES = (
    Message("Int32", "Int32", (120, 118)),
    Message("String", "String of 32", (240, 230)),
    Message("Imu", "Imu", (1593, 1618)),
    Message("JointState", "JointState, 6 joints", (2320, 2360)),
    Message("LaserScan", "LaserScan, 360 ranges", (1402, 1460)),
    Message("TwistStamped", "TwistStamped", (924, 939)),
    Message("PointCloud2", "PointCloud2, 4064 points of 16 bytes"),
)


def bench_codec(work: Path) -> None:
    """Build both programs and print a table for encode and one for decode."""
    if shutil.which("valgrind") is None:
        sys.exit("instructions need valgrind: apt-get install valgrind")
    work.mkdir(parents=True, exist_ok=True)
    here, peer = build_here(work), build_fast_cdr(work)
    sizes = {}
    for message in MESSAGES:
        shown = [first_line(program, message) for program in (here, peer) if program]
        if len(set(shown)) != 1:
            sys.exit(f"codec: the sides write different bytes of {message.name}: {shown}")
        sizes[message.name] = int(shown[0].split()[0])
    print(f"codec: {version('cc')}, -O2, this host; calls through the type support handle, on one processor")
    print(
        f"  ns: median of {ROUNDS} runs in turns, each the median of its batches; instructions: callgrind, inside"
    )
    print(
        "  Fast CDR: as rmw_fastrtps_cpp calls it, a stream object for each message; in (): the object is there"
    )
    print("  Micro-CDR: recorded figures, docs/verification/figures.md, not of this run")
    for what in ("encode", "decode"):
        table(what, here, peer, sizes, work)
    print()


def table(what: str, here: Path, peer: Path | None, sizes: dict[str, int], work: Path) -> None:
    """Print a line for each message."""
    print(
        f"{what:<38} {'bytes':>6} {'here':>9} {'Fast CDR':>20} {'ratio':>6} {'memcpy':>8}"
        f" {'here':>8} {'Fast CDR':>14} {'ratio':>6} {'Micro-CDR':>9}"
    )
    call = f"codec_{what}"
    for message in MESSAGES:
        ours, theirs, again, copy = times(here, peer, message, call)
        count = instructions(here, message, call, work)
        line = f"  {message.label:<36} {sizes[message.name]:6} {ours:6.1f} ns"
        if peer is None:
            print(f"{line} {'':20} {'':6} {copy:5.1f} ns {count:8.0f}")
            continue
        counts = [instructions(peer, message, c, work) for c in (call, f"{call}_again")]
        recorded = message.micro_cdr[what == "decode"] if message.micro_cdr else ""
        print(
            f"{line} {theirs:6.1f} ({again:7.1f}) ns {ours / theirs:6.2f} {copy:5.1f} ns"
            f" {count:8.0f} {counts[0]:6.0f} ({counts[1]:5.0f}) {count / counts[0]:6.2f} {recorded:>9}"
        )


def build_here(work: Path) -> Path:
    """Generate and compile this project's side."""
    out, config = work / "here", work / "codec.yaml"
    config.write_text(APPLICATION)
    tool = [sys.executable, "-m", "microros_gen", "generate", "-c", str(config), "-o", str(out)]
    run([*tool, "--interface-path", str(IDL)])
    endings = ("*__type_support.c", "*__decode.c", "*__storage.c")
    sources = [s for p in PACKAGES for e in endings for s in sorted((out / "src" / p).glob(e))]
    sources += sorted((out / "src" / "cdr_decode").glob("cdr_*.c"))
    own = [HERE / f"codec_{name}.c" for name in ("main", "here", "messages")]
    program = work / "codec_here"
    run(["cc", "-std=c99", *FLAGS, f"-I{out / 'include'}", f"-I{HERE}", *sources, *own, "-o", program])
    return program


def build_fast_cdr(work: Path) -> Path | None:
    """Compile the peer's side against the wheels of this environment; None if none exists."""
    include, library = Path(sys.prefix) / "include", Path(sys.prefix) / "lib"
    if not (include / "fastcdr").exists() or shutil.which("c++") is None:
        print("codec: no peer: the ROS 2 wheels or a C++ compiler is missing")
        return None
    folders = sorted(f for f in include.iterdir() if f.is_dir())
    includes = [f"-I{HERE}", *(w for f in (include, *folders) for w in ("-isystem", str(f)))]
    objects = []
    for name in ("main", "messages"):
        objects.append(work / f"peer_{name}.o")
        source = HERE / f"codec_{name}.c"
        run(["cc", "-std=c99", *FLAGS, "-DCODEC_FAST_CDR", *includes, "-c", source, "-o", objects[-1]])
    libraries = [
        f"-l{p}__rosidl_{part}" for p in PACKAGES for part in ("typesupport_fastrtps_c", "generator_c")
    ]
    program = work / "codec_fast_cdr"
    link = ["-Wl,-z,now", f"-L{library}", f"-Wl,-rpath,{library}", *libraries]
    link += ["-lrosidl_typesupport_fastrtps_c", "-lrosidl_runtime_c", "-l:libfastcdr.so.2"]
    run(["c++", "-std=c++17", *FLAGS, *includes, HERE / "codec_fast_cdr.cpp", *objects, *link, "-o", program])
    return program


def first_line(program: Path, message: Message) -> str:
    """Return how many bytes it writes, and their hash."""
    return run([program, message.name, "codec_encode", "0"]).splitlines()[0]


def times(here: Path, peer: Path | None, message: Message, call: str) -> tuple[float, float, float, float]:
    """Return nanoseconds here, of the peer, of the peer's object made before, and of one memcpy."""
    calls = [(here, call), (peer, call), (peer, f"{call}_again"), (here, "codec_copy")]
    seen: list[list[float]] = [[], [], [], []]
    for _ in range(ROUNDS):
        for number, (program, what) in enumerate(calls):
            if program is not None:
                printed = run([*pinned(), program, message.name, what, "time"])
                seen[number].append(float(printed.split()[-2]))
    ours, theirs, again, copy = (statistics.median(s) if s else 0.0 for s in seen)
    return ours, theirs, again, copy


def pinned() -> list[str]:
    """Return the words that keep a command on one processor."""
    return ["taskset", "-c", str(max(os.sched_getaffinity(0)))] if shutil.which("taskset") else []


def instructions(program: Path, message: Message, call: str, work: Path) -> float:
    """Return instructions of a call that is not the first ones."""
    return (
        collected(program, message, call, CALLS, work) - collected(program, message, call, 0, work)
    ) / CALLS


def collected(program: Path, message: Message, call: str, calls: int, work: Path) -> int:
    """Return what callgrind counts inside of `call` in a run of so many calls."""
    valgrind = ["valgrind", "--tool=callgrind", f"--toggle-collect={call}"]
    valgrind.append(f"--callgrind-out-file={work / 'callgrind.out'}")
    printed = run([*valgrind, program, message.name, call, str(calls)], errors=True)
    found = re.search(r"Collected : (\d+)", printed)
    if not found:
        sys.exit(f"callgrind gave no count of {call}")
    return int(found.group(1))


def version(compiler: str) -> str:
    """Return the compiler's first line of --version."""
    return run([compiler, "--version"]).splitlines()[0]


def run(command: Sequence[str | Path], errors: bool = False) -> str:
    """Run `command` and return what it prints; end the bench with its output when it fails."""
    words = [str(word) for word in command]
    result = subprocess.run(words, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(words)} failed ({result.returncode}):\n{result.stdout}{result.stderr}")
    return result.stderr if errors else result.stdout
