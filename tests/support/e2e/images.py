# SPDX-License-Identifier: Apache-2.0
"""Generates projects with the tool and compiles them, each once for all tests.

The sources of a project are compiled as few translation units, in a fifth of the time. That `build`, CMake and a user's
own makefile compile them one by one is what tests/toolchain, tests/workspace and tests/docs hold.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.paths import TESTS
from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, quick

C_FILES = TESTS / "e2e" / "c"
SANITIZE = ("-O0", "-g0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
QUICK = ("-O0",)
BUILD_S = 300.0
"""Time-out of a build, which takes some seconds where nobody else needs the machine."""

PATIENT = "session: {connect_timeout: 20 s, create_timeout: 20 s}\n"
"""For declared applications without their own times: an agent on a busy test machine may stand still for seconds."""

# What an application without `nodes:` declares for live.c.
POOLS = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32, std_msgs/msg/String]
pools: {nodes: 2, publishers: 3, name_size: 32}
limits: {"*": {string: 16}}
"""

# Both streams, a namespace, a private name, three kinds of QoS.
DECLARED = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu_node
    namespace: /arm
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}
      - {topic: count, type: std_msgs/msg/Int32}
      - {topic: ~/state, type: std_msgs/msg/String, qos: {durability: transient_local, depth: 1}}
limits:
  sensor_msgs/msg/Imu: {header: {frame_id: 16}}
  std_msgs/msg/String: {data: 16}
"""


def _compiler(flags: Collection[str]) -> str:
    """Return the compiler that takes least time with these flags."""
    if "-m32" in flags:
        return "gcc"
    return SANITIZER if set(SANITIZE) <= set(flags) or shutil.which("tcc") is None else "tcc"


@dataclass(frozen=True)
class Image:
    """An output folder with its library and the example of its profile, and how it was compiled."""

    out: Path
    compiler: str
    flags: tuple[str, ...]

    @property
    def program(self) -> Path:
        """The example of the profile."""
        return self.out / "bin" / "pure_sender"

    def application(
        self, source: Path, program: Path, *flags: str, compiler: str = "", against: Image | None = None
    ) -> Path:
        """Compile a C or C++ file with this image's headers and link it with its library to `program`.

        AssertionError with the compiler's words. `against`: link the library of another image.
        """
        library = (against or self).out / "lib" / "libmicroros.a"
        used = compiler or self.compiler
        # tcc warns of what is right; with sanitizers the same file is compiled by a compiler that does not.
        chosen = [flag for flag in flags if used != "tcc" or not flag.startswith("-W")]
        command = [used, *self.flags, *chosen, f"-I{self.out / 'include'}", str(source)]
        done = run([*command, str(library), "-o", str(program)])
        assert done.returncode == 0, done.stdout + done.stderr
        return program


class Images:
    """Image factory below one folder, which several test processes may share: what one built, none builds again."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(exist_ok=True)

    def build(self, port: int, application: str = "", by: str = "", flags: tuple[str, ...] = ()) -> Image:
        """Build for an agent at `port` (0: as the application says), `by` a compiler or the one that takes least time.

        `application` empty: the profile pure_sender alone; `flags` empty: `quick`.
        """
        if not flags:
            chosen, flags = quick()
            by = by or chosen
        by = by or _compiler(flags)
        name = hashlib.sha256(repr((port, application, by, flags)).encode()).hexdigest()[:16]
        image = Image(self._folder / name / "out", by, flags)
        with self._once(name) as first:
            if first:
                self._build(image, port, application)
        return image

    def live(self, image: Image) -> Path:
        """Return the program of live.c for an image."""
        program = image.out.parent / "live"
        folders = {"ping": "PING", "agents": "AGENTS", "time_sync": "TIME"}
        parts = [f"-DLIVE_{name}" for place, name in folders.items() if (image.out / "src" / place).is_dir()]
        if not (image.out / "src" / "transport_udp").is_dir():
            parts.append("-DLIVE_NO_UDP")
        with self._once(f"{image.out.parent.name}-live") as first:
            if first:
                source = C_FILES / "live.c"
                image.application(source, program, "-std=c99", "-Wall", "-Wextra", "-Werror", *parts)
        return program

    @contextmanager
    def _once(self, name: str) -> Iterator[bool]:
        """Give true to the first of all processes, and let the others wait until it has succeeded."""
        done = self._folder / f"{name}.done"
        with (self._folder / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield not done.exists()
            done.touch()

    def _build(self, image: Image, port: int, application: str) -> None:
        home = image.out.parent
        shutil.rmtree(home, ignore_errors=True)
        home.mkdir()
        config = home / "microros.yaml"
        if application:
            patient = PATIENT if "\nnodes:" in application and "session:" not in application else ""
            config.write_text(application + patient)
        options = compiler.Options(
            config=config if application else None,
            profiles=() if application else ("pure_sender",),
            interface_paths=(shipped_folder(),),
            agent=f"127.0.0.1:{port}" if port else None,
        )
        compiler.generate(options, image.out)
        _compile(image)


def _compile(image: Image) -> None:
    """Make the library and the example of a generated project."""
    names = (image.out / "sources.txt").read_text(encoding="utf-8").split()
    sources = tuple(image.out / name for name in names)
    tree = Tree(image.out, sources)
    objects = compile_merged(tree, sources, (), image.compiler, ("-std=c99", *image.flags))
    library = image.out / "lib" / "libmicroros.a"
    library.parent.mkdir()
    done = run(["ar", "rcsD", str(library), *map(str, objects)])
    assert done.returncode == 0, done.stderr
    for example in image.out.glob("examples/*/main.c"):
        program = image.out / "bin" / example.parent.name
        program.parent.mkdir()
        image.application(example, program, "-std=c99")


def run(
    command: Sequence[str],
    cwd: Path | None = None,
    env: dict[str, str] | None = None,
    timeout_s: float = 60.0,
) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, at most a minute unless told otherwise."""
    return subprocess.run(
        list(command),
        cwd=cwd,
        env=env,
        text=True,
        capture_output=True,
        timeout=seconds(timeout_s),
        check=False,
    )


def tool(*arguments: str | Path) -> str:
    """Return what the tool prints, with compilers that do not optimize; AssertionError if it fails."""
    command = [sys.executable, "-m", "microros_gen", *map(str, arguments)]
    done = run(command, env={**os.environ, "CFLAGS": "-O0"}, timeout_s=BUILD_S)
    assert done.returncode == 0, done.stderr
    return done.stdout


@contextmanager
def started(program: Path, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Start a program; kill it afterwards where it still runs."""
    process = subprocess.Popen(
        [program, *arguments],
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate(timeout=seconds(10))


def ends_well(process: subprocess.Popen[str], timeout_s: float = 15.0) -> None:
    """Wait for the end of a program that has nothing to report: neither itself nor its sanitizers."""
    out, errors = process.communicate(timeout=seconds(timeout_s))
    assert (process.returncode, errors) == (0, ""), out + errors


def kill(process: subprocess.Popen[str]) -> None:
    """End a process at once, as a power cut does."""
    process.send_signal(signal.SIGKILL)
    process.wait(timeout=seconds(10))
