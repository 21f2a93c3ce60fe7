# SPDX-License-Identifier: Apache-2.0
"""Times of `generate` beside the pipeline of the installed ROS 2, and how they grow with the number of interfaces."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

SHIPPED = Path(__file__).resolve().parents[2] / "microros_gen" / "idl"
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
    """What is generated: packages, where they are beside the environment, and how many files they have."""

    label: str
    packages: Sequence[str]
    path: Path | None
    files: int


def timed(command: list[str], environment: dict[str, str], repeat: int, fresh: Path | None = None) -> float:
    """Return the median seconds of `command`; `fresh` is removed before each run."""
    times = []
    for _ in range(repeat):
        if fresh is not None:
            shutil.rmtree(fresh, ignore_errors=True)
        start = time.perf_counter()
        result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        times.append(time.perf_counter() - start)
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{result.stdout}{result.stderr}")
    return statistics.median(times)


def tool(*arguments: str) -> list[str]:
    """Return the command of the tool in this environment."""
    return [sys.executable, "-m", "microros_gen", *arguments]


def row(what: str, seconds: float, target: str = "", peer: float | None = None) -> None:
    """Print a line of a table of times."""
    ratio = f"{seconds / peer:8.4f}" if peer else f"{'':8}"
    print(f"{what:<70} {seconds:8.2f} s  {ratio}  {target}".rstrip())


def bench_generate(work: Path) -> None:
    """Print the table of common_interfaces and all interfaces of the wheels, and that of growing numbers."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(work / "cache")}
    files = sum(len(list((SHIPPED / p / "msg").glob("*.msg"))) for p in COMMON_INTERFACES)
    cases = [(Case("common_interfaces, 11 packages", COMMON_INTERFACES, SHIPPED, files), "1 s", "0.2 s")]
    installed = installed_interfaces()
    if installed.files:
        cases.append((installed, "1.5 s", "0.25 s"))
    peer = peer_rosidl(work, installed.packages)
    print("generate: wall time of the whole process, interpreter start included; median of 5")
    print("  peer: ROS 2's own pipeline for C in one process, by step, after its start; once")
    print(f"{'':70} {'':10}  {'to peer':8}  target")
    row("the interpreter alone", timed([sys.executable, "-c", "pass"], environment, 5))
    for case, target, target_unchanged in cases:
        print(f"{case.label}, {case.files} files")
        whole = print_peer(peer, case.packages)
        command = generate(work / "generate", case)
        row("  from nothing", timed(command, environment, 5, work / "generate"), target, whole)
        row("  unchanged", timed(command, environment, 5), target_unchanged, whole)
    bench_growth(work, environment)
    print()


def bench_growth(work: Path, environment: dict[str, str]) -> None:
    """`generate` of more and more interfaces: the time has to grow as they do."""
    print("packages of N messages of six members each, from nothing")
    start = 0.0
    for count in (1, 10, 100, 1000):
        case = Case("", [f"synthetic_{count}"], synthetic(work, count), count)
        seconds = timed(generate(work / "generate", case), environment, 3, work / "generate")
        start = start or seconds
        each = f"  {(seconds - start) / (count - 1) * 1000:.2f} ms for each more than 1" if count > 1 else ""
        print(f"{f'  {count} messages':<70} {seconds:8.2f} s{each}")


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
    """Write a package of `count` messages, each of its neighbour and of common types."""
    folder = work / f"synthetic_{count}" / "msg"
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        neighbour = f"Type{i - 1} neighbour\n" if i % 10 else ""
        members = "std_msgs/Header header\nstring name\nfloat64[9] matrix\nint32[] counts\nbool valid\n"
        (folder / f"Type{i}.msg").write_text(members + neighbour)
    return folder.parent


def installed_interfaces() -> Case:
    """Return every package of this environment that has interfaces."""
    share = Path(sys.prefix) / "share"
    files = [f for kind in ("msg", "srv", "action") for f in share.glob(f"*/{kind}/*.{kind}")]
    packages = sorted({f.parent.parent.name for f in files})
    return Case("every interface of the wheels, services and actions too", packages, None, len(files))


def peer_rosidl(work: Path, packages: Sequence[str]) -> dict[str, dict[str, float]]:
    """Return seconds of the peer by step and package; nothing where it is not installed."""
    if not packages or importlib.util.find_spec("rosidl_typesupport_fastrtps_c") is None:
        return {}
    program = Path(__file__).with_name("peer_rosidl.py")
    command = [sys.executable, str(program), str(work / "peer"), *packages]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"the peer failed:\n{result.stdout}{result.stderr}")
    seconds: dict[str, dict[str, float]] = json.loads(result.stdout)
    return seconds


def print_peer(peer: dict[str, dict[str, float]], packages: Iterable[str]) -> float | None:
    """Print the peer's steps for these packages and return their sum; None without a peer."""
    if not peer:
        return None
    steps = {name: sum(seconds[p] for p in packages) for name, seconds in peer.items()}
    whole = sum(steps.values())
    for name, seconds in steps.items():
        row(f"  peer, {name}", seconds)
    row("  peer, the four steps", whole, "", whole)
    return whole
