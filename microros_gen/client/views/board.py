# SPDX-License-Identifier: Apache-2.0
"""Prepared view of a board: what README.md, CMakeLists.txt and toolchain.cmake print about it."""

from __future__ import annotations

from jinja2 import Environment

from microros_gen.client.plan.project import Project
from microros_gen.platform.target import Target
from microros_gen.records import dataclass


@dataclass(frozen=True)
class BoardView:
    """Flags are one text each. `links`: an image can be linked; `script` is its linker script below the output folder,
    empty where it is that of the compiler.

    `tick` is called each millisecond from `timer_interrupt`; empty where the operating system does that.
    """

    target: str
    suffix: str
    link_flags: str
    script: str
    links: bool
    stack: int
    os: str
    tick: str
    timer_interrupt: str

    @property
    def script_path(self) -> str:
        """The linker script as the folder's CMakeLists.txt names it."""
        return f"${{CMAKE_CURRENT_SOURCE_DIR}}/{self.script}" if self.script else ""

    @property
    def stack_note(self) -> str:
        """Where the stack of an image is."""
        if not self.script:
            return (
                "The stack is what remains of RAM, from its high end downwards; nothing notices an overflow."
            )
        return (
            f"Stack: {self.stack} bytes at the low end of RAM, where an overflow faults (`memory.stack` in the"
            " application file)."
        )


@dataclass(frozen=True)
class _ToolchainView:
    target: str
    compiler: str
    c_flags: str


def render_toolchain(target: Target, environment: Environment) -> bytes:
    """Return the CMake tool-chain file of a target without an operating system."""
    view = _ToolchainView(target.name, target.compilers[0], " ".join(target.c_flags))
    return environment.get_template("project/toolchain.cmake.j2").render(view=view).encode()


def board_view(project: Project) -> BoardView | None:
    """Return the view of a target without an operating system; None for others."""
    target = project.target
    if target.hosted:
        return None
    return BoardView(
        target=target.name,
        suffix=target.image_suffix,
        link_flags=" ".join((*target.link_flags, *target.libraries)),
        script=project.linker_script or "",
        links=target.has_image,
        stack=project.board.stack_size,
        os=_os(project),
        tick=target.os.tick,
        timer_interrupt=target.cpu.timer_interrupt,
    )


def _os(project: Project) -> str:
    """Return the operating system that has its own start-up code; empty if the image uses that of this project."""
    os = project.target.part("os")
    return "" if os is None or project.target.os.linker_script else os.component.name
