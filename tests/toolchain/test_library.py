# SPDX-License-Identifier: Apache-2.0
"""Libraries are written as GNU's archiver writes them, byte for byte."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.platform.find import read_target
from microros_gen.toolchain.compile import LIBRARY, compile_tree
from microros_gen.toolchain.library import write_library
from microros_gen.toolchain.toolchain import Toolchain, find_toolchain

pytestmark = pytest.mark.builds

SOURCES = {
    "short.c": "int value = 3;\nstatic int own(void) { return 1; }\nint short_one(void) { return own(); }\n",
    "a_name_of_fifteen.c": "__attribute__((weak)) void weak_one(void) {}\nint tentative;\n",
    "a_longer_name_than_fits.c": "extern int value;\nint longer(void) { return value; }\n",
    "nothing_for_others.c": "static const char text[] = {'o', 'd', 'd'};\nconst char *first(void) { return text; }\n",
    "empty.c": "typedef int no_symbol;\n",
}
COMPILERS = {
    "x86-64": ("gcc", "ar", ()),
    "debug": ("gcc", "ar", ("-g", "-fcommon")),
    "Cortex-M4": ("arm-none-eabi-gcc", "arm-none-eabi-ar", ("-mcpu=cortex-m4", "-mthumb")),
    "big-endian Arm": ("arm-none-eabi-gcc", "arm-none-eabi-ar", ("-mbig-endian", "-g")),
    "AVR": ("avr-gcc", "avr-ar", ("-mmcu=atmega328p",)),
    "RISC-V": ("riscv64-unknown-elf-gcc", "riscv64-unknown-elf-ar", ("-march=rv32imc", "-mabi=ilp32")),
}


def compiled(folder: Path, compiler: str, flags: Sequence[str]) -> list[Path]:
    """Compile SOURCES in `folder`; skip the test where the compiler is not installed."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    for name, text in SOURCES.items():
        (folder / name).write_text(text, encoding="utf-8")
    subprocess.run([compiler, "-Os", "-ffunction-sections", *flags, "-c", *SOURCES], cwd=folder, check=True)
    return [folder / Path(name).with_suffix(".o").name for name in SOURCES]


@pytest.mark.parametrize("case", COMPILERS)
def test_the_library_is_that_of_the_archiver(tmp_path: Path, case: str) -> None:
    compiler, archiver, flags = COMPILERS[case]
    objects = compiled(tmp_path, compiler, flags)
    for count in (1, 2, len(objects)):
        here, other = tmp_path / f"here{count}.a", tmp_path / f"other{count}.a"
        assert write_library(here, objects[:count])
        subprocess.run([archiver, "rcsD", str(other), *map(str, objects[:count])], check=True)
        assert here.read_bytes() == other.read_bytes()


def test_objects_for_the_plugin_are_left_to_the_archiver(tmp_path: Path) -> None:
    for flags in (["-flto"], ["-flto", "-ffat-lto-objects"]):
        objects = compiled(tmp_path, "gcc", flags)
        assert not write_library(tmp_path / "library.a", objects)
    assert not (tmp_path / "library.a").exists()


@pytest.mark.parametrize("compiler", ["clang", "gcc"])
def test_what_is_no_object_is_left_to_the_archiver(tmp_path: Path, compiler: str) -> None:
    """Neither the compiler's own format nor a linked file, and no object that was cut off or changed."""
    objects = compiled(tmp_path, compiler, ["-flto"] if compiler == "clang" else [])
    if compiler == "clang":
        assert not write_library(tmp_path / "library.a", objects)
        return
    content = objects[0].read_bytes()
    linked = tmp_path / "linked.o"
    subprocess.run(["gcc", "-shared", str(objects[0]), "-o", str(linked)], check=True)
    assert not write_library(tmp_path / "library.a", [objects[1], linked])
    for size in (0, 3, 20, 63, len(content) // 2, len(content) - 1):
        objects[0].write_bytes(content[:size])
        assert not write_library(tmp_path / "library.a", objects)
    for place in (4, 5):
        objects[0].write_bytes(content[:place] + b"\x09" + content[place + 1 :])
        assert not write_library(tmp_path / "library.a", objects)
    assert not (tmp_path / "library.a").exists()


FILES = {
    "src/x/a_short.c": "int a_short(void) { return 1; }\n",
    "src/x/long.c": f"/* {'long ' * 40} */\nint long_one(void) {{ return 2; }}\n",
    "main.c": "int main(void) { return 0; }\n",
}


@pytest.mark.parametrize("chosen", [False, True])
def test_an_archiver_that_the_user_chose_makes_the_library(tmp_path: Path, chosen: bool) -> None:
    archiver, calls = tmp_path / "my-ar", tmp_path / "calls"
    archiver.write_text(f'#!/bin/sh\necho "$1" >> "{calls}"\nexec ar "$@"\n', encoding="utf-8")
    archiver.chmod(0o755)
    environ = {"PATH": os.environ["PATH"], "CC": "gcc", **({"AR": str(archiver)} if chosen else {})}
    tools = host_tools(environ)
    out = written(tmp_path / "out", FILES)
    compile_tree(out, ["src/x/a_short.c", "src/x/long.c"], "main.c", None, tools)
    assert calls.exists() == chosen
    defined = subprocess.run(
        ["nm", "-s", str(out / LIBRARY)], capture_output=True, text=True, check=True
    ).stdout
    assert "a_short in x__a_short.o" in defined
    assert "long_one in x__long.o" in defined


def test_all_faulty_sources_are_named_in_the_order_of_their_names(tmp_path: Path) -> None:
    """The long one is compiled first."""
    faulty = {name: f"{text}int other(void) {{ return undeclared; }}\n" for name, text in FILES.items()}
    out = written(tmp_path / "out", faulty)
    tools = host_tools({"PATH": os.environ["PATH"], "CC": "gcc"})
    with pytest.raises(UserError) as refused:
        compile_tree(out, ["src/x/a_short.c", "src/x/long.c"], "main.c", None, tools)
    assert [d.message.split()[0] for d in refused.value.diagnostics] == [
        "main.c",
        "src/x/a_short.c",
        "src/x/long.c",
    ]


def host_tools(environ: Mapping[str, str]) -> Toolchain:
    """Return the tool chain of the host as a user with these variables has it."""
    found = read_target("host", Path(), None, Diagnostics())
    assert found is not None
    return find_toolchain(found.target, environ)


def written(out: Path, files: Mapping[str, str]) -> Path:
    """Write `files` to the folder `out` and return it."""
    for name, text in files.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(text, encoding="utf-8")
    (out / "include").mkdir(exist_ok=True)
    return out
