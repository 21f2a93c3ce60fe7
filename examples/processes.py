# SPDX-License-Identifier: Apache-2.0
"""Processes of the demonstrations: they are started, waited for and ended together."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOOL = (sys.executable, "-m", "microros_gen")
PORTS = range(8888, 8888 + 20)
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


def missing_firmware_packages() -> list[str]:
    """Return the Debian packages without which an image for a board cannot be built and run."""
    return [package for program, package in FIRMWARE_NEEDS if shutil.which(program) is None]


def check_firmware_tools() -> None:
    """Raise PartFailedError if a board cannot be built and run here."""
    if missing := missing_firmware_packages():
        raise PartFailedError(f"tools: something is missing; apt-get install {' '.join(missing)}")


def run_cmake(source: Path, out: Path, *options: str) -> None:
    """Configure and build a CMake project with the tool of this interpreter; print what they print if one fails."""
    search = f"-DCMAKE_PREFIX_PATH={sys.prefix}"
    for command in (
        ["cmake", "-S", str(source), "-B", str(out), search, *options],
        ["cmake", "--build", str(out), "-j2"],
    ):
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        if done.returncode != 0:
            print(done.stdout + done.stderr, end="")
            raise PartFailedError(f"{out.name}: the boards could not be built (see above)")


def run_build(name: str, config: Path, out: Path, *options: str) -> None:
    """Run `build` of an application file."""
    command = [*TOOL, "build", "-c", str(config), "-o", str(out), *options]
    if subprocess.run(command, check=False).returncode != 0:
        raise PartFailedError(f"{name}: the image could not be built (see above)")


def agent(port: int, log: Path | None = None) -> AbstractContextManager[subprocess.Popen[str]]:
    """Start an agent in the domain of the ROS nodes; end it afterwards."""
    command = [*TOOL, "agent", "udp4", "--port", str(port)]
    return part("agent", [*command, "--domain", domain()], "agent ready", log)


@contextmanager
def part(
    name: str, command: list[str], ready: str | None, log: Path | None = None
) -> Iterator[subprocess.Popen[str]]:
    """Start a process, wait for the line that says it is ready, and end it afterwards.

    What it writes to stderr is in the file `log`, or else on the terminal.
    """
    with ExitStack() as stack:
        errors = None if log is None else stack.enter_context(log.open("w", encoding="utf-8"))
        output = subprocess.PIPE if ready else None
        process = subprocess.Popen(command, env=environment(), stdout=output, stderr=errors, text=True)
        stack.callback(end, process)
        if ready:
            wait_for(process, name, ready, log)
        yield process


def end(process: subprocess.Popen[str]) -> None:
    """Ask a process to end, and end it if it does not."""
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
    try:
        process.wait(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def wait_for(process: subprocess.Popen[str], name: str, ready: str, log: Path | None) -> None:
    """Read lines until the one that starts with `ready`."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith(ready):
            return
        print(f"   {line}", end="")
    where = "" if log is None else f"; see {log.relative_to(ROOT)}"
    raise PartFailedError(f"{name}: it ended with status {process.wait()} before it was ready{where}")
