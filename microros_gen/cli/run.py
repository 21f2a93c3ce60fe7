# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run`: starts a built image together with an agent."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path
from types import FrameType

import click

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.tree import MANIFEST

AGENT_READY = "agent ready"


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--no-agent", is_flag=True, help="Start the image alone: an agent runs already.")
def command(out: Path, no_agent: bool) -> int:
    """Start the image of OUT (made by `build`) and an agent for it; Ctrl-C ends both.

    The exit status is the image's.
    """
    image, port = _image_of(out)
    agent = None if no_agent else _start_agent(port)
    try:
        return _run_image(image)
    finally:
        if agent is not None:
            agent.terminate()
            agent.wait(timeout=10)


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


def _start_agent(port: int) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "microros_gen", "agent", "udp4", "--port", str(port)]
    agent = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert agent.stdout is not None
    for line in agent.stdout:
        click.echo(line, nl=False)
        if line.startswith(AGENT_READY):
            return agent
    raise UserError([Diagnostic(f"the agent did not start (status {agent.wait()}, see above)")], status=1)


def _run_image(image: Path) -> int:
    process = subprocess.Popen([str(image)])

    def end(_signal: int, _frame: FrameType | None) -> None:
        process.terminate()

    previous = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        status = process.wait()
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
    return 0 if status == -signal.SIGTERM else status
