# SPDX-License-Identifier: Apache-2.0
"""Times of `generate` besides the pipeline of the installed ROS 2, and how they grow with the number of interfaces."""

from __future__ import annotations

import importlib.util
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from tests.support.paths import ROOT

SHIPPED = ROOT / "microros_gen" / "idl"
COMMON_INTERFACES = (
    "actionlib_msgs",
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "stereo_msgs",
    "trajectory_msgs",
    "visualization_msgs",
)


@dataclass(frozen=True)
class Case:
    """What is generated: packages, where they are besides the environment, and how many files they have."""

    label: str
    packages: Sequence[str]
    path: Path | None
    files: int


class Seconds(NamedTuple):
    """Wall time, and that of the processor, which other work on the machine changes less."""

    wall: float
    cpu: float


def timed(command: list[str], environment: dict[str, str], repeat: int, *fresh: Path) -> Seconds:
    """Return the medians for `command` with all that it starts; it finds no folder of `fresh` in any run."""
    times = []
    for _ in range(repeat):
        for folder in fresh:
            _put_aside(folder)
        start, before = time.perf_counter(), children()
        result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        times.append(Seconds(time.perf_counter() - start, children() - before))
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{result.stdout}{result.stderr}")
    return median(times)


def _put_aside(folder: Path) -> None:
    """Rename a folder. Removed files would slow down the next run: ext4 reuses no inode that was freed just now."""
    if folder.exists():
        folder.rename(Path(tempfile.mkdtemp(dir=folder.parent)) / folder.name)


def median(times: Sequence[Seconds]) -> Seconds:
    """Return the median of each."""
    return Seconds(statistics.median(t.wall for t in times), statistics.median(t.cpu for t in times))


def children() -> float:
    """Return seconds of the processor of all processes that ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def tool(*arguments: str) -> list[str]:
    """Return the command of the tool in this environment."""
    return [sys.executable, "-m", "microros_gen", *arguments]


def row(what: str, seconds: Seconds, target: str = "", peer: Seconds | None = None) -> None:
    """Print a line of a table of times; the ratio is of the processor's time."""
    ratio = f"{seconds.cpu / peer.cpu:8.4f}" if peer else f"{'':8}"
    print(f"{what:<62} {seconds.wall:7.2f} {seconds.cpu:7.2f} s  {ratio}  {target}".rstrip())


def bench_generate(work: Path) -> None:
    """Print the table of common_interfaces and all interfaces of the wheels, and that of growing numbers."""
    cache = work / "cache"
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # modules are compiled once, as in any installation
    files = sum(len(list((SHIPPED / p / "msg").glob("*.msg"))) for p in COMMON_INTERFACES)
    cases = [(Case("common_interfaces, 11 packages", COMMON_INTERFACES, SHIPPED, files), "0.5 s", "0.08 s")]
    installed = installed_interfaces()
    if installed.files:
        cases.append((installed, "0.8 s", "0.25 s"))
    peer = peer_rosidl(work, installed.packages)
    print(
        "generate: wall time and processor time of the whole process, interpreter start included; median of 5"
    )
    print("  peer: ROS 2's own pipeline for C in one process, by step, after its start; once")
    print(f"{'':62} {'wall':>7} {'cpu':>7}    {'to peer':8}  target")
    row("the interpreter alone", timed([sys.executable, "-c", "pass"], environment, 5))
    for case, target, target_unchanged in cases:
        print(f"{case.label}, {case.files} files")
        whole = print_peer(peer, case.packages)
        command = generate(work / "generate", case)
        row("  from nothing", timed(command, environment, 5, work / "generate", cache), target, whole)
        row("  unchanged", timed(command, environment, 5), target_unchanged, whole)
    bench_growth(work, environment, cache)
    print()


def bench_growth(work: Path, environment: dict[str, str], cache: Path) -> None:
    """`generate` of more and more interfaces: the time has to grow as they do."""
    print("packages of N messages of six members each, from nothing; processor time of each beyond the first")
    start = None
    for count in (1, 10, 100, 215, 1000):
        case = Case("", [f"synthetic_{count}"], synthetic(work, count), count)
        seconds = timed(generate(work / "generate", case), environment, 3, work / "generate", cache)
        start = start or seconds
        each = f"{(seconds.cpu - start.cpu) / (count - 1) * 1000:.2f} ms" if count > 1 else ""
        row(f"  {count} messages", seconds, f"{each}; target 2 ms" if each else "")


def generate(out: Path, case: Case) -> list[str]:
    """Write the application of a case and return the command that generates it."""
    config = out.with_suffix(".yaml")
    config.write_text(
        f"version: 1\nprofiles: [pure_sender]\ninterfaces: [{', '.join(case.packages)}]\npools: {{publishers: 4}}\n"
        "transport: {type: udp, mtu: 60000}\nlimits: {'*': {string: 12, sequence: 3}}\n"
    )
    command = tool("generate", "-c", str(config), "-o", str(out))
    return [*command, "--interface-path", str(case.path)] if case.path else command


def synthetic(work: Path, count: int) -> Path:
    """Write a package of `count` messages, each of its neighbor and of common types."""
    folder = work / f"synthetic_{count}" / "msg"
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        neighbor = f"Type{i - 1} neighbor\n" if i % 10 else ""
        members = "std_msgs/Header header\nstring name\nfloat64[9] matrix\nint32[] counts\nbool valid\n"
        (folder / f"Type{i}.msg").write_text(members + neighbor)
    return folder.parent


def installed_interfaces() -> Case:
    """Return every package of this environment that has interfaces."""
    share = Path(sys.prefix) / "share"
    files = [f for kind in ("msg", "srv", "action") for f in share.glob(f"*/{kind}/*.{kind}")]
    packages = sorted({f.parent.parent.name for f in files})
    return Case("every interface of the wheels, services and actions too", packages, None, len(files))


def peer_rosidl(work: Path, packages: Sequence[str]) -> dict[str, dict[str, Seconds]]:
    """Return seconds of the peer by step and package; nothing where it is not installed."""
    if not packages or importlib.util.find_spec("rosidl_typesupport_fastrtps_c") is None:
        return {}
    program = Path(__file__).with_name("peer_rosidl.py")
    command = [sys.executable, str(program), str(work / "peer"), *packages]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"the peer failed:\n{result.stdout}{result.stderr}")
    found = json.loads(result.stdout)
    return {step: {name: Seconds(*times) for name, times in each.items()} for step, each in found.items()}


def print_peer(peer: dict[str, dict[str, Seconds]], packages: Iterable[str]) -> Seconds | None:
    """Print the peer's steps for these packages and return their sum; None without a peer."""
    if not peer:
        return None
    steps = {name: total(each[package] for package in packages) for name, each in peer.items()}
    whole = total(steps.values())
    for name, seconds in steps.items():
        row(f"  peer, {name}", seconds)
    row("  peer, the four steps", whole, "", whole)
    return whole


def total(times: Iterable[Seconds]) -> Seconds:
    """Return the sum of each."""
    walls, cpus = zip(*times, strict=True)
    return Seconds(sum(walls), sum(cpus))
