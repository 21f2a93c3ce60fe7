# SPDX-License-Identifier: Apache-2.0
"""Self-tests of small applications, with the faults of tests/selftest/c/faults.c between them and the port."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.paths import TESTS
from tests.support.patience import seconds

FAULTS_FILE = TESTS / "selftest" / "c" / "faults.c"
_WRAPPED = tuple(re.findall(r"^WRAP\(\s*[^,]*,\s*(\w+)", FAULTS_FILE.read_text(), re.MULTILINE))
_LIBRARY = re.compile(r"src/(port_\w+|rosidl_runtime|cdr|cdr_decode|\w+_msgs|\w+_interfaces)/")
_LINE = re.compile(r"(PASS|FAIL|SKIP) ([\w/]+)(?:: (.*))?")
_LAST = re.compile(r"(PASS|FAIL) (\d+) of (\d+)")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")


def generated(folder: Path, text: str, target: str = "host") -> Path:
    """Write the output folder of an application with its self-test, and return it."""
    folder.mkdir()
    config = folder / "microros.yaml"
    config.write_text(text)
    options = compiler.Options(
        config=config, interface_paths=(shipped_folder(),), target=target, selftest=True
    )
    return compiler.generate(options, folder / "out").out


def sources(out: Path) -> list[Path]:
    """Return the sources of the self-test."""
    return [out / name for name in (out / "selftest" / "sources.txt").read_text().split()]


def called(out: Path) -> list[Path]:
    """Return the sources of the library that the self-test calls: ports and types."""
    names = (out / "sources.txt").read_text().split()
    return [out / name for name in names if _LIBRARY.match(name)]


def link(command: Sequence[str], out: Path, program: Path, flags: Sequence[str], *more: str) -> Path:
    """Compile the self-test, what it calls and the faults; `command` is the compiler with flags of the target.

    `flags` are of faults.c and of the linker, `more` of the linker alone. What was compiled by an earlier call stays.
    """
    sections = ("-ffunction-sections", "-fdata-sections")
    common = [*command, "-std=gnu99", *sections, f"-I{out / 'include'}"]
    folder = out / f"objects-{Path(command[0]).name}"
    if not folder.is_dir():
        folder.mkdir()
        _run([*common, "-c", *map(str, [*sources(out), *called(out)])], folder)
    wraps = [f"-Wl,--wrap={name}" for name in _WRAPPED]
    objects = map(str, sorted(folder.glob("*.o")))
    _run(
        [*common, *flags, str(FAULTS_FILE), *objects, *wraps, "-Wl,--gc-sections", *more, "-o", str(program)],
        out,
    )
    return program


def _run(command: Sequence[str], folder: Path) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def start(program: Path, fault: str = "", one_processor: bool = False) -> subprocess.Popen[str]:
    """Start a self-test of the host with a fault, on one processor if the system can do that."""
    pinned = ["taskset", "-c", "0"] if one_processor and shutil.which("taskset") else []
    environment = {**os.environ, "FAULT": fault}
    return subprocess.Popen([*pinned, str(program)], env=environment, stdout=subprocess.PIPE, text=True)


def lines_of(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Return status and output of a self-test."""
    out, _ = process.communicate(timeout=seconds(30))
    return process.returncode, out


def results(text: str) -> dict[str, tuple[str, str]]:
    """Return for each check PASS, FAIL or SKIP and what follows; AssertionError for a line of another form."""
    found: dict[str, tuple[str, str]] = {}
    *lines, last = text.splitlines()
    for line in lines:
        match = _LINE.fullmatch(line)
        assert match is not None, line
        assert match[2] not in found, f"two lines of {match[2]}"
        found[match[2]] = (match[1], match[3] or "")
    match = _LAST.fullmatch(last)
    assert match is not None, last
    words = [word for word, _ in found.values()]
    assert int(match[3]) == words.count("PASS") + words.count("FAIL")
    assert (match[1], int(match[2])) == (
        ("FAIL", words.count("FAIL")) if "FAIL" in words else ("PASS", words.count("PASS"))
    )
    return found


def failed(text: str) -> list[str]:
    """Return the checks that failed, with what was seen and expected."""
    return [f"{name}: {rest}" for name, (word, rest) in results(text).items() if word == "FAIL"]
