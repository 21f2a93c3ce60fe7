# SPDX-License-Identifier: Apache-2.0
"""The package `stm32cube`: its sources compile for STM32 processors, and its functions over stand-ins reach ROS 2.

The compilation against tests/support/package/stm32_hal is a check of syntax: those headers have the declarations that
the package calls. What was seen with the public HAL is in docs/verification/ports.md.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import textwrap
from collections.abc import Sequence
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.command_line import Runner
from tests.support.free_ports import free_port
from tests.support.package.pio import running
from tests.support.paths import TESTS
from tests.support.patience import seconds
from tests.support.slices import first

STAND_INS = TESTS / "support" / "package"
C_FILES = TESTS / "package" / "c"
KERNELS = TESTS / "platform" / "kernels"
LIBRARY = "micro_ros_stm32cubemx_utils"
HEADERS = "microros_static_library/libmicroros/microros_include"
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")
PROCESSORS = {
    "cortex-m0plus": (),
    "cortex-m4": ("-DMICROROS_TIME_US=timer_count",),
    "cortex-m7": ("-DSTM32_HAS_CACHE",),
    "cortex-m33": ("-DMICROROS_USB_HS", "-DMICROROS_UART_CALLBACK=0"),
}
EXAMPLE = f"{LIBRARY}/examples/publisher/publisher.c"
MAIN = """\
#include "main.h"
void hal_begin(void);
void StartDefaultTask(void * argument);
int main(void)
{
  hal_begin();
  StartDefaultTask(NULL);
  return 0;
}
"""
TASKS = """\
version: 1
profiles: [pure_sender]
components: [+multithread, +diagnosis]
nodes: [{name: n, publishers: [{topic: t, type: std_msgs/msg/Int32}]}]
"""


def written(folder: Path, config: Path | None = None) -> Path:
    """Write the package below `folder`; return its folder."""
    out = folder / LIBRARY
    compiler.write(render_package(plan_package(describe("stm32cube"), config)), out)
    return out


def complaints(out: Path, processor: str, *flags: str, kernel: bool = False) -> str:
    """Return what the compiler says of the package's own sources."""
    if shutil.which("arm-none-eabi-gcc") is None:
        pytest.skip("no arm-none-eabi-gcc")
    folders = [out / HEADERS, STAND_INS / "stm32_hal", STAND_INS / "stm32_hal" / "usb", KERNELS / "lwip"]
    folders += [out / "extra_sources" / "microros_transports", *([KERNELS / "freertos"] if kernel else [])]
    files = [path for path in sorted(out.rglob("*.c")) if "src" not in path.parts]
    if not kernel:
        files = [path for path in files if path.name != "microros_lock.c"]
    call = [
        "arm-none-eabi-gcc",
        f"-mcpu={processor}",
        "-mthumb",
        "-std=c99",
        "-fsyntax-only",
        *WARNINGS,
        *flags,
    ]
    call += [*(f"-I{path}" for path in folders), *map(str, files)]
    return subprocess.run(call, capture_output=True, text=True, check=False).stderr


@pytest.mark.builds
@pytest.mark.parametrize("processor", PROCESSORS)
def test_the_sources_call_what_the_hal_declares(processor: str, tmp_path: Path) -> None:
    assert complaints(written(tmp_path), processor, *PROCESSORS[processor]) == ""


