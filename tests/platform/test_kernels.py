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
from tests.support.examples import draws_all
from tests.support.paths import TESTS
from tests.support.patience import seconds

KERNELS = TESTS / "platform" / "kernels"
CPU = "cortex-m4"
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers{more}]
target: {{name: {cpu}, rtos: {os}{network}}}
{session}
transport: {transport}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
    timers: [{{name: beat, period: 100 ms, kind: rtos}}]
    executors: [{{name: all}}]
"""
KEY = "session: {key: 1}"
TASKS = "tasks: [{name: main, executor: all, rate: 10 Hz}]\n"
UDP = "{type: udp, agent: 192.168.1.2:8888}"
SERIAL = {"transport": "{type: serial}", "more": ", +multithread", "tasks": TASKS, "session": ""}
VARIANTS: tuple[dict[str, str], ...] = (
    {"transport": UDP, "more": ", +multithread, +sleep_cycles"},
    {"transport": UDP, "more": ", +multithread", "tasks": TASKS},
    {"transport": "{type: udp}", "more": ", +discovery"},
    {"transport": "{type: tcp, agent: 192.168.1.2:8888}", "more": ", +multithread", "tasks": TASKS},
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
    "INCLUDE_vTaskPrioritySet",
    "INCLUDE_vTaskSuspend",
    "INCLUDE_xTaskDelayUntil",
    "INCLUDE_xTaskGetCurrentTaskHandle",
    "INCLUDE_uxTaskGetStackHighWaterMark",
)
ZEPHYR_SETTINGS = (
    "CONFIG_MULTITHREADING",
    "CONFIG_TIMEOUT_64BIT",
    "CONFIG_INIT_STACKS",
    "CONFIG_THREAD_STACK_INFO",
    "CONFIG_UART_INTERRUPT_DRIVEN",
    "CONFIG_RING_BUFFER",
    "CONFIG_HWINFO",
)
NUTTX_SETTINGS = (
    "CONFIG_PRIORITY_INHERITANCE",
    "CONFIG_PTHREAD_MUTEX_TYPES",
    "CONFIG_PIPES",
    "CONFIG_SERIAL_TERMIOS",
    "CONFIG_BOARDCTL_UNIQUEID",
    "CONFIG_TLS_NELEM",
)
PAIRS = [
    ("freertos", "lwip"),
    ("freertos", "freertos_tcp"),
    ("zephyr", "zephyr_sockets"),
    ("nuttx", "posix_sockets"),
    ("esp_idf", "lwip"),
]
BASES, OF_BASES = {"esp_idf": ("freertos",)}, {"esp_idf": ("-DESP_PLATFORM",)}
"""Of an OS: another one whose files it uses, too, and the flags with which its declarations differ."""
OF_PAIRS = {
    "lwip": VARIANTS,
    "freertos_tcp": (VARIANTS[0], *VARIANTS[2:]),
    "zephyr_sockets": (
        VARIANTS[0],
        {**VARIANTS[2], "more": ", +discovery, +diagnosis"},
        VARIANTS[3],
        SERIAL,
    ),
    "posix_sockets": (SERIAL, {**SERIAL, "more": ", +multithread, +diagnosis"}),
    "esp_idf": ({**VARIANTS[0], "more": ", +diagnosis", "session": ""}, VARIANTS[1]),
}
"""The variants that have each source of a part at least once; an operating system is checked with one network."""


def sources(folder: Path, name: str) -> list[Path]:
    """Return the rendered sources of a part that calls a kernel; those of POSIX are compiled elsewhere."""
    return sorted((folder / "src" / f"port_{name}").glob("*.c")) if (KERNELS / name).is_dir() else []


def files_of(kind: str, name: str) -> set[str]:
    """Return the names of all sources of a part, as they are rendered."""
    paths = (parts_folder() / kind / name / "src").glob("*.c*")
    return {path.name.removesuffix(".j2") for path in paths if (KERNELS / name).is_dir()}


def application(names: tuple[str, str], variant: dict[str, str]) -> str:
    """Return an application for an OS and a network."""
    network = f", network: {names[1]}" if "serial" not in variant["transport"] else ""
    more = {"session": KEY, **variant, "cpu": CPU, "os": names[0], "network": network}
    return APPLICATION.format(**more) + variant.get("tasks", "")


def complaints(compiler: str, out: Path, names: tuple[str, ...], *flags: str) -> str:
    """Return what the compiler says of the sources of an OS and a network, and of a self-test."""
    names, more = (*names, *BASES.get(names[0], ())), OF_BASES.get(names[0], ())
    files = [str(path) for name in names for path in sources(out, name)]
    files += [str(path) for path in sorted((out / "selftest").glob("*.c"))]
    folders = [f"-I{path}" for path in (out / "include", *(KERNELS / name for name in names))]
    call = [compiler, "-std=c99", "-fsyntax-only", *WARNINGS, *flags, *more, *folders, *files]
    return subprocess.run(call, capture_output=True, text=True, check=False).stderr


@pytest.mark.builds
@pytest.mark.examples
@pytest.mark.parametrize("names", PAIRS, ids="-".join)
def test_a_port_calls_what_its_kernel_declares(names: tuple[str, str], folder: Path, run: Runner) -> None:
    """Each compiler, with its own settings of the kernel, sees each port; in `make system` in each variant."""
    compiled = set()
    variants = OF_PAIRS.get(names[0], OF_PAIRS[names[1]])
    for number, variant in enumerate(variants):
        (folder / "microros.yaml").write_text(application(names, variant))
        done = run("generate", "-o", "out", "--selftest")
        assert (done.status, "warning" in done.err) == (0, False), done.err
        out = folder / "out"
        compiled |= {path.name for name in names for path in sources(out, name)}
        of_variant = COMPILERS[number % len(COMPILERS) :: len(variants)]
        for compiler, *flags in COMPILERS if draws_all() else of_variant:
            if shutil.which(compiler):
                assert complaints(compiler, out, names, *flags) == ""
    of_network, of_os = files_of("network", names[1]), files_of("os", names[0])
    if names == ("freertos", "freertos_tcp"):
        assert compiled >= of_network
    elif names[0] in OF_PAIRS:
        assert compiled >= of_os
    else:
        assert compiled == of_os | of_network


@pytest.mark.builds
def test_two_cores_of_an_esp32_make_each_semaphore_once(folder: Path, run: Runner) -> None:
    names = ("esp_idf", "lwip")
    (folder / "microros.yaml").write_text(application(names, VARIANTS[0]))
    assert run("generate", "-o", "out").status == 0
    parts = (folder / "out" / "src").rglob("port_freertos_*.c")
    files = [path for path in parts if path.name in ("port_freertos_lock.c", "port_freertos_wait.c")]
    assert len(files) == 2
    folders = [
        f"-I{path}" for path in (folder / "out" / "include", KERNELS / "freertos", KERNELS / "esp_idf")
    ]
    call = ["gcc", "-std=gnu99", "-DESP_PLATFORM", "-pthread", *folders, str(UNITS / "freertos_cores.c")]
    subprocess.run([*call, *map(str, files), "-o", str(folder / "unit")], check=True)
    subprocess.run([folder / "unit"], check=True, timeout=seconds(60))


def settings_that_stop(
    folder: Path, names: tuple[str, str], header: str, settings: tuple[str, ...]
) -> dict[str, str]:
    """Return what the compiler says when each setting of a kernel's header is missing in turn."""
    found = {}
    for name in settings:
        text = (KERNELS / names[0] / header).read_text()
        changed = folder / "changed" / header
        changed.parent.mkdir(exist_ok=True, parents=True)
        changed.write_text(
            re.sub(rf"(#define {name}) 1\n", r"\1 0\n" if header == "FreeRTOS.h" else "", text)
        )
        flags = (f"-I{folder / 'changed'}", "-DKERNEL_CORES=2")
        found[name] = complaints("gcc", folder / "out", names, *flags)
    return found


