# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run`: starts a built image together with an agent."""

from __future__ import annotations

import contextlib
import os
import re
import shlex
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import FrameType
from typing import Any

import click

from microros_gen.cli.options import image_option
from microros_gen.client.plan.slices import DISCOVERY_GROUP
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import read_json
from microros_gen.image.records import Located, locate
from microros_gen.output.tree import MANIFEST
from microros_gen.records import dataclass
from microros_gen.toolchain.emulator import Emulator, Machine

AGENT_READY = "agent ready"
_LAST_LINE = re.compile(r"(PASS|FAIL) \d+ of \d+")
"""Of the self-test."""


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@image_option("Your own image to start, linked with the library of OUT. Default: the image that was built.")
@click.option(
    "--selftest",
    is_flag=True,
    help="Start the self-test that `build --selftest` made, without an agent; the exit status is 1 if a check fails.",
)
@click.option(
    "--no-agent",
    is_flag=True,
    help="Start only the image: an agent is already running, or you start one yourself.",
)
@click.option(
    "--domain",
    type=click.IntRange(0, 232),
    help="ROS domain that the agent puts the image into. Default: the one that the image requests.",
)
def command(out: Path, image: Path | None, selftest: bool, no_agent: bool, domain: int | None) -> int:
    """Start the image of OUT and an agent for it; Ctrl-C or SIGTERM ends both.

    OUT is a folder that `build` wrote, or a CMake build folder with its own image. An image for a board runs in the
    emulator of the target. Its serial line is a pseudo-terminal whose path is printed; the image keeps running if
    an agent leaves the line and returns. The exit status is that of the image (128 and more: a signal ended it), or
    0 after Ctrl-C. If the board resets, because main() returned or after a fault, the run ends with 0; with
    --no-agent the board starts again, as real hardware would.

    \b
    microros-gen run build/pure_sender
    microros-gen run build/pure_sender --no-agent
    microros-gen run my_robot/build
    microros-gen run build/pure_sender --selftest
    """
    if selftest:
        if image is not None:
            raise click.UsageError("--selftest names the image: leave out --image.")
        image, no_agent = _selftest_of(out), True
    found = _image_of(locate(out, image), domain)
    with _Parts() as parts:
        if selftest and found.machine is not None:
            return 0 if _test_emulated(parts, found) or parts.stopped else 1
        start = _run_here if found.machine is None else _run_emulated
        try:
            status = start(parts, found, no_agent)
        except UserError:
            if not parts.stopped:
                raise
            status = 0
    return 0 if parts.stopped else status


@dataclass(frozen=True)
class _Image:
    """A built image: `machine` is what emulates its board, `transport` what the manifest says of it."""

    out: Path
    path: Path
    machine: Machine | None
    transport: Mapping[str, Any]
    domain: int | None

    @property
    def agent_options(self) -> list[str]:
        """The options that give an agent what it must hold for this image, and its ROS domain."""
        options = [] if self.domain is None else ["--domain", str(self.domain)]
        options += ["--manifest", str(self.out / MANIFEST)]  # type hashes of what the image exchanges
        for option, name in (("--references", "references.xml"), ("--entities", "entities.json")):
            path = self.out / "agent" / name
            options += [option, str(path)] if path.is_file() else []
        return options


def _run_here(parts: _Parts, image: _Image, no_agent: bool) -> int:
    if not no_agent:
        _start_agent(parts, [*_agent_of_host(image), *image.agent_options])
    return parts.wait_for(parts.start([str(image.path)]))


def _run_emulated(parts: _Parts, image: _Image, no_agent: bool) -> int:
    assert image.machine is not None
    command = image.machine.command(image.path, restarts=no_agent)
    process = parts.start(command, subprocess.PIPE, subprocess.PIPE)
    emulator = Emulator(process)
    device = emulator.device()
    agent = [
        "serial",
        "--dev",
        device,
        "--baud",
        str(image.transport.get("baud", 115_200)),
        *image.agent_options,
    ]
    click.echo(f"emulator ready: serial {device} ({image.machine.program})")
    if no_agent:
        click.echo(f"its agent: microros-gen agent {shlex.join(agent)}")
    else:
        with _held_open(device):
            _start_agent(parts, agent)
    sys.stdout.flush()
    emulator.go_on()
    emulator.drain()
    return parts.wait_for(process)


def _test_emulated(parts: _Parts, image: _Image) -> bool:
    """Print the lines of the self-test until the last one, and return whether all checks passed.

    Raises UserError if the emulator ends before it.
    """
    assert image.machine is not None
    command = image.machine.command(image.path, restarts=False)
    process = parts.start(command, subprocess.PIPE, subprocess.PIPE, subprocess.PIPE)
    emulator = Emulator(process)
    emulator.device()
    emulator.go_on()
    assert process.stderr is not None
    for line in process.stderr:
        click.echo(line, nl=False)
        last = _LAST_LINE.fullmatch(line.rstrip())
        if last is not None:
            return last[1] == "PASS"
    message = "the self-test ended before its last line"
    hint = "The check after the last one that is shown has stopped it: docs/howto/selftest.md"
    raise UserError([Diagnostic(message, hint=hint, id="MG-7163")], status=1)


@contextlib.contextmanager
def _held_open(device: str) -> Iterator[None]:
    """Hold a pseudo-terminal open: QEMU asks once a second whether anybody has it, and drops bytes until then."""
    handle = os.open(device, os.O_RDWR | os.O_NOCTTY)
    try:
        yield
    finally:
        os.close(handle)


