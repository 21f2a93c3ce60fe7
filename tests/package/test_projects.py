# SPDX-License-Identifier: Apache-2.0
"""Projects of `init --platform`: they build with the tools of their world, as far as those are at hand here."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.command_line import Runner
from tests.support.package.arduino import MEGA, SKETCHES, built
from tests.support.package.pio import Pio, running
from tests.support.paths import ROOT, TESTS
from tests.support.patience import seconds
from tests.support.slices import first

pytestmark = [pytest.mark.system, pytest.mark.builds]

PICO_HOST = TESTS / "support" / "package" / "pico_host"
# What pico_sdk_import.cmake brings, for this computer
PICO_SDK = """\
function(pico_sdk_init)
  foreach(name pico_stdlib pico_sync pico_unique_id hardware_watchdog)
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE "$ENV{PICO_SDK_PATH}/sdk")
    target_compile_options(${name} INTERFACE -Wall -Wextra -Werror)
  endforeach()
  target_sources(pico_stdlib INTERFACE "$ENV{PICO_SDK_PATH}/sdk.c")
endfunction()
foreach(name pico_enable_stdio_usb pico_enable_stdio_uart pico_add_extra_outputs)
  cmake_language(EVAL CODE "function(${name})\\nendfunction()")
endforeach()
"""
IDF = """\
set(CMAKE_CURRENT_LIST_DIR "${FOLDER}/main")
function(idf_component_register)
  message(STATUS "${ARGV}")
endfunction()
include("${FOLDER}/main/CMakeLists.txt")
"""


def called(*call: str, **environment: str) -> str:
    """Run a program that must succeed; return its output."""
    done = subprocess.run(
        call,
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=seconds(200),
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.ros
def test_a_project_of_the_pico_sdk_reaches_ros(run: Runner, folder: Path) -> None:
    """With stand-ins of the SDK; two sources, one of them in a folder."""
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    sdk = folder / "sdk"
    shutil.copytree(PICO_HOST, sdk)
    (sdk / "external").mkdir()
    (sdk / "external" / "pico_sdk_import.cmake").write_text(PICO_SDK)
    done = run("init", "my robot", "--platform", "pico")
    assert done.status == 0, done.err
    build, line = str(folder / "build"), folder / "line"
    called("cmake", "-S", "my robot", "-B", build, PICO_SDK_PATH=str(sdk))
    called("cmake", "--build", build, "-j2", PICO_SDK_PATH=str(sdk))
    domain = own_domain()
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty", "--link", str(line))),
        observing(domain) as observer,
        running(folder / "build" / "my_robot", PICO_LINE=str(line)),
    ):
        observer.subscribe("/pico_publisher", "std_msgs/msg/Int32")
        assert len(observer.got(2, timeout_s=30, topic="/pico_publisher")) >= 2


def test_a_project_of_the_pico_sdk_links_what_its_sources_include(run: Runner, folder: Path) -> None:
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    (folder / "sdk" / "external").mkdir(parents=True)
    shown = """\
function(pico_sdk_init)
  foreach(name pico_stdlib pico_sync pico_unique_id hardware_watchdog hardware_adc hardware_structs hardware_pwm)
    add_library(${name} INTERFACE)
  endforeach()
endfunction()
function(pico_enable_stdio_usb)
endfunction()
function(pico_enable_stdio_uart)
endfunction()
function(pico_add_extra_outputs name)
  get_target_property(libraries ${name} LINK_LIBRARIES)
  message(STATUS "${libraries}")
endfunction()
"""
    (folder / "sdk" / "external" / "pico_sdk_import.cmake").write_text(shown)
    assert run("init", "first", "--platform", "pico").status == 0
    source = folder / "first" / "src" / "main.c"
    more = '#include "hardware/adc.h"\n#include <hardware/structs/sio.h>\n#include "pico/cyw43_arch.h"\n'
    source.write_text(more + source.read_text())
    done = run("init", "robot", "--platform", "pico", "--from", str(folder / "first" / "src"))
    assert done.status == 0, done.err
    call = ("cmake", "-S", "robot", "-B", "build")
    assert "-- microros;hardware_adc;hardware_structs;pico_stdlib\n" in called(
        *call, PICO_SDK_PATH=str(folder / "sdk")
    )


@pytest.mark.parametrize("has_sources", first([True, False]))
def test_a_project_of_platformio_builds(run: Runner, folder: Path, tmp_path: Path, has_sources: bool) -> None:
    """By `pio run`, for this computer; with a sketch that has its message, and a header elsewhere; or without."""
    example = ROOT / "examples" / "platformio"
    sources = tmp_path / "old"
    shutil.copytree(example / "src", sources / "src")
    (sources / "include").mkdir()
    (sources / "include" / "gains.h").write_text("#define GAIN 3\n")
    (sources / "src" / "gain.cpp").write_text("#include <gains.h>\nint gain() { return GAIN; }\n")
    paths = ("--interface-path", str(example / "extra_packages"))
    options = ("--from", str(sources), *paths) if has_sources else ()
    pio = Pio(tmp_path / "pio")
    pio.project.rmdir()
    done = run("init", str(pio.project), "--platform", "platformio", *options)
    assert done.status == 0, done.err
    if has_sources:
        shutil.copytree(example / "extra_packages", pio.project / "extra_packages")
    written = (pio.project / "platformio.ini").read_text()  # it names a board
    start = written.index("board_microros_transport = serial")
    pio.settings(*written[start:].splitlines(), arduino=True)
    assert "Compiling" in "".join(pio.build())
    assert pio.program.is_file()


@pytest.mark.parametrize("sources", first(["echo", ""]))
def test_a_sketchbook_builds_for_a_mega(run: Runner, folder: Path, sources: str) -> None:
    options = ("--from", str(SKETCHES / sources)) if sources else ()
    done = run("init", "my_sketch", "--platform", "arduino", *options)
    assert done.status == 0, done.err
    sketch = built(folder / "my_sketch", MEGA, folder / "my_sketch" / "my_sketch" / "my_sketch.ino")
    assert 0 < sketch.ram < 4300


def test_a_project_of_esp_idf_registers_its_program(run: Runner, folder: Path) -> None:
    """ESP-IDF is not at hand: a check of syntax."""
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    assert run("init", "chip", "--platform", "esp-idf").status == 0
    (folder / "commands.cmake").write_text(IDF)
    printed = called("cmake", f"-DFOLDER={folder / 'chip'}", "-P", "commands.cmake")
    assert printed == "-- SRCS;main.c;INCLUDE_DIRS;.\n"
    defined = (folder / "chip" / "main" / "Kconfig.projbuild").read_text()
    assert "config MICRO_ROS_APP_STACK" in defined
    assert (folder / "chip" / "components" / "micro_ros_espidf_component" / "Kconfig.projbuild").is_file()
