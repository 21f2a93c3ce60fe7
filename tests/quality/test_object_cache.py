# SPDX-License-Identifier: Apache-2.0
"""The cache of objects: what is the same is compiled once, and what differs in anything is compiled."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.objects.cache import make

pytestmark = pytest.mark.builds

HEADER = "#define A 1\n#define B 2\n"
SOURCE = '#include "x.h"\nint f(int a)\n{\n  int unused;\n  return a + A;\n}\n'


class Workshop:
    """A separate cache, and a way to see whether the real compiler made an object: it writes a line to a file.

    It writes another for each run of the preprocessor alone.
    """

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        real = shutil.which("gcc", path="/usr/local/bin:/usr/bin:/bin")
        if real is None:
            pytest.skip("no gcc")
        self._folder = folder
        self._log = folder / "log"
        (folder / "real").mkdir()
        spy = folder / "real" / "gcc"
        self._preprocessed = folder / "preprocessed"
        spy.write_text(
            f'#!/bin/sh\ncase " $* " in *" -E "*) log={self._preprocessed} ;; *) log={self._log} ;; esac\n'
            f'echo "$*" >> $log\nexec {real} "$@"\n'
        )
        spy.chmod(0o755)
        monkeypatch.setenv("PATH", f"{folder / 'real'}:/usr/bin:/bin")
        make(folder / "cache" / "bin")
        monkeypatch.setenv("PATH", f"{folder / 'cache' / 'bin'}:{folder / 'real'}:/usr/bin:/bin")
        monkeypatch.setenv("MICROROS_GEN_OBJECTS", "")
        self.forget()

    def forget(self) -> None:
        self._log.write_text("")
        self._preprocessed.write_text("")

    def has_preprocessed(self) -> bool:
        """Return whether the last call of `compile` ran the preprocessor to find the object."""
        return bool(self._preprocessed.read_text())

    def compile(
        self, folder: str, *flags: str, source: str = SOURCE, header: str = HEADER, include: bool = True
    ) -> tuple[bool, subprocess.CompletedProcess[str], Path]:
        """Return whether the compiler ran, what it or the cache said, and the folder of the object."""
        home = self._folder / folder
        home.mkdir(exist_ok=True)
        (home / "x.c").write_text(source)
        (home / "x.h").write_text(header)
        (home / "x.o").unlink(missing_ok=True)
        self.forget()
        done = subprocess.run(
            ["gcc", *flags, "-c", "x.c", "-o", "x.o"], cwd=home, capture_output=True, text=True, check=False
        )
        return bool(self._log.read_text()), done, home


@pytest.fixture
def workshop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Workshop:
    return Workshop(tmp_path, monkeypatch)


FLAGS = [
    ("-O1", "-Wall"),
    ("-O1", "-Wall", "-g"),
    ("-Os", "-Wall", "-MMD", "-MF", "x.d", "-fcallgraph-info=su"),
]


@pytest.mark.parametrize("flags", FLAGS, ids=lambda flags: " ".join(flags))
def test_the_same_text_is_compiled_once_whatever_the_folder(
    workshop: Workshop, flags: tuple[str, ...]
) -> None:
    first, output, a = workshop.compile("a", *flags)
    again, repeated, b = workshop.compile("b", *flags)
    assert (first, again) == (True, False)
    assert (a / "x.o").read_bytes() == (b / "x.o").read_bytes()
    assert "unused" in output.stderr
    assert repeated.stderr == output.stderr
    for ending in ("d", "ci"):
        dependencies = [(folder / f"x.{ending}") for folder in (a, b)]
        assert dependencies[0].exists() == dependencies[1].exists() == ("-MMD" in flags)
        assert not dependencies[0].exists() or dependencies[0].read_text() == dependencies[1].read_text()


def test_an_unused_macro_does_not_count(workshop: Workshop) -> None:
    workshop.compile("a", "-O1")
    compiled, _, _ = workshop.compile("b", "-O1", header=HEADER.replace("B 2", "B 3"))
    assert not compiled


LISTED = ("-O1", "-g", "-MD", "-MF", "x.d")


def test_a_call_that_lists_its_files_is_found_without_the_preprocessor(workshop: Workshop) -> None:
    compiled, _, a = workshop.compile("a", *LISTED)
    assert (compiled, workshop.has_preprocessed()) == (True, False)
    compiled, _, b = workshop.compile("b", *LISTED)
    assert (compiled, workshop.has_preprocessed()) == (False, False)
    assert (a / "x.o").read_bytes() == (b / "x.o").read_bytes()
    assert (a / "x.d").read_text() == (b / "x.d").read_text()
    other = HEADER.replace("A 1", "A 4")
    for changed in (
        workshop.compile("b", *LISTED, header=other),
        workshop.compile("b", *LISTED, source=SOURCE.replace("a + A", "a - A")),
        workshop.compile("b", *LISTED, "-O2"),
    ):
        assert changed[0]
    compiled, _, _ = workshop.compile("b", *LISTED, header=other.replace("B 2", "B 3"))
    assert (compiled, workshop.has_preprocessed()) == (False, True), "an unused macro"
    compiled, _, c = workshop.compile("c", *LISTED, header=other)
    assert not compiled
    assert (c / "x.o").read_bytes() != (a / "x.o").read_bytes()


def test_what_differs_is_compiled(workshop: Workshop) -> None:
    workshop.compile("a", "-O1")
    for changed in (
        workshop.compile("a", "-O2"),
        workshop.compile("a", "-O1", "-DB=3"),
        workshop.compile("a", "-O1", header=HEADER.replace("A 1", "A 4")),
        workshop.compile("a", "-O1", source=SOURCE.replace("a + A", "a - A")),
        workshop.compile("a", "-O1", source=SOURCE + "/* falls through */\n"),
    ):
        assert changed[0]
        assert changed[1].returncode == 0


def test_an_error_is_reported_each_time_and_never_cached(workshop: Workshop) -> None:
    for _ in range(2):
        compiled, done, home = workshop.compile("a", "-Werror", "-Wall")
        assert compiled
        assert done.returncode == 1
        assert "unused" in done.stderr
        assert not (home / "x.o").exists()


def test_a_call_that_makes_no_object_passes_through(workshop: Workshop, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main(void) { return 7; }\n")
    subprocess.run(["gcc", "main.c", "-o", "main"], cwd=tmp_path, check=True)
    assert subprocess.run([tmp_path / "main"], check=False).returncode == 7
    version = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout
    assert version.startswith("gcc")


def test_a_cached_object_has_the_stack_frames_of_its_functions(workshop: Workshop) -> None:
    flags = ("-O1", "-fstack-usage", "-w")
    compiled, _, home = workshop.compile("one", *flags)
    assert compiled
    first = (home / "x.su").read_text()
    (home / "x.su").unlink()
    compiled, _, home = workshop.compile("one", *flags)
    assert not compiled
    assert (home / "x.su").read_text() == first


def test_what_build_keeps_itself_passes_through(workshop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MICROROS_GEN_OBJECTS", "store")
    for _ in range(2):
        compiled, _, _ = workshop.compile("one", "-Os", "-fcallgraph-info=su")
        assert compiled
    for expected in (True, False):
        assert workshop.compile("one", "-Os")[0] is expected
