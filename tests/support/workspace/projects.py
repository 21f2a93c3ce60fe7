# SPDX-License-Identifier: Apache-2.0
"""A project of a user with CMake: configures, builds, and reports what each build compiled."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.support.environments import clean_environ
from tests.support.paths import ROOT
from tests.support.patience import seconds

EXAMPLE = ROOT / "examples" / "cmake_app"
BOARD = "qemu-mps2-an386"
PAGE = (ROOT / "docs" / "howto" / "cmake.md").read_text(encoding="utf-8")
(COMMANDS,) = re.findall(r"^```sh\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
GENERATORS = {"ninja": "Ninja", "make": "Unix Makefiles"}
IDLE = {"ninja": "ninja: no work to do.", "make": "Built target app"}


def run(*command: str | Path, cwd: Path, env: Mapping[str, str]) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, with its two outputs apart."""
    words = [str(word) for word in command]
    return subprocess.run(
        words, cwd=cwd, env=env, text=True, capture_output=True, timeout=seconds(300), check=False
    )


def copy_of_tool(folder: Path) -> Path:
    """Return a copy of the parts of the repository that CMake uses, which a test may change."""
    for name in ("microros_gen", "profiles", "cmake"):
        shutil.copytree(ROOT / name, folder / name)
    shutil.copy(ROOT / "CMakeLists.txt", folder)
    return folder


def replace(path: Path, old: str, new: str) -> None:
    """Replace one text in a file."""
    text = path.read_text()
    assert text.count(old) >= 1, text
    path.write_text(text.replace(old, new, 1))


@dataclass
class Project:
    """A folder with a CMakeLists.txt and its build folder, both with a space in their names.

    `tool` is the repository (or a copy of it) that find_package finds.
    """

    source: Path
    generator: str = "ninja"
    tool: Path = ROOT
    cache: Path = field(init=False)

    def __post_init__(self) -> None:
        self.cache = self.source.parent / "cache"

    @property
    def build_folder(self) -> Path:
        return self.source / f"build with {self.generator}"

    @property
    def out(self) -> Path:
        return self.build_folder / "robot-microros"

    @property
    def found(self) -> tuple[str, str]:
        """The options that let find_package find `tool`."""
        return (f"-Dmicroros_gen_DIR={self.tool / 'cmake'}", f"-DMICROROS_GEN_PYTHON={sys.executable}")

    @property
    def environment(self) -> dict[str, str]:
        return clean_environ(XDG_CACHE_HOME=str(self.cache))

    def configure(self, *options: str) -> subprocess.CompletedProcess[str]:
        generator = ("-G", GENERATORS[self.generator])
        folders = ("-S", str(self.source), "-B", str(self.build_folder))
        return run(
            "cmake", *folders, *generator, *self.found, *options, cwd=self.source, env=self.environment
        )

    def build(self, *options: str) -> subprocess.CompletedProcess[str]:
        command = ("cmake", "--build", str(self.build_folder), "-j2", *options)
        return run(*command, cwd=self.source, env=self.environment)

    def rebuilt(self) -> frozenset[str]:
        """Build, and return what was built: names below the build folder, objects by their source."""
        before = self._made()
        done = self.build()
        assert done.returncode == 0, done.stdout + done.stderr
        after = self._made()
        return frozenset(name for name, state in after.items() if before.get(name) != state)

    def _made(self) -> dict[str, int]:
        found = {}
        for path in self.build_folder.rglob("*"):
            if path.suffix in (".o", ".obj", ".a") or path.name in ("app", "app.elf"):
                found[self._name(path)] = path.stat().st_mtime_ns
        return found

    def _name(self, path: Path) -> str:
        name = path.relative_to(self.build_folder).as_posix()
        return re.sub(r"^.*CMakeFiles/\w+\.dir/|\.(o|obj)$", "", name)

    def contents(self) -> dict[Path, str]:
        """Return a digest of each generated file that the compiler may read."""
        files = (p for p in self.out.rglob("*") if p.suffix in (".c", ".h"))
        return {p: hashlib.sha256(p.read_bytes()).hexdigest() for p in files}

    def users_of(self, files: frozenset[Path]) -> frozenset[str]:
        """Return the objects that the compiler made from one of `files`, as it told itself."""
        wanted = {os.path.realpath(p) for p in files}
        return frozenset(name for name, read in self.reads() if wanted & read)

    def reads(self) -> list[tuple[str, set[str]]]:
        """Return each object with the files that the compiler read for it."""
        if self.generator == "ninja":
            output = run("ninja", "-t", "deps", cwd=self.build_folder, env=self.environment).stdout
            blocks = [block.splitlines() for block in output.split("\n\n") if block.strip()]
            return [
                (self._name(self.build_folder / block[0].partition(":")[0]), self._real(block[1:]))
                for block in blocks
            ]
        found = []
        for path in self.build_folder.rglob("*.o.d"):
            words = path.read_text().replace("\\\n", " ").replace("\\ ", "\0").split(": ", 1)[1].split()
            found.append(
                (self._name(path.with_suffix("")), self._real([w.replace("\0", " ") for w in words]))
            )
        return found

    def _real(self, names: list[str]) -> set[str]:
        return {os.path.realpath(self.build_folder / name.strip()) for name in names}


@dataclass
class Followed(Project):
    """The example as docs/howto/cmake.md builds it, in the folder that the page names."""

    folder: str = ""

    @property
    def build_folder(self) -> Path:
        return self.source / self.folder


def follow_page(folder: Path, build: str) -> Followed:
    """Run the commands of docs/howto/cmake.md that are for the build folder `build`; return what they made."""
    (folder / "examples").symlink_to(EXAMPLE.parent)
    followed = Followed(folder, folder=build)
    lines = [line.split() for line in COMMANDS.splitlines() if build in line.split()]
    assert len(lines) == 2
    for words in lines:
        found = followed.found if "-S" in words else ()
        done = run(*words, *found, cwd=folder, env=followed.environment)
        assert done.returncode == 0, done.stdout + done.stderr
    return followed
