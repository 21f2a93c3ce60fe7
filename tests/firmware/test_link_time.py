# SPDX-License-Identifier: Apache-2.0
"""Images with link-time optimization: that of the application has bounds, that of the library is refused."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from microros_gen.image.link_time import is_made_by_linker
from tests.support.firmware.board import C_FILES, Built, check
from tests.support.firmware.tasks import built_tasks, holds_of, locks_of
from tests.support.slices import first

SOURCE = C_FILES / "measured_tasks.c"
LTO = "-flto"


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    return built_tasks(tmp_path_factory.mktemp("link_time"))


def linked(built: Built, image: Path, *flags: str) -> Path:
    """Compile the library for link-time optimization, the program with `flags`, and link them with a map."""
    out, work = built.out, image.parent
    common = [*built.target.c_flags, "-Os", "-ffunction-sections", "-fdata-sections"]
    compiler = [built.target.compilers[0], *common, f"-I{out / 'include'}"]
    sources = [str(out / name) for name in (out / "sources.txt").read_text(encoding="utf-8").split()]
    check([*compiler, *flags, "-c", str(SOURCE), "-o", str(work / "program.o")])
    script = ["-T", str(out / "src" / "port_bare" / "image.ld"), f"-Wl,-Map={image.with_suffix('.map')}"]
    parts = [str(work / "program.o"), *sources]
    check([*compiler, LTO, *built.target.link_flags, *script, *parts, "-o", str(image)])
    return image


@pytest.mark.system
def test_an_application_with_it_has_bounds_that_are_no_smaller(built: Built, tmp_path: Path) -> None:
    """Less is known of its calls through pointers."""
    plain = built.link(SOURCE, tmp_path / "plain.elf", "-Os")
    other = built.link(SOURCE, tmp_path / "other.elf", "-Os", LTO)
    assert "ltrans" in other.with_suffix(".map").read_text()
    holds, others = holds_of(built, plain), holds_of(built, other)
    assert holds.keys() == others.keys()
    for task, hold in holds.items():
        assert hold["instructions"] <= others[task]["instructions"], task


@pytest.mark.system
@pytest.mark.parametrize("flags", first([(), (LTO,)]), ids=["library", "all"])
def test_a_library_with_it_is_refused(built: Built, tmp_path: Path, flags: tuple[str, ...]) -> None:
    image = linked(built, tmp_path / "image.elf", *flags)
    stacks = [sys.executable, "-m", "microros_gen", "stacks", "out", "--image", str(image)]
    for done in (
        locks_of(built, image, "--port", "0"),
        subprocess.run(stacks, cwd=built.out.parent, text=True, capture_output=True, check=False),
    ):
        assert (done.returncode, done.stdout) == (1, "")
        assert "the library was optimized at link time" in done.stderr
        assert "MG-9860" in done.stderr


@pytest.mark.parametrize(
    ("name", "is_one"),
    [
        ("/tmp/ccmVQMaQ.ltrans0.ltrans.o", True),
        ("/tmp/ccmVQMaQ.ltrans.o", True),
        ("firmware.elf.lto.o", True),
        ("firmware.elf.lto.1.o", True),
        ("ld-temp.o", True),
        ("main.o", False),
        ("pilto.o", False),
        ("libmicroros.a(xrce_session.o)", False),
    ],
)
def test_objects_of_link_time_optimization_are_known_by_name(name: str, is_one: bool) -> None:
    assert is_made_by_linker(name) == is_one
