# SPDX-License-Identifier: Apache-2.0
"""Room in a transport that was full: which parts of a platform end a wait with it, and what Zephyr's functions do."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.components.rendered import UNITS, planned, program_of, rendered
from tests.support.paths import TESTS
from tests.support.patience import seconds

KERNELS = TESTS / "platform" / "kernels"
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+executor]
target: {target}
session: {{key: 1}}
transport: {transport}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    executors: [{{name: all}}]
{tasks}
"""
TASKS = "tasks: [{name: main, executor: all, rate: 10 Hz}]"
UDP = "{type: udp, agent: 192.168.1.2:8888}"
TCP = "{type: tcp, agent: 192.168.1.2:8888}"
SERIAL = "{type: serial}"
OWN = "target: own\nsummary: x\nextends: cortex-m4f\nos: freertos\n"
PART = """\
component: port_line
summary: A line
layer: port
status: ready
needs: [support]
provides: {serial: {sources: [line.c], waits_for_room: true}}
"""


def named(os: str, network: str = "") -> str:
    return f"{{name: cortex-m4, rtos: {os}{network and f', network: {network}'}}}"


def wakes(folder: Path, target: str, transport: str, tasks: str = TASKS) -> bool:
    text = APPLICATION.format(target=target, transport=transport, tasks=tasks)
    return planned(folder, text).project.runtime.transport.wakes_for_room


@pytest.mark.parametrize(
    ("target", "transport", "expected"),
    [
        ("host", TCP, True),
        ("host", SERIAL, True),
        ("host", UDP, False),
        (named("nuttx"), SERIAL, True),
        (named("freertos", "lwip"), TCP, True),
        (named("freertos", "lwip"), UDP, False),
        (named("freertos"), SERIAL, False),
        (named("freertos", "freertos_tcp"), TCP, True),
        (named("zephyr", "zephyr_sockets"), TCP, True),
        (named("zephyr", "zephyr_sockets"), UDP, False),
        (named("zephyr"), SERIAL, True),
        (named("esp_idf"), TCP, True),
    ],
)
def test_what_provides_the_transport_says_whether_room_ends_a_wait(
    target: str, transport: str, expected: bool, folder: Path
) -> None:
    assert wakes(folder, target, transport) == expected
    assert not wakes(folder, target, transport, tasks="")


def test_functions_of_the_application_are_tried_again(folder: Path) -> None:
    """The system below has such functions, too, but the library does not call them."""
    (folder / "own.yaml").write_text("target: own\nsummary: x\nextends: host\nprovides: [tcp]\n")
    assert not wakes(folder, "own.yaml", TCP)


@pytest.mark.builds
def test_a_serial_line_of_the_application_links_on_posix(folder: Path) -> None:
    """The wait looks at lines of the port only where the port has them."""
    (folder / "own.yaml").write_text("target: own\nsummary: x\nextends: host\nprovides: [serial]\n")
    text = APPLICATION.format(target="own.yaml", transport=SERIAL, tasks=TASKS)
    program = program_of(rendered(folder, text), "own_line.c", more=("-pthread",))
    subprocess.run([program], check=True, timeout=seconds(30))


@pytest.mark.builds
@pytest.mark.parametrize(("network", "expected"), [("posix_sockets", "looks"), ("lwip", "ignores")])
@pytest.mark.parametrize("transport", [UDP, TCP])
def test_a_wait_of_posix_looks_at_handles_of_its_own_sockets_only(
    network: str, expected: str, transport: str, folder: Path
) -> None:
    """A handle of lwIP is an address or 0, which is standard input: a poll of it might return at once, each time."""
    target = f"{{name: host, network: {network}}}"
    out = rendered(folder, APPLICATION.format(target=target, transport=transport, tasks=TASKS))
    names = ("port_posix_wait.c", "port_posix_room.c", "port_posix_time.c", "port_posix_lock.c", "lock.c")
    files = [path for path in (out / "src").rglob("*.c") if path.name in names]
    program = folder / "unit"
    call: list[str | Path] = ["gcc", "-std=gnu99", f"-I{out / 'include'}", "-pthread"]
    subprocess.run([*call, UNITS / "posix_wait.c", *files, "-o", program], check=True)
    subprocess.run([program, expected], check=True, timeout=seconds(60))


def test_a_part_of_the_user_says_it(folder: Path) -> None:
    (folder / "line" / "src").mkdir(parents=True)
    (folder / "line" / "src" / "line.c").write_text("/* see own.yaml */\n")
    (folder / "own.yaml").write_text(f"{OWN}network: ./line\n")
    for text, expected in ((PART, True), (PART.replace(", waits_for_room: true", ""), False)):
        (folder / "line" / "component.yaml").write_text(text)
        assert wakes(folder, "own.yaml", SERIAL) == expected


def test_a_serial_line_of_zephyr_is_waited_for_without_its_sockets(folder: Path) -> None:
    """Its handle is no descriptor: a poll of it would return at once."""
    for transport, expected in ((SERIAL, "port_zephyr_wait.c"), (UDP, "port_zephyr_poll.c")):
        target = named("zephyr", "zephyr_sockets")
        text = APPLICATION.format(target=target, transport=transport, tasks=TASKS)
        files = {name for _, name in planned(folder, text).project.provisions.files}
        assert files & {"port_zephyr_wait.c", "port_zephyr_poll.c"} == {expected}


@pytest.mark.builds
@pytest.mark.parametrize(
    ("unit", "transport", "sources"),
    [
        ("zephyr_room.c", TCP, ("port_zephyr_poll.c", "port_zephyr_room.c", "port_zephyr_tcp.c")),
        ("zephyr_ring.c", SERIAL, ("port_zephyr_serial.c",)),
    ],
)
def test_functions_of_zephyr_end_a_wait_with_room(
    unit: str, transport: str, sources: tuple[str, ...], folder: Path
) -> None:
    target = named("zephyr", "zephyr_sockets")
    out = rendered(folder, APPLICATION.format(target=target, transport=transport, tasks=TASKS))
    files = [path for path in (out / "src").rglob("*.c") if path.name in sources]
    assert len(files) == len(sources)
    includes = (out / "include", KERNELS / "zephyr", KERNELS / "zephyr_sockets", UNITS)
    program = folder / "unit"
    call: list[str | Path] = [
        "gcc",
        "-std=gnu99",
        "-fsanitize=undefined",
        *(f"-I{path}" for path in includes),
    ]
    subprocess.run([*call, UNITS / unit, *files, "-o", program], check=True)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