class _Parts:
    """The processes of a run. From the start on, SIGINT and SIGTERM end them all, and so does the end of `with`."""

    def __init__(self) -> None:
        self.stopped = False
        self._processes: list[subprocess.Popen[str]] = []
        self._previous: dict[signal.Signals, Any] = {}

    def __enter__(self) -> _Parts:
        for number in (signal.SIGINT, signal.SIGTERM):
            self._previous[number] = signal.signal(number, self._on_signal)
        return self

    def __exit__(self, *_: object) -> None:
        self._terminate()
        for process in self._processes:
            self._await_end(process)
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    def start(
        self,
        command: list[str],
        output: int | None = None,
        standard_input: int | None = None,
        errors: int | None = None,
    ) -> subprocess.Popen[str]:
        """Start a process; a signal that came meanwhile ends it too. What follows `command` is as for subprocess."""
        process = subprocess.Popen(command, stdin=standard_input, stdout=output, stderr=errors, text=True)
        self._processes.append(process)
        if self.stopped:
            process.terminate()
        return process

    def wait_for(self, process: subprocess.Popen[str]) -> int:
        """Return the exit status of a process, as a shell does: 128 and the number of the signal that ended it."""
        status = process.wait()
        return 128 - status if status < 0 else status

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        self.stopped = True
        self._terminate()

    def _terminate(self) -> None:
        for process in self._processes:
            if process.poll() is None:
                process.terminate()

    @staticmethod
    def _await_end(process: subprocess.Popen[str]) -> None:
        try:
            process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for pipe in (process.stdin, process.stdout, process.stderr):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()


def _image_of(located: Located, domain: int | None) -> _Image:
    out = located.output
    try:
        manifest = read_json(out / MANIFEST, follow=False)
        name, target, transport = manifest["image"], manifest["target"], manifest["transport"]
        machine = Machine.of(manifest["emulator"]) if manifest["emulator"] else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        message = f"{out} is not an output folder of microros-gen"
        raise UserError(
            [Diagnostic(message, hint="Give the folder that `build` wrote", id="MG-9714")]
        ) from error
    path = located.image.image if located.image is not None else _example_of(located, name, target)
    if machine is None and target != "host":
        message = f"the image is for {target}, which has no emulator"
        raise UserError(
            [
                Diagnostic(
                    message, hint="Add `emulator: {program: …, package: …}` to the target file", id="MG-9715"
                )
            ]
        )
    return _Image(out, path.resolve(), machine, transport, domain)


def _selftest_of(out: Path) -> Path:
    """Return the image of the self-test below an output folder. UserError if none exists."""
    found = next((p for p in (out / "bin" / "selftest", out / "bin" / "selftest.elf") if p.is_file()), None)
    if found is None:
        hint = "Make it with `microros-gen build --selftest`, which says why if there is no image"
        raise UserError([Diagnostic(f"{out} contains no self-test", hint=hint, id="MG-7162")])
    return found


def _example_of(located: Located, name: str | None, target: str) -> Path:
    """Return the image that `build` made. UserError if none exists."""
    if located.library is not None:
        message = (
            f"{located.library.archive} is only a library: no image was linked to it by microros_image()"
        )
        raise UserError(
            [Diagnostic(message, hint="Give the one that you linked: --image FILE", id="MG-9716")]
        )
    if name is None:
        what = f"target {target} has no image, or the application must provide a part"
        message = f"{located.output} contains only a library: {what}"
        hint = "`microros-gen build` says which; --image FILE starts your own"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9717")])
    path = located.output / "bin" / name
    if not path.is_file():
        hint = (
            "Make it with `microros-gen build`, then run it; for your own image give the CMake build folder"
        )
        raise UserError([Diagnostic(f"{located.output} contains no image yet", hint=hint, id="MG-9718")])
    return path


def _agent_of_host(image: _Image) -> list[str]:
    """Return the agent's options for an image that runs on this machine."""
    kind = image.transport["type"]
    if kind in ("udp", "tcp"):
        host, _, port = image.transport["agent"].rpartition(":")
        if host == DISCOVERY_GROUP:
            return [f"{kind}4", "--discovery-port", port]
        return [f"{kind}{6 if host.startswith('[') else 4}", "--port", port]
    device = image.transport.get("device", "")
    if kind == "serial" and not device.startswith("/dev/"):
        return ["pty", "--link", device]
    if kind == "canfd":
        return ["canfd", "--device", device]
    what = f"opens {device} itself" if kind == "serial" else "has a custom transport"
    hint = "Start an agent at the other end (microros-gen agent --help), then run with --no-agent"
    raise UserError([Diagnostic(f"cannot start an agent for this image: it {what}", hint=hint, id="MG-9719")])


def _start_agent(parts: _Parts, options: list[str]) -> None:
    command = [sys.executable, "-m", "microros_gen", "agent", *options]
    agent = parts.start(command, subprocess.PIPE)
    assert agent.stdout is not None
    for line in agent.stdout:
        click.echo(line, nl=False)
        if line.startswith(AGENT_READY):
            return
    if not parts.stopped:
        raise UserError(
            [Diagnostic(f"the agent did not start (status {agent.wait()}, see above)", id="MG-9720")],
            status=1,
        )
