# SPDX-License-Identifier: Apache-2.0
"""Reads the code blocks of a page and runs its console blocks, in the order of the page, in one folder.

In a block marked `console` a line `$ command` is run by a shell; the lines below it are what it prints: `...` alone
matches any lines, `…` any part of a line, and sizes that a compiler gives are not compared. Without such lines
only the status counts. A command with `&` at its end runs on until the page ends; its lines are waited for. A block
marked `sh` has commands alone, one a line. Where the lines shown have an `error: `, the command must fail, and the
lines are what it prints to stderr. A block with `title="path"` is a file that the page has the reader write.
What stands in an admonition `not-run` is left out.
"""

from __future__ import annotations

import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds

SHELL = ("console", "sh")
"""Languages of blocks with commands; no other name for them is taken."""
_FENCE = re.compile(
    r"^( *)```(?:(\w[\w-]*))?[^\S\n]*([^\n]*)\n(.*?)^\1```[^\S\n]*$", re.MULTILINE | re.DOTALL
)
_NOT_RUN = re.compile(r'^!!! not-run "([^"\n]*)"\n((?:(?: {4}.*)?\n)*)', re.MULTILINE)
_WAIT_S = 60.0


@dataclass(frozen=True)
class Block:
    """A code block: its language, its file name ("" for none), its text, and why it is not run ("": it is)."""

    language: str
    title: str
    text: str
    not_run: str

    @property
    def commands(self) -> list[tuple[str, list[str]]]:
        """Each command of the block, with the lines that it shows."""
        if self.language != "console":
            lines = re.sub(r"\s+#\s.*|\\\n", " ", self.text).splitlines()
            return [(line.strip(), []) for line in lines if line.strip()]
        found: list[tuple[str, list[str]]] = []
        for line in self.text.splitlines():
            if line.startswith("$ "):
                found.append((line[2:], []))
            elif found:
                found[-1][1].append(line)
        return found


def blocks(page: str) -> list[Block]:
    """Return the code blocks of a page in order."""
    boxes = [(found.span(), found[1]) for found in _NOT_RUN.finditer(page)]
    return [_block(found, boxes) for found in _FENCE.finditer(page)]


def _block(found: re.Match[str], boxes: list[tuple[tuple[int, int], str]]) -> Block:
    reasons = [reason for (start, end), reason in boxes if start <= found.start() < end]
    title = re.search(r'title="([^"]+)"', found[3])
    indent = len(found[1])
    text = "".join(line[indent:] if line.strip() else line for line in found[4].splitlines(keepends=True))
    return Block(found[2] or "", title[1] if title else "", text, reasons[0] if reasons else "")


def masked(text: str) -> str:
    """Sizes of compiled code are the compiler's, numbers of objects may grow with the runtime."""
    text = re.sub(r"(?m)^(library .*): \d+ bytes of code.*$", r"\1", text)
    return re.sub(r"(?m)^(files|compiled) +\d+", r"\1 N", text).rstrip()


def shows(printed: str, shown: list[str], is_prefix: bool = False) -> bool:
    """Return whether what was printed is what a page shows; `is_prefix`: whether it begins with it."""
    lines = masked("\n".join(shown)).splitlines()
    parts = [r"(?:.*\n)*?" if line == "..." else re.escape(line).replace("…", ".*") + "\n" for line in lines]
    pattern = "".join(parts) + (r"(?:.*\n)*" if is_prefix or not shown else "")
    return re.fullmatch(pattern, masked(printed) + "\n") is not None


