# SPDX-License-Identifier: Apache-2.0
"""Senders of one Int32 whose size is promised, and what they take: sections, stack, instructions."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from tests.support.firmware.board import Board, Builds, Built, board, target
from tests.support.firmware.instructions import counted_regions
from tests.support.firmware.line import scripted_agent
from tests.support.runtime.fake_agent import FakeAgent

MODES = ("binary", "xml", "reference", "preconfigured")
RELIABILITIES = ("reliable", "best_effort")
AGENT_FUNCTIONS = (
    "port_udp_open",
    "port_udp_close",
    "port_udp_send",
    "port_udp_receive",
    "put",
    "answer",
    "answer_status",
    "answer_acknack",
    "answer_session",
)
"""Functions of c/measured.c that simulate the agent: their work does not count."""
_PAINT = 0xC5C5C5C5
INTERRUPTS = (
    "port_bare_tick",
    "port_cortex_m_uart_interrupt",
    "port_cortex_m_default",
    "port_riscv_trap",
    "port_riscv_trap_entry",
    "port_riscv_interrupt",
    "port_riscv_timer_next",
)
"""The timer ticks while the program works: how often depends on where its first tick fell, so none of it counts."""


@dataclass(frozen=True)
class Sender:
    """What the application file says: one publisher of std_msgs/msg/Int32."""

    entities: str = "binary"
    reliability: str = "reliable"
    errors: str = "code"
    profile: str = "pure_sender"
    liveliness: str = "ping"
    transport: str = ""
    pools: str = ""
    note: str = ""

    @property
    def label(self) -> str:
        """What tells it from the others."""
        return " ".join((self.profile, self.entities, self.note or f"{self.reliability} {self.errors}"))

    @property
    def application(self) -> str:
        """The application file."""
        lines = [
            "version: 1",
            f"profiles: [{self.profile}]",
            f"entities: {self.entities}",
            f"liveliness: {self.liveliness}",
            f"errors: {self.errors}",
            *([f"transport: {self.transport}"] if self.transport else []),
            *([f"pools: {self.pools}"] if self.pools else []),
            "nodes:",
            "  - name: bench",
            "    publishers:",
            "      - topic: count",
            "        type: std_msgs/msg/Int32",
            *(
                ["        qos: {reliability: best_effort, depth: 5}"]
                if self.reliability != "reliable"
                else []
            ),
        ]
        return "\n".join(lines) + "\n"


LIKE_FOR_LIKE = Sender(
    transport="{type: serial, mtu: 512}", pools="{slot_size: 512, history: 4}", note="MTU 512, history 4"
)
"""The buffers of the existing stack's tightest build."""


SERVES = """\
version: 1
profiles: [pure_reader]
components: [-subscribe, +services, +executor]
errors: code
nodes:
  - name: server
    services: [{name: set_bool, type: std_srvs/srv/SetBool, limits: {message: 20}}]
"""
"""A server of std_srvs/srv/SetBool, the application of c/setbool.c."""


@dataclass(frozen=True)
class Sections:
    """Bytes of a linked image; `bss` has everything that is zero at the start and no stack."""

    text: int
    data: int
    bss: int

    @property
    def ram(self) -> int:
        """All static memory, the stack left out."""
        return self.data + self.bss


@dataclass(frozen=True)
class Work:
    """Instructions of the client alone: until its publisher is ready, of the first publish, of a later one.

    A later one also takes in what the agent said to the one before.
    """

    ready: int
    first_publish: int
    publish: int


def sections(built: Built) -> Sections:
    """Return what the tool chain's own `size` counts, less the section that holds the stack."""
    return image_sections(built, built.image)


def image_sections(built: Built, image: Path) -> Sections:
    """Return the same of any image that was linked with the library of `built`."""
    command = [built.tool("size"), "-A", str(image)]
    found = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    sizes = {name: int(size) for name, size in re.findall(r"^(\.\S+)\s+(\d+)", found, re.MULTILINE)}
    command = [built.tool("size"), str(image)]
    total = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[1].split()
    return Sections(int(total[0]), int(total[1]), int(total[2]) - sizes.get(".stack", 0))


def buffers(built: Built) -> int:
    """Return the bytes of all streams and of the two rings of a serial line."""
    pools = json.loads((built.out / "manifest.json").read_text())["pools"]
    streams = pools["reliable_slots"] * pools["reliable_slot_size"] + pools["best_effort_size"]
    sizes = re.findall(r"^\S+ (\S+) \S (port_ring|port_output)$", _symbol_sizes(built), re.MULTILINE)
    return int(streams + pools["input_size"] + sum(int(size, 16) for size, _ in sizes))


def _symbol_sizes(built: Built) -> str:
    return subprocess.run(
        [built.tool("nm"), "-S", str(built.image)], capture_output=True, text=True, check=True
    ).stdout


def measured_stack(built: Built, samples: int = 5) -> int:
    """Return how many bytes of the stack the image has used when `samples` samples have left the board."""
    agent = FakeAgent(objects={b"\0\5": b""})  # a preconfigured client writes to existing objects
    with board(built) as running, scripted_agent(running.device, agent):
        running.go_on()
        running.wait_for(lambda: len(agent.values()) >= samples)
        return touched_stack(running, built, built.image)


def touched_stack(running: Board, built: Built, image: Path) -> int:
    """Return how many bytes of its stack a running image has used up to now."""
    symbols = built.symbols(image)
    size = symbols["port_stack_high"] - symbols["port_stack_low"]
    words = running.words("port_stack_low", size // 4)
    untouched = next((i for i, word in enumerate(words) if word != _PAINT), len(words))
    return size - 4 * untouched


def bounded_stack(built: Built, image: Path | None = None) -> int:
    """Return the worst stack that `microros-gen size` proves for an image, by default the example, with interrupts."""
    command = [sys.executable, "-m", "microros_gen", "size", str(built.out), "--format", "json"]
    if image is not None and image != built.image:
        command += ["--image", str(image)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    stack = json.loads(done.stdout)["stack"]
    assert not stack["not_counted"], stack["not_counted"]
    return int(stack["total"])


def work(builds: Builds, name: str, sender: Sender) -> Work:
    """Count the instructions of `sender` on board `name`, with the agent of c/measured.c."""
    transport = sender.transport.replace("serial", "udp") or "{type: udp}"
    built = builds.build(name, replace(sender, transport=transport).application)
    suffix = "default" if sender.reliability == "reliable" else "best_effort"
    image = builds.application(built, "measured.c", f"-DBENCH_INIT=rclc_publisher_init_{suffix}")
    empty, ready, *publishes = counted_regions(target(name), image, (*AGENT_FUNCTIONS, *INTERRUPTS))
    return Work(ready - empty, publishes[0] - empty, publishes[-1] - empty)
