# SPDX-License-Identifier: Apache-2.0
"""Ports to kernels and networks: a syntax check against the declarations that they call, in tests/platform/kernels.

What they do is seen by hand with the public sources (docs/howto/port.md).
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.platform.part_file import builtin_parts
from microros_gen.selection.find_components import parts_folder
from tests.support.command_line import Runner
from tests.support.components.rendered import UNITS
from tests.support.paths import TESTS

KERNELS = TESTS / "platform" / "kernels"
TARGET = "target: board\nsummary: A board under a kernel\nextends: {cpu}\nos: {os}\nnetwork: {network}\n"
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers, +multithread{more}]
target: board.yaml
session: {{key: 1}}
transport: {transport}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
    timers: [{{name: beat, period: 100 ms, kind: rtos}}]
    executors: [{{name: all}}]
"""
TASKS = "tasks: [{name: main, executor: all, rate: 10 Hz}]\n"
VARIANTS = (
    {"transport": "{type: udp, agent: 192.168.1.2:8888}", "more": ", +sleep_cycles"},
    {"transport": "{type: udp, agent: 192.168.1.2:8888}", "more": "", "tasks": TASKS},
    {"transport": "{type: udp}", "more": ", +discovery"},
    {"transport": "{type: tcp, agent: 192.168.1.2:8888}", "more": ""},
)
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")
COMPILERS = (
    ("arm-none-eabi-gcc",),
    (
        "clang",
        "-DKERNEL_TICK_RATE_HZ=1024",
        "-DLWIP_IPV6=0",
        "-DKERNEL_CORES=2",
        "-DPORT_FREERTOS_TIME_US=kernel_time_us",
    ),
    ("gcc", "-DKERNEL_TICK_RATE_HZ=100", "-DLWIP_NETIF_TX_SINGLE_PBUF=1"),
)
SETTINGS = (
    "configSUPPORT_STATIC_ALLOCATION",
    "configUSE_MUTEXES",
    "configUSE_RECURSIVE_MUTEXES",
    "configUSE_TIMERS",
    "INCLUDE_eTaskGetState",
    "INCLUDE_vTaskDelete",
    "INCLUDE_vTaskSuspend",
    "INCLUDE_xTaskDelayUntil",
    "INCLUDE_xTaskGetCurrentTaskHandle",
    "INCLUDE_uxTaskGetStackHighWaterMark",
)
PAIRS = [("freertos", "lwip")]


def sources(folder: Path, name: str) -> list[Path]:
    return sorted((folder / "src" / f"port_{name}").glob("*.c"))


def complaints(compiler: str, out: Path, names: tuple[str, str], *flags: str) -> str:
    """Return what the compiler says of the sources of an OS and a network."""
    files = [str(path) for name in names for path in sources(out, name)]
    folders = [f"-I{path}" for path in (out / "include", *(KERNELS / name for name in names))]
    call = [compiler, "-std=c99", "-fsyntax-only", *WARNINGS, *flags, *folders, *files]
    return subprocess.run(call, capture_output=True, text=True, check=False).stderr


@pytest.mark.builds
@pytest.mark.parametrize("names", PAIRS, ids="-".join)
def test_a_port_calls_what_its_kernel_declares(names: tuple[str, str], folder: Path, run: Runner) -> None:
    (folder / "board.yaml").write_text(TARGET.format(cpu="cortex-m4", os=names[0], network=names[1]))
    compiled = set()
    for variant in VARIANTS:
        (folder / "microros.yaml").write_text(APPLICATION.format(**variant) + variant.get("tasks", ""))
        done = run("generate", "-o", "out")
        assert (done.status, "warning" in done.err) == (0, False), done.err
        out = folder / "out"
        compiled |= {path.name for name in names for path in sources(out, name)}
        for compiler, *flags in COMPILERS:
            if shutil.which(compiler):
                assert complaints(compiler, out, names, *flags) == ""
    parts = [parts_folder() / kind / name for kind, name in zip(("os", "network"), names, strict=True)]
    assert compiled == {path.name for part in parts for path in part.glob("src/*.c")}


@pytest.mark.builds
def test_a_missing_setting_of_freertos_stops_the_compiler(folder: Path, run: Runner) -> None:
    (folder / "board.yaml").write_text(TARGET.format(cpu="cortex-m4", os="freertos", network="lwip"))
    (folder / "microros.yaml").write_text(APPLICATION.format(**VARIANTS[0]) + TASKS)
    assert run("generate", "-o", "out").status == 0
    found = {}
    for name in SETTINGS:
        header = KERNELS / "freertos" / "FreeRTOS.h"
        changed = folder / "changed" / "FreeRTOS.h"
        changed.parent.mkdir(exist_ok=True)
        changed.write_text(re.sub(rf"(#define {name}) 1", r"\1 0", header.read_text()))
        messages = complaints(
            "gcc", folder / "out", ("freertos", "lwip"), f"-I{changed.parent}", "-DKERNEL_CORES=2"
        )
        found[name] = messages
    assert {
        name: f'#error "FreeRTOSConfig.h: set {name} to 1"' in messages for name, messages in found.items()
    } == dict.fromkeys(found, True)


@pytest.mark.builds
def test_a_task_of_freertos_is_deleted_when_its_processor_has_left_it(folder: Path, run: Runner) -> None:
    (folder / "board.yaml").write_text(TARGET.format(cpu="cortex-m4", os="freertos", network="lwip"))
    (folder / "microros.yaml").write_text(APPLICATION.format(**VARIANTS[0]) + TASKS)
    assert run("generate", "-o", "out").status == 0
    sources = [folder / "out" / "src" / "port_freertos" / "port_freertos_tasks.c", UNITS / "freertos_join.c"]
    folders = [
        f"-I{path}" for path in (folder / "out" / "include", KERNELS / "freertos", KERNELS / "lwip", UNITS)
    ]
    for cores in (1, 2):
        program = folder / f"join{cores}"
        call: list[str | Path] = [
            "gcc",
            "-std=gnu99",
            f"-DKERNEL_CORES={cores}",
            *folders,
            *sources,
            "-o",
            program,
        ]
        subprocess.run(call, check=True)
        done = subprocess.run([program], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")


def test_every_port_to_a_kernel_is_checked() -> None:
    assert set(builtin_parts("os")) - {"bare", "posix"} == {os for os, _ in PAIRS}
    assert set(builtin_parts("network")) - {"posix_sockets"} == {network for _, network in PAIRS}


@pytest.mark.builds
def test_too_few_priorities_of_freertos_stop_the_compiler(folder: Path, run: Runner) -> None:
    (folder / "board.yaml").write_text(TARGET.format(cpu="cortex-m4", os="freertos", network="lwip"))
    (folder / "microros.yaml").write_text(APPLICATION.format(**VARIANTS[0]) + TASKS)
    assert run("generate", "-o", "out").status == 0
    header = (KERNELS / "freertos" / "FreeRTOS.h").read_text()
    (folder / "changed").mkdir()
    for most, words in ((2, '#error "FreeRTOSConfig.h: set configMAX_PRIORITIES above'), (3, "")):
        changed = header.replace("configMAX_PRIORITIES (5)", f"configMAX_PRIORITIES ({most})")
        (folder / "changed" / "FreeRTOS.h").write_text(changed)
        messages = complaints("gcc", folder / "out", ("freertos", "lwip"), f"-I{folder / 'changed'}")
        assert words in messages
        assert bool(words) == bool(messages)
