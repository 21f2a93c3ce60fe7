# SPDX-License-Identifier: Apache-2.0
"""Processes of the demonstrations: they are started, waited for and ended together."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOOL = (sys.executable, "-m", "microros_gen")
PORTS = range(8888, 8908)
FIRMWARE_NEEDS = (
    ("arm-none-eabi-gcc", "gcc-arm-none-eabi libnewlib-arm-none-eabi"),
    ("qemu-system-arm", "qemu-system-arm"),
)


class PartFailedError(Exception):
    """A part of a demonstration failed; the text has its name and the cause."""


def free_port() -> int:
    """Return the first free UDP port; the usual one if it is free."""
    for port in PORTS:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
    raise PartFailedError(f"ports: UDP ports {PORTS[0]} to {PORTS[-1]} are all in use")


def domain() -> str:
    """Return the domain of the ROS nodes."""
    return os.environ.get("ROS_DOMAIN_ID") or "0"


def environment() -> dict[str, str]:
    """Return the environment of a part: ROS on this machine alone, output without delay."""
    return {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", **os.environ, "PYTHONUNBUFFERED": "1"}


def run_build(name: str, config: Path, out: Path, *options: str) -> None:
    """Run `build` of an application file."""
    command = [*TOOL, "build", "-c", str(config), "-o", str(out), *options]
    if subprocess.run(command, check=False).returncode != 0:
        raise PartFailedError(f"{name}: the image could not be built (see above)")


def agent(port: int) -> AbstractContextManager[subprocess.Popen[str]]:
    """Start an agent in the domain of the ROS nodes; end it afterwards."""
    command = [*TOOL, "agent", "udp4", "--port", str(port)]
    return part("agent", [*command, "--domain", domain()], "agent ready")


@contextmanager
def part(name: str, command: list[str], ready: str | None) -> Iterator[subprocess.Popen[str]]:
    """Start a process, wait for the line that says it is ready, and end it afterwards."""
    output = subprocess.PIPE if ready else None
    process = subprocess.Popen(command, env=environment(), stdout=output, text=True)
    try:
        if ready:
            wait_for(process, name, ready)
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
        try:
            process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def wait_for(process: subprocess.Popen[str], name: str, ready: str) -> None:
    """Read lines until the one that starts with `ready`."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith(ready):
            return
        print(f"   {line}", end="")
    raise PartFailedError(f"{name}: it ended with status {process.wait()} before it was ready")
