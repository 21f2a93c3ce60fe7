# SPDX-License-Identifier: Apache-2.0
"""Every command on a page of docs/ is run: here, by another test that says so, or a box on the page says why not."""

from __future__ import annotations

import re
import shutil
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.support.console import SHELL, Terminal, blocks, shows, steps
from tests.support.paths import ROOT
from tests.support.ros.running import running

PAGES = {str(path.relative_to(ROOT / "docs")): path for path in sorted((ROOT / "docs").rglob("*.md"))}
ELSEWHERE = {
    "howto/agent.md": "tests/docs/test_agent_page.py",
    "howto/check.md": "tests/docs/test_init_pages.py",
    "howto/cmake.md": "tests/workspace/test_example.py",
    "howto/idl.md": "tests/docs/test_init_pages.py",
    "howto/secure_links.md": "tests/docs/test_secure_links.py",
    "verification/proof.md": "tests/proof/test_proof.py",
    "howto/ros_build.md": "tests/support/workspace/ros_environments.py",
}
"""Pages whose commands another test runs, which reads the page."""

_META = '{"names": {"rmw_microxrcedds": {"cmake-args": ["-DRMW_UXRCE_MAX_NODES=1"]}}}'
GIVEN = {
    "howto/init.md": {"app-colcon.meta": _META},
    "howto/ros_tools.md": {"robot_msgs/msg/Wheels.msg": "float32[2] rad_per_s\n"},
}
"""Files that the reader of a page has already."""
NODES = {"howto/ros_tools.md": "tests.support.ros.arm"}
"""The system that the reader of a page looks into: a module that runs its nodes and prints `ready`."""

OTHER_PROGRAMS = {
    "arm-none-eabi-gcc": "gcc-arm-none-eabi",
    "qemu-system-arm": "qemu-system-arm",
    "cmake": "cmake",
    "avr-gcc": "gcc-avr avr-libc",
}
NEEDS = {
    "tutorial/qemu.md": ("arm-none-eabi-gcc", "qemu-system-arm"),
    "tutorial/nucleo_f446re.md": ("arm-none-eabi-gcc", "cmake"),
    "tutorial/arduino_uno.md": ("avr-gcc",),
    "howto/init.md": ("cmake",),
}


LONG = ("howto/init.md", "tutorial/nucleo_f446re.md")
"""Pages that compile the library by CMake; tests/workspace and test_boards.py have their slices."""
SYSTEM = (
    *("tutorial/host.md", "tutorial/qemu.md", "tutorial/esp32c3.md", "tutorial/pico.md"),
    *("tutorial/arduino_uno.md", "howto/actions.md", "howto/executor.md", "howto/peer.md", "howto/tasks.md"),
    *("howto/transforms.md", "howto/ros_tools.md"),
    *("howto/component.md", "howto/lifecycle.md", "howto/logging.md", "howto/migrate.md", "howto/modes.md"),
    *("howto/node_modes.md", "howto/parameter_server.md", "howto/port.md", "howto/profile.md"),
    *(
        "howto/arduino.md",
        "howto/interface.md",
        "howto/local_delivery.md",
        "howto/package.md",
        "howto/seal.md",
    ),
    *("howto/selftest.md", "howto/stm32cube.md", "howto/zephyr.md"),
)
"""Pages whose commands start compilers and servers, of which quick_start.md and the tests of these parts have the
shorter sibling."""
SIBLINGS = {
    "tutorial/host.md": "quick_start.md",
    "howto/teensy.md": "howto/arduino.md",
    "howto/platformio.md": "howto/arduino.md",
    "howto/nuttx.md": "howto/zephyr.md",
    "howto/esp_idf.md": "howto/zephyr.md",
    "howto/pico.md": "howto/stm32cube.md",
    "howto/transforms.md": "howto/executor.md",
}
"""Pages that CI leaves to `make system`: it has the sibling, with the same commands for another board or part."""


def pages_that_run() -> list[Any]:
    names = [name for name in PAGES if name not in ELSEWHERE and runs(name)]
    marks = {**dict.fromkeys(LONG, pytest.mark.long), **dict.fromkeys(SYSTEM, pytest.mark.system)}
    marks |= dict.fromkeys(SIBLINGS, pytest.mark.variant)
    return [pytest.param(name, marks=marks.get(name, ())) for name in names]


def test_the_sibling_of_each_page_is_in_ci() -> None:
    wanted = {
        param.values[0]
        for param in pages_that_run()
        if not {"variant", "long"} & {m.name for m in param.marks}
    }
    assert set(SIBLINGS.values()) <= wanted


def runs(name: str) -> bool:
    return any(block.language in SHELL for block in steps(PAGES[name].read_text(encoding="utf-8")))