@pytest.mark.builds
def test_the_sources_call_what_the_kernel_declares(folder: Path) -> None:
    (folder / "own.yaml").write_text(TASKS)
    out = written(folder, folder / "own.yaml")
    assert complaints(out, "cortex-m4", kernel=True) == ""
    lock = subprocess.run(
        [
            *("gcc", "-fsyntax-only", f"-I{out / HEADERS}", f"-I{STAND_INS / 'stm32_hal'}"),
            str(out / "extra_sources" / "microros_lock.c"),
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "+multithread needs FreeRTOS" in lock.stderr


PIN, SOFTWARE, IWDG, WWDG, POWER, BROWN_OUT, LOW_POWER, OPTION_BYTES = 1, 2, 4, 8, 16, 32, 64, 128
"""Flags of the stand-in."""
RESETS: dict[str, tuple[tuple[int, str], ...]] = {
    "F4": ((POWER | BROWN_OUT | PIN, "110"), (BROWN_OUT | PIN, "550")),
    "H7": ((POWER | BROWN_OUT | PIN, "110"), (BROWN_OUT | PIN, "550")),
    "F1": ((POWER | PIN, "110"),),
    "G0": ((POWER | PIN, "110"), (OPTION_BYTES | PIN, "330")),
    "L4": ((BROWN_OUT | PIN, "110"), (OPTION_BYTES | PIN, "330")),
}
ALWAYS = (
    *((0, "000"), (PIN, "220"), (SOFTWARE | PIN, "330"), (LOW_POWER | PIN, "000")),
    *((IWDG | PIN, "440"), (WWDG | PIN, "440")),
)


@pytest.mark.builds
@pytest.mark.parametrize("family", RESETS)
def test_the_cause_of_a_reset(family: str, tmp_path: Path) -> None:
    """The flags that the HAL of a family has in, the cause out; they are cleared once."""
    (tmp_path / "own.yaml").write_text(TASKS)
    out = written(tmp_path, tmp_path / "own.yaml")
    assert complaints(out, "cortex-m4", f"-DSTM32_{family}", kernel=True) == ""
    files = (str(out / "extra_sources" / "microros_reset.c"), str(C_FILES / "stm32_reset.c"))
    folders = (f"-I{out / HEADERS}", f"-I{STAND_INS / 'stm32_hal'}", f"-I{out / 'extra_sources'}")
    flags = ("-std=c99", *WARNINGS, f"-DSTM32_{family}")
    program = tmp_path / "reset"
    subprocess.run(["gcc", *flags, *folders, *files, "-o", str(program)], check=True)
    for value, expected in (*ALWAYS, *RESETS[family]):
        done = subprocess.run([program, str(value)], capture_output=True, text=True, check=True)
        assert done.stdout == expected, value


def test_the_reset_is_left_out_without_a_diagnosis(tmp_path: Path) -> None:
    assert not (written(tmp_path) / "extra_sources" / "microros_reset.c").exists()


def printed(folder: Path, transport: str, program: str) -> list[str]:
    """Return what a program of c/ prints that calls a transport on this computer."""
    if shutil.which("gcc") is None:
        pytest.skip("no gcc")
    out = written(folder)
    sources = out / "extra_sources" / "microros_transports"
    folders = [out / HEADERS, STAND_INS / "stm32_hal", STAND_INS / "stm32_hal" / "usb", sources]
    binary, files = folder / "program", (sources / f"{transport}.c", C_FILES / f"{program}.c")
    call = [
        "gcc",
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-fsanitize=undefined,address",
        "-o",
        str(binary),
    ]
    subprocess.run([*call, *(f"-I{path}" for path in folders), *map(str, files)], check=True)
    done = subprocess.run([str(binary)], capture_output=True, text=True, check=False, timeout=seconds(30))
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.builds
def test_bytes_that_arrive_while_the_uart_is_locked(tmp_path: Path) -> None:
    """In the middle of a write none is lost; a reception that was refused or stopped begins again in a read."""
    assert printed(tmp_path, "it_transport", "stm32_it") == [
        "abc lost 0 err 0 at 0",
        "d lost 0 err 0 at 0",
        "e lost 0 err 0 at 0",
        "hi lost 0 err 0 at 1003",
    ]


@pytest.mark.builds
def test_a_transfer_over_usb_is_not_overwritten(tmp_path: Path) -> None:
    """Whatever is written after a time-out; only the first write that finds the device busy waits.

    Before the device is configured, STM32CubeMX's function is not called; what arrives with a full buffer waits.
    """
    assert printed(tmp_path, "usb_cdc_transport", "stm32_usb") == [
        "early 0 err 1 after 100",
        "first 5 err 0 after 0",
        "second 0 err 1 after 100",
        "third 0 err 1 after 0",
        "sent first",
        "fourth 6 err 0 after 0",
        "sent fourth",
        "fifth 5 err 0 after 7",
        "sent fifth",
        "sixth 0 err 1 after 100",
        "seventh 7 err 0 after 0",
        "sent seventh",
        "packets 31, then 0",
        "read 1984, armed 1",
        "packets 31, then 1",
        "read 2047, armed 1",
    ]


@pytest.mark.builds
@pytest.mark.parametrize("chosen", ["DMA", "IT", "USB_CDC", "UDP"])
def test_one_transport_is_left_where_all_files_are_compiled(chosen: str, tmp_path: Path) -> None:
    if shutil.which("arm-none-eabi-gcc") is None:
        pytest.skip("no arm-none-eabi-gcc")
    out = written(tmp_path)
    folders = [out / HEADERS, STAND_INS / "stm32_hal", STAND_INS / "stm32_hal" / "usb", KERNELS / "lwip"]
    found = []
    for source in sorted((out / "extra_sources" / "microros_transports").glob("*.c")):
        compiled = tmp_path / f"{source.stem}.o"
        call = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-c", str(source), "-o", str(compiled)]
        call += [*(f"-I{path}" for path in folders), f"-DMICROROS_TRANSPORT=MICROROS_TRANSPORT_{chosen}"]
        subprocess.run(call, check=True)
        names = subprocess.run(
            ["arm-none-eabi-nm", str(compiled)], capture_output=True, text=True, check=True
        )
        found += [source.stem] * names.stdout.count(" T cubemx_transport_open")
    assert found == [f"{chosen.lower()}_transport"]


def succeed(folder: Path, *call: str) -> subprocess.CompletedProcess[str]:
    """Run a command of a build in a folder; it must succeed."""
    done = subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=seconds(200), check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done


def project(folder: Path, config: Path | None = None) -> Path:
    """Write a project as STM32CubeMX makes it, for this computer, with the package."""
    shutil.copytree(STAND_INS / "stm32_project", folder)
    shutil.copytree(STAND_INS / "stm32_hal", folder / "hal")
    shutil.copytree(KERNELS / "lwip", folder / "lwip")
    written(folder, config)
    return folder


@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.system
@pytest.mark.parametrize("transport", first(["dma", "it"]))
def test_the_example_reaches_ros(transport: str, tmp_path: Path) -> None:
    place = project(tmp_path / "project")
    succeed(place, "make", "-j2", f"MICROROS_TRANSPORT={transport}")
    domain, link = own_domain(), tmp_path / "line"
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty", "--link", str(link))),
        observing(domain) as observer,
        running(place / "build" / "project.elf", STM32_LINE=str(link), STM32_ERROR_EVERY="400"),
    ):
        observer.subscribe("/cubemx_publisher", "std_msgs/msg/Int32")
        samples = observer.got(4, timeout_s=40, topic="/cubemx_publisher")
    numbers = [value["data"] for _, value in samples]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def counted(observer: Observer, transport: Sequence[str], domain: int) -> list[int]:
    """Run an agent until three samples of the example have arrived; return their numbers."""
    with running_agent(domain, "--domain", str(domain), transport=transport):
        return [value["data"] for _, value in observer.got(3, timeout_s=40, topic="/cubemx_publisher")]


@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.system
@pytest.mark.parametrize("transport", first(["usb_cdc", "udp"]))
def test_the_example_reaches_ros_over_usb_and_udp(transport: str, tmp_path: Path) -> None:
    """Before the agent is there, with it, and with the next one.

    Over USB the line is gone in between, as if the cable was pulled, and the device is configured again.
    """
    place, domain, link, port = project(tmp_path / "project"), own_domain(), tmp_path / "line", free_port()
    succeed(place, "make", "-j2", f"MICROROS_TRANSPORT={transport}", f"OWN_FLAGS=-DUDP_PORT={port}")
    agent = ("pty", "--link", str(link)) if transport == "usb_cdc" else ("udp4", "--port", str(port))
    own = {"STM32_LINE": str(link)} if transport == "usb_cdc" else {"STM32_AGENT": "127.0.0.1"}
    with observing(domain) as observer, running(place / "build" / "project.elf", **own):
        observer.subscribe("/cubemx_publisher", "std_msgs/msg/Int32")
        numbers = counted(observer, agent, domain) + counted(observer, agent, domain)
    assert numbers == sorted(set(numbers))


@pytest.mark.builds
@pytest.mark.system
@pytest.mark.variant  # of a project of `init`, below
def test_cmake_builds_the_same_project(tmp_path: Path) -> None:
    place = project(tmp_path / "project")
    succeed(place, "cmake", "-S", ".", "-B", "build", "-DMICROROS_TRANSPORT=it")
    succeed(place, "cmake", "--build", "build", "-j2")
    assert os.access(place / "build" / "project", os.X_OK)


@pytest.mark.builds
@pytest.mark.system
def test_cmake_refuses_an_unknown_transport(tmp_path: Path) -> None:
    place = project(tmp_path / "project")
    wrong = subprocess.run(
        ["cmake", "-S", ".", "-B", "other", "-DMICROROS_TRANSPORT=spi"],
        cwd=place,
        capture_output=True,
        text=True,
        check=False,
    )
    assert "MICROROS_TRANSPORT is 'spi'; it must be dma, it, usb_cdc, udp or none" in wrong.stderr


def initialized(run: Runner, folder: Path, *options: str) -> Path:
    """Write a project as STM32CubeMX makes it, with a folder `robot` of `init`; return the project's folder."""
    place = folder / "project"
    shutil.copytree(STAND_INS / "stm32_project", place)
    shutil.copytree(STAND_INS / "stm32_hal", place / "hal")
    done = run("init", str(place / "robot"), "--platform", "stm32cube", *options)
    assert done.status == 0, done.err
    readme = (place / "robot" / "README.md").read_text()
    make, cmake = (
        textwrap.dedent(lines) for lines in re.findall(r"```(?:c?make)\n(.*?)```", readme, re.DOTALL)
    )
    (place / "main.c").write_text(MAIN)
    of_make = (place / "Makefile").read_text().replace(f"include {LIBRARY}/microros.mk\n", make)
    of_make = of_make.replace(f"hal.c \\\n{EXAMPLE}", "hal.c")
    (place / "Makefile").write_text(of_make.replace(f" -I{LIBRARY}/examples/publisher", ""))
    of_cmake = (place / "CMakeLists.txt").read_text().split("add_subdirectory")[0]
    (place / "CMakeLists.txt").write_text(
        of_cmake.replace(EXAMPLE, "").replace(f"{LIBRARY}/examples/publisher", "")
        + cmake
        + "target_link_libraries(${CMAKE_PROJECT_NAME} pthread)\n"
    )
    return place


@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.system
def test_a_project_of_init_reaches_ros(run: Runner, folder: Path) -> None:
    """With the lines that its README.md has for the Makefile; the handle is that of the stand-in."""
    place = initialized(run, folder)
    task = place / "robot" / "src" / "microros_task.c"
    task.write_text(task.read_text().replace("huart3", "huart1"))
    succeed(place, "make", "-j2")
    domain, link = own_domain(), folder / "line"
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty", "--link", str(link))),
        observing(domain) as observer,
        running(place / "build" / "project.elf", STM32_LINE=str(link)),
    ):
        observer.subscribe("/cubemx_publisher", "std_msgs/msg/Int32")
        assert len(observer.got(2, timeout_s=30, topic="/cubemx_publisher")) >= 2


