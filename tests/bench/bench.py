# SPDX-License-Identifier: Apache-2.0
"""`make bench`: times of generate and build, of encode and decode beside Fast CDR, instructions, flash of types, firmware.

Times depend on the machine; so each stands beside a peer that ran in the same minutes. Instruction counts come
from callgrind and repeat exactly with one compiler.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from codec import bench_codec
from footprint import bench_footprint
from instructions import bench_instructions
from type_flash import bench_type_flash

ROOT = Path(__file__).resolve().parents[2]
IDL = ROOT / "microros_gen" / "idl"
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


def main() -> int:
    """Run the selected parts and print one table each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "parts", nargs="*", default=["generate", "build", "instructions", "codec", "types", "footprint"]
    )
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        if "generate" in options.parts:
            bench_generate(work)
            bench_scaling(work)
        if "build" in options.parts:
            bench_build(work)
        if "instructions" in options.parts:
            bench_instructions(work)
        if "codec" in options.parts:
            bench_codec(work / "codec")
        if "types" in options.parts:
            bench_type_flash(work)
        if "footprint" in options.parts:
            bench_footprint(work / "footprint")
    return 0


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


def row(what: str, seconds: float, target: str, peer: float | None = None) -> None:
    """Print a line of a table of times."""
    ratio = f"{seconds / peer:8.3f}" if peer else f"{'':8}"
    print(f"{what:<58} {seconds:8.2f} s  {ratio}  {target}")


def bench_generate(work: Path) -> None:
    """`generate` of all common_interfaces packages."""
    out, cache = work / "all", work / "cache"
    config = work / "all.yaml"
    packages = ", ".join(COMMON_INTERFACES)
    config.write_text(
        f"version: 1\nprofiles: [pure_sender]\ninterfaces: [{packages}]\npools: {{publishers: 4}}\n"
        "transport: {type: udp, mtu: 60000}\nlimits: {'*': {string: 8, sequence: 2}}\n"
    )
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    command = tool("generate", "-c", str(config), "--interface-path", str(IDL), "-o", str(out))
    count = sum(len(list((IDL / p / "msg").glob("*.msg"))) for p in COMMON_INTERFACES)
    print(f"generate: {len(COMMON_INTERFACES)} packages of common_interfaces, {count} .msg files")
    print("  wall time of the whole process, interpreter start included; median of 5")
    start = timed([sys.executable, "-c", "pass"], environment, 5)
    peer = peer_rosidl(work)
    print(f"{'':58} {'':10}  {'to peer' if peer else '':8}  target")
    row("the interpreter alone", start, "")
    if peer:
        row("peer: rosidl_generator_c of ROS 2 Jazzy, one step of five", peer, "", peer)
    row("from nothing", timed(command, environment, 5, out), "1 s", peer)
    row("unchanged", timed(command, environment, 5), "0.2 s", peer)
    print()


def bench_scaling(work: Path) -> None:
    """`generate` of more and more interfaces: the time has to grow as they do."""
    print("generate: packages of N messages of six members each, and every interface that the wheels install")
    print("  wall time of the whole process, from nothing; median of 3")
    print(f"{'':58} {'':10}  {'ms each':8}")
    environment = {**os.environ, "XDG_CACHE_HOME": str(work / "cache")}
    start = generate_time(work, environment, synthetic(work, 1), ["synthetic_1"])
    row("1 message", start, "")
    for count in (10, 100, 1000):
        seconds = generate_time(work, environment, synthetic(work, count), [f"synthetic_{count}"])
        each = (seconds - start) / count * 1000
        print(f"{f'{count} messages':<58} {seconds:8.2f} s  {each:8.2f}")
    packages, files = installed_interfaces()
    if files:
        seconds = generate_time(work, environment, None, packages)
        row(f"{files} interface files of the wheels, services and actions too", seconds, "1.5 s")
    print()


def synthetic(work: Path, count: int) -> Path:
    """Write a package of `count` messages, each of its neighbour and of common types."""
    folder = work / f"synthetic_{count}" / "msg"
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        neighbour = f"Type{i - 1} neighbour\n" if i % 10 else ""
        members = "std_msgs/Header header\nstring name\nfloat64[9] matrix\nint32[] counts\nbool valid\n"
        (folder / f"Type{i}.msg").write_text(members + neighbour)
    return folder.parent


def installed_interfaces() -> tuple[list[str], int]:
    """Return the packages of this environment that have interfaces, and how many files those are."""
    share = Path(sys.prefix) / "share"
    files = [f for kind in ("msg", "srv", "action") for f in share.glob(f"*/{kind}/*.{kind}")]
    return sorted({f.parent.parent.name for f in files}), len(files)


def generate_time(work: Path, environment: dict[str, str], path: Path | None, packages: list[str]) -> float:
    """Return the median seconds of a generation of `packages`, those below `path` among them."""
    config, out = work / "scale.yaml", work / "scale"
    config.write_text(
        f"version: 1\nprofiles: [pure_sender]\ninterfaces: [{', '.join(packages)}]\npools: {{publishers: 4}}\n"
        "transport: {type: udp, mtu: 60000}\nlimits: {'*': {string: 12, sequence: 3}}\n"
    )
    command = tool("generate", "-c", str(config), "-o", str(out))
    return timed([*command, "--interface-path", str(path)] if path else command, environment, 3, out)


def peer_rosidl(work: Path) -> float | None:
    """Time one step of ROS 2's generator on the same packages, where it is installed."""
    if importlib.util.find_spec("rosidl_generator_c") is None:
        return None
    out = work / "peer"
    command = [sys.executable, str(Path(__file__).with_name("peer_rosidl.py")), str(out), *COMMON_INTERFACES]
    return timed(command, dict(os.environ), 1, out)


def bench_build(work: Path) -> None:
    """`build` of pure_sender for the host."""
    out = work / "pure_sender"
    environment = {**os.environ, "XDG_CACHE_HOME": str(work / "cache")}
    command = tool("build", "--profile", "pure_sender", "-o", str(out))
    print("build: pure_sender with std_msgs/msg/Int32 for the host")
    print("  wall time of the whole process with the host's C compiler; median of 3")
    row("from nothing", timed(command, environment, 3, out), "3 s")
    row("unchanged", timed(command, environment, 3), "")
    row("a limit changed", time_of_a_changed_limit(work, environment), "1 s")
    print()


def time_of_a_changed_limit(work: Path, environment: dict[str, str]) -> float:
    """Return the median seconds of a build of sensor_msgs/msg/Imu after its limit changed."""
    config, out = work / "limit.yaml", work / "limit"
    times = []
    for limit in (16, 24, 32, 40):
        config.write_text(
            "version: 1\nprofiles: [pure_sender]\ninterfaces: [sensor_msgs/msg/Imu]\n"
            f"limits: {{'*': {{string: {limit}}}}}\n"
        )
        times.append(timed(tool("build", "-c", str(config), "-o", str(out)), environment, 1))
    return statistics.median(times[1:])


if __name__ == "__main__":
    sys.exit(main())
