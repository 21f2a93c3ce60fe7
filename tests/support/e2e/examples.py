# SPDX-License-Identifier: Apache-2.0
"""Builds and runs the applications of examples/ as examples/README.md says."""

from __future__ import annotations

import os
import queue
import re
import shlex
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

from tests.support.e2e.images import BUILD_S, SANITIZE, run
from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds

EXAMPLES = ROOT / "examples"
NAMES = tuple(sorted(path.parent.name for path in EXAMPLES.glob("*/main.c")))
PAGE = (EXAMPLES / "README.md").read_text(encoding="utf-8")
STRICT = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion"),
    *("-Wshadow", "-Wmissing-prototypes", "-Werror"),
)


def commands(name: str) -> list[list[str]]:
    """Return the commands of the page, with its example replaced by the one called `name`."""
    (block,) = re.findall(r"^```console\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    lines = block.replace("publisher", name).splitlines()
    return [shlex.split(line.removeprefix("$ ").removesuffix(" &")) for line in lines]


class Examples:
    """Builds each example once, in a separate folder."""

    def __init__(self, folder: Path, port: int) -> None:
        """`port`: where the agent of all of them is."""
        self._folder = folder
        self._port = port

    def build(self, name: str) -> Path:
        """Run the first two commands of the page; return the program, which has sanitizers."""
        home = self._folder / name
        build, compile_, _, (program,) = commands(name)
        if not home.exists():
            home.mkdir(parents=True)
            (home / "examples").symlink_to(EXAMPLES)
            agent = ["--agent", f"127.0.0.1:{self._port}"] if "udp" in self._transport(name) else []
            environment = {**os.environ, "CFLAGS": "-O0", "XDG_CACHE_HOME": str(home / "cache")}
            assert (build[0], compile_[0]) == ("microros-gen", "cc")
            tool = [sys.executable, "-m", "microros_gen"]
            for command in ([*tool, *build[1:], *agent], [*compile_, *STRICT, *SANITIZE]):
                done = run(command, home, environment, BUILD_S)
                assert done.returncode == 0, done.stdout + done.stderr
        return home / program

    def build_all(self, names: Sequence[str]) -> list[Path]:
        """Build several, two at a time."""
        with ThreadPoolExecutor(2) as pool:
            return list(pool.map(self.build, names))

    @contextmanager
    def running(self, *names: str, argument: str = "") -> Iterator[list[Example]]:
        """Run examples side by side; at the end Ctrl-C ends each of them, with nothing to complain of."""
        programs = self.build_all(names)
        with ExitStack() as stack:
            examples = [Example(program, *([argument] if argument else [])) for program in programs]
            for example in examples:
                stack.callback(example.kill)
            yield examples
            for example in examples:
                example.stop()
            for example in examples:
                example.ends_well()

    @staticmethod
    def _transport(name: str) -> str:
        text = (EXAMPLES / name / "microros.yaml").read_text(encoding="utf-8")
        (transport,) = re.findall(r"(?m)^transport: \{type: (\w+)", text)
        return str(transport)


class Example:
    """A running example; what it prints and what it complains of are one stream of lines."""

    def __init__(self, program: Path, *arguments: str) -> None:
        self.log: list[str] = []
        self.complaints: tuple[str, ...] = ()
        self.process = subprocess.Popen(
            [program, *arguments], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
        self._lines: queue.Queue[str | None] = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line.rstrip("\n"))
        self._lines.put(None)

    def wait_for(self, part: str, timeout_s: float = 30.0) -> str:
        """Return the next line that contains `part`."""
        end = deadline(timeout_s)
        while time.monotonic() < end:
            try:
                line = self._lines.get(timeout=max(0.0, end - time.monotonic()))
            except queue.Empty:
                break
            if line is None:
                break
            self.log.append(line)
            if part in line:
                return line
        raise AssertionError(f"no '{part}':\n" + "\n".join(self.log))

    def ends_well(self) -> None:
        """Ask it to end where it does not do so by itself; each call until its end has succeeded."""
        status = self.process.wait(timeout=seconds(30))
        self._reader.join(10)
        self.log += list(iter(self._lines.get, None))
        assert status == 0, self.log
        errors = [line for line in self.log if ": error " in line]
        assert len(errors) == len(self.complaints), errors
        assert all(part in line for part, line in zip(self.complaints, errors, strict=True)), errors

    def stop(self) -> None:
        """Press Ctrl-C, once: a second one does not wait for anything."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)

    def kill(self) -> None:
        """End it at once where it still runs."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(10)
        self._reader.join(10)
        assert self.process.stdout is not None
        self.process.stdout.close()
