# SPDX-License-Identifier: Apache-2.0
"""Builds images for boards, each once for all test processes, and runs them in QEMU.

What is measured is built as a user builds it, a source at a time. What only has to run is compiled as few translation
units, in a third of the time.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.find import shipped_folder
from microros_gen.platform.find import builtin_targets, read_target
from microros_gen.platform.target import Target
from microros_gen.toolchain.emulator import Emulator, Machine
from microros_gen.toolchain.identity import CALL_GRAPH
from tests.support.paths import TESTS
from tests.support.patience import deadline, seconds
from tests.support.runtime.harness import Tree, compile_merged

C_FILES = TESTS / "firmware" / "c"
BOARDS = tuple(name for name in builtin_targets() if name.startswith("qemu-"))
REPORT = (
    "done",
    "published",
    "refused",
    "resent",
    "malformed",
    "dropped",
    "reconnects",
    "lost",
    "stack",
    "fault",
)
CPUS = tuple(name for name in builtin_targets() if name not in (*BOARDS, "host"))


def target(name: str) -> Target:
    """Return a built-in target."""
    found = read_target(name, Path(), None, Diagnostics())
    assert found is not None
    return found.target


def need(name: str, emulator: bool = False) -> None:
    """Skip a test whose tool chain (or emulator) is not installed, and say what to install."""
    wanted = target(name)
    if shutil.which(wanted.compilers[0]) is None:
        pytest.skip(f"no {wanted.compilers[0]}: apt-get install {wanted.package}")
    machine = wanted.emulator
    if emulator and machine is not None and shutil.which(machine.program) is None:
        pytest.skip(f"no {machine.program}: apt-get install {machine.package}")


@dataclass(frozen=True)
class Built:
    """An output folder that `build` wrote."""

    out: Path
    target: Target

    @property
    def image(self) -> Path:
        """The example, linked."""
        return self.out / "bin" / str(json.loads((self.out / "manifest.json").read_text())["image"])

    def tool(self, name: str) -> str:
        """Return a program of the tool chain: `nm`."""
        return self.target.compilers[0].removesuffix("gcc") + name

    def symbols(self, image: Path | None = None) -> dict[str, int]:
        """Return the address of every symbol of an image."""
        lines = check([self.tool("nm"), str(image or self.image)]).splitlines()
        return {parts[2]: int(parts[0], 16) for parts in map(str.split, lines) if len(parts) == 3}

    def symbol_sizes(self, image: Path | None = None) -> dict[str, int]:
        """Return the bytes of every symbol of an image that has a size."""
        lines = check([self.tool("nm"), "-S", str(image or self.image)]).splitlines()
        return {parts[3]: int(parts[1], 16) for parts in map(str.split, lines) if len(parts) == 4}

    def link(self, source: Path, image: Path, *flags: str) -> Path:
        """Compile an application outside of the tool and link it as OUT/README.md says, with what `size` reads."""
        compiled = image.with_suffix(".o")
        compiler, strict = self.target.compilers[0], ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror")
        common = [compiler, *self.target.c_flags, "-ffunction-sections", "-fdata-sections"]
        include = f"-I{self.out / 'include'}"
        check([*common, *strict, *flags, CALL_GRAPH, include, "-c", str(source), "-o", str(compiled)])
        script = [
            "-T",
            str(self.out / "src" / "port_bare" / "image.ld"),
            f"-Wl,-Map={image.with_suffix('.map')}",
        ]
        library = str(self.out / "lib" / "libmicroros.a")
        check([*common, *self.target.link_flags, *script, str(compiled), library, "-o", str(image)])
        return image


class Builds:
    """Output folders below one folder, which several test processes may share."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(exist_ok=True)

    def build(self, name: str, application: str = "", more_files: tuple[tuple[str, str], ...] = ()) -> Built:
        """Run `microros-gen build --target name`; `application` empty: `--profile pure_sender` alone.

        `more_files`: names and texts of files that the application names.
        """
        return self._made(name, application, "build", more_files)

    def merged(self, name: str, application: str = "") -> Built:
        """Generate, and compile the sources as few translation units: for images that only run."""
        return self._made(name, application, "generate")

    def _made(
        self, name: str, application: str, command: str, more_files: tuple[tuple[str, str], ...] = ()
    ) -> Built:
        need(name)
        key = hashlib.sha256("".join((application, *map(str, more_files))).encode()).hexdigest()[:8]
        home = self._folder / f"{name}-{key}-{command}"
        built = Built(home / "out", target(name))
        with self.once(home.name) as first:
            if first:
                shutil.rmtree(home, ignore_errors=True)
                home.mkdir()
                for file, text in more_files:
                    (home / file).parent.mkdir(parents=True, exist_ok=True)
                    (home / file).write_text(text)
                if command == "generate":
                    generate(home, name, application)
                    compile_merged_image(built)
                else:
                    done = run_tool(command, home, name, application)
                    assert done.returncode == 0, done.stdout + done.stderr
        return built

    def application(self, built: Built, source: str, *flags: str) -> Path:
        """Return an application of c/, linked with the library of `built`."""
        key = hashlib.sha256(repr((source, flags)).encode()).hexdigest()[:8]
        image = built.out.parent / f"{Path(source).stem}-{key}.elf"
        with self.once(f"{built.out.parent.name}-{image.name}") as first:
            if first:
                built.link(C_FILES / source, image, *flags)
        return image

    @contextmanager
    def once(self, name: str) -> Iterator[bool]:
        """Give true to the first of all processes, and let the others wait until it has succeeded."""
        done = self._folder / f"{name}.done"
        with (self._folder / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield not done.exists()
            done.touch()


def shared_builds(factory: pytest.TempPathFactory) -> Builds:
    """Return the output folders that all processes of a run share."""
    base = factory.getbasetemp()
    return Builds((base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "firmware")


def generate(home: Path, name: str, application: str = "") -> None:
    """Do what `microros-gen generate` does, to home/out, without the start of a process."""
    config = home / "microros.yaml"
    if application:
        config.write_text(application)
    options = compiler.Options(
        config=config if application else None,
        profiles=() if application else ("pure_sender",),
        target=name,
        interface_paths=(shipped_folder(),),
    )
    compiler.generate(options, home / "out")


def compile_merged_image(built: Built) -> None:
    """Make the library and the example of a generated project, from few translation units, not to be measured.

    Most of the optimization would take twice the time.
    """
    sources = tuple(
        built.out / name for name in (built.out / "sources.txt").read_text(encoding="utf-8").split()
    )
    flags = (*built.target.c_flags, "-Og")
    objects = compile_merged(Tree(built.out, sources), sources, (), built.target.compilers[0], flags)
    library = built.out / "lib" / "libmicroros.a"
    library.parent.mkdir()
    check([built.tool("ar"), "rcsD", str(library), *map(str, objects)])
    if built.image.name != "None":
        built.image.parent.mkdir()
        [example] = built.out.glob("examples/*/main.c")
        built.link(example, built.image)


def build(home: Path, name: str, application: str = "", *options: str) -> subprocess.CompletedProcess[str]:
    """Run `microros-gen build` in `home`, to home/out."""
    return run_tool("build", home, name, application, *options)


def run_tool(
    command: str, home: Path, name: str, application: str = "", *options: str
) -> subprocess.CompletedProcess[str]:
    """Run `microros-gen build` or `generate` in `home`, to home/out."""
    arguments = ["--target", name, "-o", "out", "--interface-path", str(shipped_folder()), *options]
    if application:
        (home / "microros.yaml").write_text(application)
    else:
        arguments += ["--profile", "pure_sender"]
    environment = {**os.environ, "XDG_CACHE_HOME": str(home.parent / "cache")}
    call = [sys.executable, "-m", "microros_gen", command, *arguments]
    return subprocess.run(call, cwd=home, env=environment, text=True, capture_output=True, check=False)


def check(command: list[str]) -> str:
    """Run a command; return what it printed, and fail with it when its status is not 0."""
    result = subprocess.run(
        command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, timeout=seconds(60)
    )
    assert result.returncode == 0, f"{' '.join(command)}\n{result.stdout}"
    return result.stdout


class Board:
    """An image in its emulator, paused until `go_on`."""

    def __init__(self, built: Built, image: Path, restarts: bool) -> None:
        assert built.target.emulator is not None
        emulator = built.target.emulator
        machine = Machine(emulator.program, emulator.package, emulator.arguments)
        self.process = subprocess.Popen(
            machine.command(image, restarts), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self._symbols = built.symbols(image)
        self._emulator = Emulator(self.process)
        self.device = self._emulator.device()

    def go_on(self) -> None:
        self._emulator.go_on()

    def restart(self) -> None:
        """Reset the board; its emulator must have been started with `restarts`."""
        self._emulator.call("system_reset")

    def pause(self) -> None:
        """Stop the processor and its clock until `go_on`."""
        self._emulator.call("stop")

    def words(self, symbol: str, count: int = 1) -> list[int]:
        """Return words of memory, from `symbol` on."""
        data = self.memory(self._symbols[symbol], 4 * count)
        return [int.from_bytes(data[at : at + 4], "little") for at in range(0, len(data), 4)]

    def memory(self, address: int, size: int) -> bytes:
        """Return bytes of memory as the processor sees it."""
        command = f"xp /{size}xb {address:#x}"
        text = self._emulator.call("human-monitor-command", **{"command-line": command})
        return bytes(int(byte, 16) for byte in re.findall(r"(?<= )0x([0-9a-f]{2})\b", text))

    def wait_for(self, seen: Callable[[], object], timeout_s: float = 20.0) -> None:
        """Wait until `seen` is true."""
        end = deadline(timeout_s)
        while not seen():
            assert time.monotonic() < end, "it did not happen in time"
            assert self.process.poll() is None, "the emulator ended"
            time.sleep(0.02)

    def end(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate(timeout=seconds(10))


@contextmanager
def board(built: Built, image: Path | None = None, restarts: bool = False) -> Iterator[Board]:
    """Start an image in its emulator, by default the example; end it afterwards."""
    assert built.target.emulator is not None
    need(built.target.name, emulator=True)
    running = Board(built, image or built.image, restarts)
    try:
        yield running
    finally:
        running.end()


def report(running: Board) -> dict[str, int]:
    """Return what the application of c/counter.c says of itself."""
    return dict(zip(REPORT, running.words("counter_report", len(REPORT)), strict=True))
