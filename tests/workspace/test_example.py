# SPDX-License-Identifier: Apache-2.0
"""examples/cmake_app, built as docs/howto/cmake.md says: for a board, and for this machine with an agent."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.e2e.relay import Relay
from tests.support.paths import ROOT
from tests.support.workspace.projects import BOARD, EXAMPLE, PAGE, Project, follow_page, run

TOOLCHAIN = EXAMPLE / f"{BOARD}.cmake"


@pytest.mark.system
@pytest.mark.ros
def test_on_this_machine_its_samples_arrive(project: Project, relay: Relay) -> None:
    domain = own_domain()
    with (
        running_agent(domain, "--domain", str(domain)) as agent,
        observing(domain) as observer,
        subprocess.Popen([project.build_folder / "app"]) as process,
    ):
        relay.connect(agent.port)
        observer.subscribe("/turns", "std_msgs/msg/Int32", reliable=True)
        try:
            samples = observer.got(3)
        finally:
            process.kill()
    first = samples[0][1]["data"]
    assert samples == [("/turns", {"data": first + i}) for i in range(len(samples))]


@pytest.mark.system
def test_for_a_board_it_becomes_its_image(board: Project) -> None:
    """Flags, start-up and memory map are the board's. make is the generator here; it, too, has nothing left to do."""
    environment, folder = board.environment, board.build_folder
    assert not (folder / "build.ninja").exists()
    again = run("cmake", "--build", folder, cwd=folder, env=environment).stdout
    assert "Building" not in again
    assert "Linking" not in again
    for suffix in ("app.elf", "app.hex", "app.bin"):
        assert (folder / suffix).stat().st_size > 0
    output = run("arm-none-eabi-readelf", "-A", "-s", "app.elf", cwd=folder, env=environment).stdout
    assert 'Tag_CPU_name: "7E-M"' in output or 'Tag_CPU_name: "Cortex-M4"' in output
    assert "Tag_ABI_VFP_args: VFP registers" in output
    assert "port_cortex_m_vectors" in output
    assert TOOLCHAIN.read_bytes() == (folder / "robot-microros/toolchain.cmake").read_bytes()


@pytest.mark.long
def test_for_this_machine_as_the_page_says(tmp_path: Path) -> None:
    follow_page(tmp_path, "build/app")
    assert (tmp_path / "build/app/app").is_file()


def test_the_page_has_every_argument() -> None:
    source = (ROOT / "cmake" / "microros_add_library.cmake").read_text(encoding="utf-8")
    lists = re.findall(r"set\((?:single|multiple) (.*)\)", source)
    arguments = re.findall(r"(?m)^\| `([A-Z_]+) <", PAGE)
    assert sorted(arguments) == sorted(" ".join(lists).split())


def test_the_tool_prints_the_tool_chain_file() -> None:
    command = (sys.executable, "-m", "microros_gen", "targets", BOARD, "--format", "cmake")
    printed = subprocess.run(command, capture_output=True, check=True).stdout
    assert printed == TOOLCHAIN.read_bytes(), f"{' '.join(command[1:])} > {TOOLCHAIN}"
