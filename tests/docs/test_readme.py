# SPDX-License-Identifier: Apache-2.0
"""The README is true: its example is the demo's file, its commands run, and print what it shows."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from microros_gen.cli.main import _COMMANDS
from tests.support.console import blocks, masked
from tests.support.firmware.ceilings import ROW, load, readme_row
from tests.support.paths import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def texts(kind: str) -> list[str]:
    return [block.text for block in blocks(README) if block.language == kind]


def test_the_example_is_the_demos_application() -> None:
    (shown,) = texts("yaml")
    lines = (ROOT / "examples/demo/microros.yaml").read_text(encoding="utf-8").splitlines(keepends=True)
    assert shown == "".join(line for line in lines if not line.startswith("#"))


@pytest.mark.system
@pytest.mark.builds
def test_the_console_example_prints_what_it_shows(tmp_path: Path) -> None:
    (block,) = texts("console")
    command, _, shown = block.partition("\n")
    assert command.startswith("$ microros-gen ")
    arguments = shlex.split(command.removeprefix("$ microros-gen "))
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    own = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "MICROROS_GEN_OBJECTS": ""}
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **own}
    result = subprocess.run(
        [sys.executable, "-m", "microros_gen", *arguments],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    assert masked(result.stdout) == masked(shown)


def test_the_figures_are_those_of_the_footprint() -> None:
    """`make footprint` writes both."""
    (row,) = ROW.finditer(README)
    assert row[0] == readme_row(row, load())


@pytest.mark.system
@pytest.mark.builds
def test_the_firmware_of_the_example_is_built_and_measured(tmp_path: Path) -> None:
    """The lines of the microcontroller; what `run` does with the same image is in tests/firmware/test_run.py."""
    if shutil.which("arm-none-eabi-gcc") is None:
        pytest.skip("no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi")
    lines = re.findall(r"(?m)^    microros-gen (.*build/firmware)$", README)
    assert [line.split()[0] for line in lines] == ["build", "run", "size"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": str(tmp_path / "cache")}
    for line in (lines[0], lines[2]):
        command = [sys.executable, "-m", "microros_gen", *shlex.split(line)]
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
    assert "Worst stack with every interrupt on top" in done.stdout


def test_the_figures_of_the_firmware_are_the_ceilings_of_the_suite() -> None:
    (row,) = re.findall(r"(?m)^\| here \| (.*) \|$", README)
    text, ram, _, ready, publish = (int(figure.replace(",", "")) for figure in row.split(" | "))
    kept = json.loads((ROOT / "tests/firmware/footprint.json").read_text())["qemu-mps2-an386"]["senders"]
    sender = kept["pure_sender binary reliable code"]
    assert [text, ram, ready, publish] == [sender[key] for key in ("text", "ram", "ready", "publish")]


@pytest.mark.parametrize("command", list(_COMMANDS))
def test_every_command_is_in_the_readme(command: str) -> None:
    assert re.search(rf"`{command}\b", README), command


def test_every_document_that_is_linked_exists() -> None:
    for link in re.findall(r"\]\((docs/[^)]+)\)", README):
        assert (ROOT / link).is_file(), link


def test_the_make_targets_exist() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in re.findall(r"(?m)(?:^    |`)make (\w+)", README):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
