# SPDX-License-Identifier: Apache-2.0
"""`rtos` and `network` of the application file replace the operating system and the IP stack of its target."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.compiler.options import Options
from microros_gen.compiler.request import request_of
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.platform.chosen_parts import rtos_names
from microros_gen.platform.part_file import builtin_parts
from microros_gen.platform.target import Target
from tests.support.command_line import Runner

HEAD = "profiles: [pure_sender]\n"
TASKS = """\
profiles: [pure_sender]
components: [+executor, +timers]
session: {key: 1}
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    timers: [{name: beat, period: 100 ms}]
    executors: [{name: all}]
tasks: [{name: main, executor: all, rate: 10 Hz}]
"""


def target_of(text: str, near: Path = Path()) -> Target:
    """Return the target of an application file in the folder `near`."""
    source = Source(str(near / "microros.yaml"), HEAD + text)
    return request_of(source, near, Options(), Diagnostics()).target


def parts_of(text: str, near: Path = Path()) -> list[str]:
    return [part.component.name for part in target_of(text, near).parts]


def test_the_parts_of_the_target_are_replaced() -> None:
    assert parts_of("target: cortex-m4") == ["port_bare", "port_cortex_m"]
    assert parts_of("target: {name: cortex-m4, rtos: freertos}") == ["port_freertos", "port_cortex_m"]
    both = "target: {name: cortex-m4, rtos: freertos, network: lwip}"
    assert parts_of(both) == ["port_lwip", "port_freertos", "port_cortex_m"]
    assert not target_of(both).hosted
    assert not target_of("target: {name: qemu-mps2-an386, rtos: freertos}").has_image
    assert parts_of("target: {name: host, network: lwip}")[:2] == ["port_lwip", "port_posix"]


def test_none_takes_the_system_away(folder: Path) -> None:
    (folder / "own.yaml").write_text("target: own\nsummary: own\nextends: qemu-mps2-an386\nos: freertos\n")
    assert not target_of("target: own.yaml", folder).has_image
    bare = target_of("target: {name: own.yaml, rtos: none}", folder)
    assert [part.component.name for part in bare.parts] == ["port_bare", "port_cortex_m"]
    assert bare.has_image
    assert set(rtos_names().values()) <= set(builtin_parts("os"))


def test_a_folder_is_relative_to_the_application_file(folder: Path) -> None:
    (folder / "kernel").mkdir()
    (folder / "kernel" / "component.yaml").write_text(
        'component: port_kernel\nsummary: "A kernel"\nlayer: port\nstatus: ready\nneeds: [support]\n'
    )
    assert parts_of("target: {name: cortex-m4, rtos: ./kernel}", folder) == ["port_kernel", "port_cortex_m"]


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (
            "target: {name: cortex-m4, rtos: frertos}",
            "2:33",
            "unknown os 'frertos'. Did you mean 'freertos'?",
        ),
        ("target: {name: cortex-m4, network: lwib}", "2:36", "unknown network 'lwib'. Did you mean 'lwip'?"),
        ("target: {name: host, rtos: none}", "2:28", "the target host cannot do without an operating system"),
        (
            "target: {name: cortex-m4, rtos: freertos, network: zephyr_sockets}",
            "2:52",
            "the network zephyr_sockets does not run under freertos, but under zephyr. "
            "Write `network: freertos_tcp` or `network: lwip` below `target:`",
        ),
        (
            "target: {name: cortex-m4, network: lwip, rtos: zephyr}",
            "2:36",
            "the network lwip does not run under zephyr, but under freertos or esp_idf or bare or posix. "
            "Write `network: zephyr_sockets` below `target:`",
        ),
    ],
)
def test_what_does_not_exist_is_refused_at_its_place(text: str, place: str, message: str) -> None:
    with pytest.raises(UserError) as raised:
        target_of(text)
    assert f"microros.yaml:{place}: error: {message}" in str(raised.value)


def test_tasks_need_a_system(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(f"{TASKS}target: {{name: cortex-m4, rtos: none}}\n")
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert "the target cortex-m4 has no tasks" in done.err
    assert "`target: {name: …, rtos: freertos}`" in done.err
    (folder / "microros.yaml").write_text(f"{TASKS}target: {{name: cortex-m4, rtos: freertos}}\n")
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    assert (folder / "out" / "src" / "port_freertos" / "port_freertos_tasks.c").is_file()