@pytest.mark.builds
@pytest.mark.system
def test_cmake_builds_a_project_of_init_with_own_sources(run: Runner, folder: Path) -> None:
    """Two sources in C, one of them in a folder."""
    example = describe("stm32cube").example
    assert example is not None
    shutil.copytree(example, folder / "old")
    task = folder / "old" / "microros_task.c"
    task.write_text(
        task.read_text().replace("huart3", "huart1").replace("++message.data", "message.data = more()")
    )
    task.write_text(task.read_text().replace('#include "main.h"', '#include "main.h"\n#include "lib/more.h"'))
    (folder / "old" / "lib").mkdir()
    (folder / "old" / "lib" / "more.h").write_text("int more(void);\n")
    (folder / "old" / "lib" / "more.c").write_text('#include "more.h"\nint more(void) { return 7; }\n')
    place = initialized(run, folder, "--from", str(folder / "old"))
    succeed(place, "cmake", "-S", ".", "-B", "other")
    succeed(place, "cmake", "--build", "other", "-j2")
    assert os.access(place / "other" / "project", os.X_OK)


@pytest.mark.builds
def test_the_makefile_names_sources_that_it_does_not_compile(run: Runner, folder: Path) -> None:
    example = describe("stm32cube").example
    assert example is not None
    shutil.copytree(example, folder / "old")
    (folder / "old" / "more.cpp").write_text("int more;\n")
    place = initialized(run, folder, "--from", str(folder / "old"))
    done = succeed(place, "make", "-n")
    assert "compiles no C++; add src/more.cpp to it, or use CMake" in done.stderr
    assert "robot/src/microros_task.c" in done.stdout


def test_what_the_package_defines_is_not_asked_for(run: Runner, folder: Path) -> None:
    (folder / "more.yaml").write_text(TASKS)
    for options in ((), ("-c", "more.yaml")):
        done = run("package", "stm32cube", *options, "-o", "out")
        assert (done.status, "you define" in done.out) == (0, False), done.err
