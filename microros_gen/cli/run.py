# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run`: starts a built image together with an agent."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path
from types import FrameType
from typing import Any

import click

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.tree import MANIFEST

AGENT_READY = "agent ready"


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--no-agent", is_flag=True, help="Start the image alone: an agent runs already.")
def command(out: Path, no_agent: bool) -> int:
    """Start the image of OUT (made by `build`) and an agent for it; Ctrl-C or SIGTERM ends both.

    The exit status is the image's (128 and more: a signal ended it), or 0 after Ctrl-C.

    \b
    microros-gen run build/pure_sender
    microros-gen run build/pure_sender --no-agent
    """
    image, port = _image_of(out)
    with _Parts() as parts:
        if not no_agent:
            _start_agent(parts, port)
        status = parts.wait_for(parts.start([str(image)]))
    return 0 if parts.stopped else status


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

    def start(self, command: list[str], output: int | None = None) -> subprocess.Popen[str]:
        """Start a process; a signal that came meanwhile ends it too."""
        process = subprocess.Popen(command, stdout=output, text=True)
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
        if process.stdout is not None:
            process.stdout.close()


def _image_of(out: Path) -> tuple[Path, int]:
    try:
        manifest = json.loads((out / MANIFEST).read_text(encoding="utf-8"))
        name, transport = manifest["image"], manifest["transport"]
    except (OSError, ValueError, KeyError) as error:
        raise UserError(
            [
                Diagnostic(
                    f"{out} is no output folder of microros-gen", hint="Give the folder that `build` wrote"
                )
            ]
        ) from error
    image = out / "bin" / name
    if not image.is_file():
        raise UserError(
            [Diagnostic(f"{out} holds no image yet", hint="Make it with `microros-gen build`, then run it")]
        )
    return image.resolve(), int(transport["agent"].rsplit(":", 1)[1])


def _start_agent(parts: _Parts, port: int) -> None:
    command = [sys.executable, "-m", "microros_gen", "agent", "udp4", "--port", str(port)]
    agent = parts.start(command, subprocess.PIPE)
    assert agent.stdout is not None
    for line in agent.stdout:
        click.echo(line, nl=False)
        if line.startswith(AGENT_READY):
            return
    if not parts.stopped:
        raise UserError([Diagnostic(f"the agent did not start (status {agent.wait()}, see above)")], status=1)
