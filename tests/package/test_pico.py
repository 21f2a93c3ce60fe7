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
PROJECT = """\
cmake_minimum_required(VERSION 3.13)
project(publisher C)
foreach(name pico_stdlib pico_sync pico_unique_id)
  add_library(${name} INTERFACE)
endforeach()
add_subdirectory(library microros)
add_executable(publisher library/examples/publisher/main.c sdk.c)
target_include_directories(publisher PRIVATE sdk)
target_compile_options(publisher PRIVATE -Wall -Wextra -Werror)
target_link_libraries(publisher microros)
"""


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


def test_what_the_package_defines_is_not_asked_for(run: Runner, folder: Path) -> None:
    (folder / "more.yaml").write_text(
        "version: 1\nprofiles: [pure_sender]\ncomponents: [+multithread, +diagnosis]\nnodes: [{name: n}]\n"
    )
    for options in ((), ("-c", "more.yaml")):
        done = run("package", "pico", *options, "-o", "out")
        assert (done.status, "you define" in done.out) == (0, False), done.err