@pytest.mark.ros
@pytest.mark.parametrize("name", pages_that_run())
def test_the_commands_of_a_page_run_and_print_what_it_shows(name: str, tmp_path: Path) -> None:
    for program in NEEDS.get(name, ()):
        if shutil.which(program) is None:
            pytest.skip(f"no {program}: apt-get install {OTHER_PROGRAMS[program]}")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    terminal = Terminal(tmp_path, port)
    for path, text in GIVEN.get(name, {}).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    with system_of(name, terminal):
        follow(name, terminal)


@contextmanager
def system_of(name: str, terminal: Terminal) -> Iterator[None]:
    """Run the nodes that the commands of a page speak with."""
    if name not in NODES:
        yield
        return
    with running(terminal.domain, NODES[name]) as nodes:
        nodes.wait_for("ready")
        yield


def follow(name: str, terminal: Terminal) -> None:
    """Do what a page says, from its first line to its last."""
    try:
        for block in steps(PAGES[name].read_text(encoding="utf-8")):
            if block.title:
                terminal.write(block)
            for command, shown in block.commands if block.language in SHELL else ():
                terminal.run(command, shown)
    finally:
        terminal.close()


@pytest.mark.parametrize("name", PAGES)
def test_no_command_is_left_out(name: str) -> None:
    text = PAGES[name].read_text(encoding="utf-8")
    if name in ELSEWHERE:
        assert Path(name).name in (ROOT / ELSEWHERE[name]).read_text(encoding="utf-8")
        return
    for block in blocks(text):
        assert block.language, f"a block without a language: {block.text}"
        assert block.language not in ("bash", "shell", "zsh", "shell-session", "terminal"), (
            "say console or sh"
        )
        if block.language == "console":
            assert block.text.startswith("$ "), f"no line begins with `$ `: {block.text}"
    indented = r"^    (\$ |microros-gen |pip |apt-get |make |cmake |colcon )"
    assert not re.search(indented, _outside(text), re.MULTILINE), "commands belong into a block"


def _outside(text: str) -> str:
    """Return a page without its boxes: their blocks are indented."""
    return re.sub(r"^!!! .*\n((?: {4}.*)?\n)*", "", text, flags=re.MULTILINE)


@pytest.mark.parametrize("name", PAGES)
def test_what_is_not_run_says_why(name: str) -> None:
    text = PAGES[name].read_text(encoding="utf-8")
    for title in re.findall(r"^!!! not-run(.*)$", text, re.MULTILINE):
        assert re.fullmatch(r' "Not run here: \S.{8,}"', title), title
    assert "not-run" not in re.sub(r"^!!! not-run .*$|`[^`\n]+`", "", text, flags=re.MULTILINE)


@pytest.mark.parametrize("name", PAGES)
def test_parts_of_files_are_whole(name: str) -> None:
    """Pages that show some lines of a file say which; they begin and end where the C code does."""
    for path, start, end in re.findall(
        r'^--8<-- "([^":]+\.c):(\d+):(\d+)"$', PAGES[name].read_text(), re.MULTILINE
    ):
        lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
        shown = "\n".join(lines[int(start) - 1 : int(end)])
        assert all(shown.count(a) == shown.count(b) for a, b in ("()", "{}"))
        assert shown.rstrip().endswith((";", "}"))


@pytest.mark.parametrize("name", PAGES)
def test_files_that_a_page_names_exist(name: str) -> None:
    text = PAGES[name].read_text(encoding="utf-8")
    named = re.findall(r"`((?:tests|examples|microros_gen|profiles|cmake|docs)/[\w./-]+\.\w+)`", text)
    assert [path for path in named if not (ROOT / path).exists()] == []


def test_blocks_are_read_as_a_page_has_them() -> None:
    page = """```console
$ one
out
$ two &
```

```yaml title="a/b.yaml"
x: 1
```

!!! not-run "Not run here: because"
    Words.

    ```console
    $ three
    ```

```c
int x;
```
"""
    first, file, three, code = blocks(page)
    assert first.commands == [("one", ["out"]), ("two &", [])]
    assert (file.title, file.text) == ("a/b.yaml", "x: 1\n")
    assert (three.not_run, three.commands) == ("Not run here: because", [("three", [])])
    assert (code.language, code.not_run) == ("c", "")


@pytest.mark.parametrize(
    ("printed", "shown", "same"),
    [
        ("a\nb\n", ["a", "b"], True),
        ("a\nb\n", ["a"], False),
        ("a\nb\nc\n", ["a", "..."], True),
        ("a\nb\nc\n", ["...", "c"], True),
        ("a\nb\nc\n", ["...", "b"], False),
        ("data: 17\n", ["data: …"], True),
        ("date: 17\n", ["data: …"], False),
        ("files      3 written\n", ["files      4 written"], True),
    ],
)
def test_what_is_printed_is_compared(printed: str, shown: list[str], same: bool) -> None:
    assert shows(printed, shown) is same