class Terminal:
    """Runs commands of a page in one folder, with a port instead of 8888 and its own ROS domain."""

    def __init__(self, folder: Path, port: int) -> None:
        self._folder = folder
        self._port = str(port)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self._http_port = str(free.getsockname()[1])
        self._running: list[tuple[str, subprocess.Popen[str], list[str]]] = []
        self._session = TemporaryDirectory()  # paths of sockets are short
        tools = folder / ".tools"
        tools.mkdir()
        self.domain = 1 + port % 100
        """Of the terminal's programs; 1 to 100."""
        domain = str(self.domain)
        python = shlex.quote(sys.executable)
        _script(tools / "python3", f'exec {python} "$@"')
        own_domain = (
            f'case "$* " in *" --check "*|"agent status"*) ;;'
            f' "agent "*|"run "*) set -- "$@" --domain {domain};; esac'
        )
        patient = 'case "$1" in topic|service|param|action) set -- "$@" --spin-time 30;; esac'
        _script(tools / "microros-gen", f'{own_domain}\n{patient}\nexec {python} -m microros_gen "$@"')
        self._environment = {
            **os.environ,
            "PATH": f"{tools}:{os.environ['PATH']}",
            "PYTHONPATH": str(ROOT),
            "PYTHONUNBUFFERED": "1",
            "CFLAGS": "-O0",  # of the host's compiler: it takes half of the time
            "HOME": str(folder),
            "XDG_CACHE_HOME": str(folder / ".cache"),
            "XDG_RUNTIME_DIR": self._session.name,
            "MICROROS_GEN_OBJECTS": "",  # pages show how many objects are compiled the first time
            "microros_gen_DIR": str(ROOT / "cmake"),
            "ROS_DOMAIN_ID": domain,
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        self._copy_examples()

    def _copy_examples(self) -> None:
        for path in (ROOT / "examples").rglob("*"):
            copy = self._folder / path.relative_to(ROOT)
            if path.is_dir():
                copy.mkdir(parents=True, exist_ok=True)
            elif path.suffix != ".pyc":
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_text(self._moved(path.read_text(encoding="utf-8")))

    def _moved(self, text: str) -> str:
        return re.sub(r"\b9464\b", self._http_port, re.sub(r"\b8888\b", self._port, text))

    def write(self, block: Block) -> None:
        """Write the file that a page shows."""
        assert "--8<--" not in block.text, f"{block.title} is in the repository already"
        path = self._folder / block.title
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self._moved(block.text), encoding="utf-8")

    def run(self, command: str, shown: list[str]) -> None:
        """Run a command; fails with what it printed where that is not what the page shows, or its status is not 0."""
        if command.endswith("&"):
            self._start(command.removesuffix("&").strip(), shown)
            return
        done = subprocess.run(
            ["bash", "-c", self._moved(command)],
            cwd=self._folder,
            env=self._environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=seconds(300),
        )
        fails = any("error: " in line for line in shown)
        assert (done.returncode != 0) is fails, f"$ {command}\n{done.stdout}{done.stderr}{self._others()}"
        printed = done.stderr if fails else done.stdout
        assert not shown or shows(self._unmoved(printed), shown), f"$ {command}\n{printed}"

    def _unmoved(self, text: str) -> str:
        return re.sub(rf"\b{self._port}\b", "8888", text)

    def _start(self, command: str, shown: list[str]) -> None:
        process = subprocess.Popen(
            ["bash", "-c", "exec " + self._moved(command)],
            cwd=self._folder,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        output: list[str] = []
        self._running.append((command, process, output))
        threading.Thread(target=_collect, args=(process, output), daemon=True).start()
        end = deadline(_WAIT_S)
        while not shows(self._unmoved("".join(output)), shown, is_prefix=True):
            assert time.monotonic() < end, f"$ {command} &\n{''.join(output)}"
            assert process.poll() is None, f"$ {command} & ended with {process.returncode}\n{''.join(output)}"
            time.sleep(0.05)

    def _others(self) -> str:
        return "".join(f"\n$ {command} &\n{''.join(output)}" for command, _, output in self._running)

    def close(self) -> None:
        """Press Ctrl-C for what still runs, the last one first; each has to end without complaint."""
        complaints = []
        for command, process, output in reversed(self._running):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                process.wait(20)
            if process.poll() not in (0, 130):
                complaints.append(f"$ {command} & ended with {process.poll()}\n{''.join(output)}")
            process.kill()
            process.wait()
        self._session.cleanup()
        assert not complaints, complaints


def _script(path: Path, text: str) -> None:
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


def _collect(process: subprocess.Popen[str], output: list[str]) -> None:
    assert process.stdout is not None
    for line in process.stdout:
        output.append(line)
    process.stdout.close()


def steps(page: str) -> Iterator[Block]:
    """Yield what a reader does on a page: files to write, console blocks to run."""
    for block in blocks(page):
        if not block.not_run and (block.title or block.language in SHELL):
            yield block