@pytest.mark.builds
def test_a_missing_setting_of_freertos_stops_the_compiler(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(application(PAIRS[0], VARIANTS[1]))
    assert run("generate", "-o", "out").status == 0
    found = settings_that_stop(folder, PAIRS[0], "FreeRTOS.h", SETTINGS)
    for name, messages in found.items():
        assert f'#error "FreeRTOSConfig.h: set {name} to 1"' in messages


@pytest.mark.builds
@pytest.mark.parametrize(
    ("names", "header", "file", "settings"),
    [
        (PAIRS[2], "zephyr/autoconf.h", "prj.conf", ZEPHYR_SETTINGS),
        (PAIRS[3], "nuttx/config.h", "defconfig", NUTTX_SETTINGS),
    ],
)
def test_a_missing_setting_stops_the_compiler(
    names: tuple[str, str], header: str, file: str, settings: tuple[str, ...], folder: Path, run: Runner
) -> None:
    (folder / "microros.yaml").write_text(application(names, SERIAL))
    assert run("generate", "-o", "out").status == 0
    for name, messages in settings_that_stop(folder, names, header, settings).items():
        assert re.search(rf'#error "{file}: set {name}=[y1]', messages)


@pytest.mark.builds
def test_a_lock_of_nuttx_that_is_not_recursive_stops_the_compiler(folder: Path, run: Runner) -> None:
    """The application makes its tasks itself."""
    (folder / "microros.yaml").write_text(application(PAIRS[3], {**SERIAL, "tasks": ""}))
    assert run("generate", "-o", "out").status == 0
    name = "CONFIG_PTHREAD_MUTEX_TYPES"
    [messages] = settings_that_stop(folder, PAIRS[3], "nuttx/config.h", (name,)).values()
    assert f'#error "defconfig: set {name}=y' in messages


@pytest.mark.builds
def test_a_task_of_freertos_is_deleted_when_its_processor_has_left_it(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(application(PAIRS[0], VARIANTS[1]))
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


@pytest.mark.builds
def test_freertos_with_a_timer_releases_at_each_tick(folder: Path, run: Runner) -> None:
    """Wherever between two ticks the tasks start; seen in QEMU: a grid shortly after the ticks missed releases."""
    (folder / "microros.yaml").write_text(application(PAIRS[0], VARIANTS[1]))
    assert run("generate", "-o", "out").status == 0
    sources = [folder / "out" / "src" / "port_freertos" / "port_freertos_tasks.c", UNITS / "freertos_clock.c"]
    folders = [f"-I{path}" for path in (folder / "out" / "include", KERNELS / "freertos", UNITS)]
    program = folder / "clock"
    timer = "-DPORT_FREERTOS_TIME_US=kernel_time_us"
    subprocess.run(["gcc", "-std=gnu99", timer, *folders, *sources, "-o", program], check=True)
    for phase in (0, 1, 20, 500, 985, 999):
        for shown in (0, 77, 2**32 - 1500):
            done = subprocess.run(
                [program, str(phase), str(shown)], capture_output=True, text=True, check=False
            )
            assert (phase, shown, done.returncode, done.stderr) == (phase, shown, 0, "")


def test_every_port_to_a_kernel_is_checked() -> None:
    assert set(builtin_parts("os")) - {"bare", "posix"} == {os for os, _ in PAIRS}
    assert set(builtin_parts("network")) == {network for _, network in PAIRS}


@pytest.mark.builds
def test_too_few_priorities_of_freertos_stop_the_compiler(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(application(PAIRS[0], VARIANTS[1]))
    assert run("generate", "-o", "out").status == 0
    header = (KERNELS / "freertos" / "FreeRTOS.h").read_text()
    (folder / "changed").mkdir()
    for most, words in ((2, '#error "FreeRTOSConfig.h: set configMAX_PRIORITIES above'), (3, "")):
        changed = header.replace("configMAX_PRIORITIES (5)", f"configMAX_PRIORITIES ({most})")
        (folder / "changed" / "FreeRTOS.h").write_text(changed)
        messages = complaints("gcc", folder / "out", ("freertos", "lwip"), f"-I{folder / 'changed'}")
        assert words in messages
        assert bool(words) == bool(messages)


@pytest.mark.builds
@pytest.mark.parametrize("flags", [(), ("-DKERNEL_CORES=2",)], ids=["own fill", "fill of the kernel"])
def test_the_stack_of_a_task_of_nuttx_is_marked_above_what_the_kernel_keeps(
    flags: tuple[str, ...], tmp_path: Path
) -> None:
    parts = parts_folder() / "os"
    include = parts / "posix" / "include"
    sources = [parts / "nuttx" / "src" / "port_nuttx_task.c", UNITS / "nuttx_mark.c"]
    call: list[str | Path] = [
        "gcc",
        "-std=c99",
        *flags,
        f"-I{KERNELS / 'nuttx'}",
        f"-I{include}",
        f"-I{UNITS}",
    ]
    subprocess.run([*call, *sources, "-o", tmp_path / "mark"], check=True)
    done = subprocess.run([tmp_path / "mark"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
