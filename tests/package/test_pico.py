# SPDX-License-Identifier: Apache-2.0
"""The package `pico`: its functions over stand-ins of the Pico SDK reach ROS 2 on this computer.

That it links with the SDK was seen by hand (docs/howto/pico.md).
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.command_line import Runner
from tests.support.package.pio import running
from tests.support.paths import TESTS
from tests.support.patience import seconds

STAND_INS = TESTS / "support" / "package" / "pico_host"
DIAGNOSIS = """\
version: 1
profiles: [pure_sender]
components: [+multithread, +diagnosis]
nodes: [{name: n}]
"""
PROJECT = """\
cmake_minimum_required(VERSION 3.13)
project(publisher C)
foreach(name pico_stdlib pico_sync pico_unique_id hardware_watchdog)
  add_library(${name} INTERFACE)
endforeach()
add_subdirectory(library microros)
add_executable(publisher library/examples/publisher/main.c sdk.c)
target_include_directories(publisher PRIVATE sdk)
target_compile_options(publisher PRIVATE -Wall -Wextra -Werror)
target_link_libraries(publisher microros)
"""


@pytest.mark.variant  # of tests/package/test_projects.py: the same program in a project of `init`
@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.system
def test_the_example_reaches_ros(tmp_path: Path) -> None:
    compiler.write(render_package(plan_package(describe("pico"), None)), tmp_path / "library")
    shutil.copytree(STAND_INS, tmp_path, dirs_exist_ok=True)
    (tmp_path / "CMakeLists.txt").write_text(PROJECT)
    for call in (("cmake", "-S", ".", "-B", "build"), ("cmake", "--build", "build", "-j2")):
        done = subprocess.run(
            call, cwd=tmp_path, capture_output=True, text=True, timeout=seconds(200), check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
    domain, link = own_domain(), tmp_path / "line"
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty", "--link", str(link))),
        observing(domain) as observer,
        running(tmp_path / "build" / "publisher", PICO_LINE=str(link)),
    ):
        observer.subscribe("/pico_publisher", "std_msgs/msg/Int32")
        samples = observer.got(3, timeout_s=30, topic="/pico_publisher")
    numbers = [value["data"] for _, value in samples]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


POWER, PIN, SOFTWARE, WATCHDOG, BROWN_OUT = "11", "22", "33", "44", "55"
RESETS = {
    "rp2040": (("0x100", POWER), ("0x10000", PIN), ("0x100000", "00")),
    "rp2350": (("0x10000", POWER), ("0x20000", BROWN_OUT), ("0x40000", PIN), ("0x80000", "00")),
}


@pytest.mark.builds
@pytest.mark.parametrize("chip", RESETS)
def test_the_cause_of_a_reset(chip: str, tmp_path: Path) -> None:
    """The registers of the data sheets in, the cause out; what the program does to the watchdog changes nothing."""
    (tmp_path / "own.yaml").write_text(DIAGNOSIS)
    out = tmp_path / "library"
    compiler.write(render_package(plan_package(describe("pico"), tmp_path / "own.yaml")), out)
    headers = (f"-I{out / 'include'}", f"-I{STAND_INS / 'sdk'}", f"-DPICO_RP2040={int(chip == 'rp2040')}")
    source = str(out / "transport" / "pico_reset.c")
    subprocess.run(
        [
            *("gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-D_POSIX_C_SOURCE=200809L", *headers),
            *(source, str(TESTS / "package" / "c" / "pico_reset.c"), "-o", str(tmp_path / "reset")),
        ],
        check=True,
    )

    def cause(**registers: str) -> str:
        done = subprocess.run([tmp_path / "reset"], capture_output=True, text=True, env=registers, check=True)
        return done.stdout

    for value, expected in RESETS[chip]:
        assert cause(CHIP_RESET=value) == expected
        assert cause(CHIP_RESET=value, REASON="1", MAGIC="1") == WATCHDOG
        assert cause(CHIP_RESET=value, REASON="1") == SOFTWARE
    if shutil.which("arm-none-eabi-gcc"):
        processor = "-mcpu=cortex-m0plus" if chip == "rp2040" else "-mcpu=cortex-m33"
        flags = ("-mthumb", "-std=c99", "-fsyntax-only", "-Wall", "-Wextra", "-Wconversion", "-Werror")
        subprocess.run(["arm-none-eabi-gcc", processor, *flags, *headers, source], check=True)


def test_the_reset_is_left_out_without_a_diagnosis(tmp_path: Path) -> None:
    compiler.write(render_package(plan_package(describe("pico"), None)), tmp_path / "library")
    assert not (tmp_path / "library" / "transport" / "pico_reset.c").exists()


def test_what_the_package_defines_is_not_asked_for(run: Runner, folder: Path) -> None:
    (folder / "more.yaml").write_text(DIAGNOSIS)
    for options in ((), ("-c", "more.yaml")):
        done = run("package", "pico", *options, "-o", "out")
        assert (done.status, "you define" in done.out) == (0, False), done.err
