# SPDX-License-Identifier: Apache-2.0
"""Images of one chip, here processes with a file as the memory that all have."""

from __future__ import annotations

import os
import subprocess
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from tests.support.components.rendered import SANITIZE, UNITS, rendered
from tests.support.e2e.commanded import CommandedProgram
from tests.support.patience import deadline
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, link

SYSTEM = """\
version: 1
boards:
  first: {application: first/microros.yaml}
  second: {application: second/microros.yaml}
chips:
  - [first, second]
"""
HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
limits: {"*": {string: 12}}
"""
PING, PONG = "topic: ping, type: std_msgs/msg/String", "topic: pong, type: std_msgs/msg/Int32"
CHIP = "local: chip, qos: {depth: 2}"


def _application(board: str, sent: str, received: str) -> str:
    return f"""\
{HEAD}system: {{file: ../system.yaml, board: {board}}}
nodes:
  - name: {board}
    publishers: [{{{sent}, {CHIP}}}]
    subscriptions: [{{{received}, {CHIP}}}]
"""


FIRST, SECOND = _application("first", PING, PONG), _application("second", PONG, PING)

TOPICS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +services]
limits: {"*": {string: 40}}
system: {file: ../system.yaml, board: OWN}
nodes:
  - name: OWN
    publishers:
      - {topic: /OWN/best, type: std_msgs/msg/String, local: chip, qos: {depth: 3, reliability: best_effort}}
      - {topic: /OWN/sure, type: std_msgs/msg/String, local: chip, qos: {depth: 3}}
    subscriptions:
      - topic: /OTHER/best
        type: std_msgs/msg/String
        local: chip
        qos: {depth: 3, reliability: best_effort}
        queue: 8
      - {topic: /OTHER/sure, type: std_msgs/msg/String, local: chip, qos: {depth: 3}, queue: 8}
    services: [{name: /OWN/sum, type: example_interfaces/srv/AddTwoInts, local: chip, queue: 2}]
    clients: [{name: /OTHER/sum, type: example_interfaces/srv/AddTwoInts, local: chip, queue: 2}]
"""
BOARDS = ("first", "second")


GROUP_SYSTEM = """\
version: 1
boards:
  first: {application: first/microros.yaml}
  second: {application: second/microros.yaml}
  third: {application: third/microros.yaml}
chips:
  - {images: [first, second, third], memory: 4 KiB}
"""
GROUP = ("first", "second", "third")
_GROUP_HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +services]
limits: {"*": {string: 40}}
system: {file: ../system.yaml, board: OWN}
nodes:
  - name: OWN
"""
_BEST, _SURE = "{depth: 3, reliability: best_effort}", "{depth: 3}"


def _topics(names: tuple[str, ...], more: str = "") -> str:
    return "".join(
        f"      - {{topic: {name}, type: std_msgs/msg/String, local: chip, qos: {qos}{more}}}\n"
        for name, qos in zip(names, (_BEST, _SURE, _SURE), strict=False)
    )


@dataclass(frozen=True)
class Member:
    """An image of a chip with three: its topics, the first of which is best effort, and its services."""

    sends: tuple[str, ...]
    receives: tuple[str, ...]
    served: str = ""
    requested: str = ""

    def application(self, own: str) -> str:
        """Return its application file."""
        text = _GROUP_HEAD.replace("OWN", own)
        text += f"    publishers:\n{_topics(self.sends)}    subscriptions:\n{_topics(self.receives, ', queue: 8')}"
        for key, name in (("services", self.served), ("clients", self.requested)):
            if name:
                text += f"    {key}:\n      - name: {name}\n        type: example_interfaces/srv/AddTwoInts\n"
                text += "        local: chip\n        queue: 2\n"
        return text

    @property
    def flags(self) -> tuple[str, ...]:
        """Return the definitions for c/shared_image.c."""
        listed = (", ".join(f'"{name}"' for name in names) for names in (self.sends, self.receives))
        named = (f'"{name}"' for name in (self.served, self.requested))
        texts = zip(("OUT_NAMES", "IN_NAMES", "SERVED", "ASKED"), (*listed, *named), strict=True)
        return tuple(f"-D{name}={text}" for name, text in texts if text != '""')


NEWS, TALK = ("/news/best", "/news/sure"), ("/talk/best", "/talk/sure")
MEMBERS: Mapping[str, Member] = MappingProxyType(
    {
        "first": Member(NEWS, TALK, served="/sum"),
        "second": Member((*TALK, "/side"), NEWS, requested="/sum"),
        "third": Member(TALK, (*NEWS, "/side"), requested="/sum"),
    }
)
"""One image sends to two others and serves both; two send to one; and there is a topic between these two."""


FOUR: Mapping[str, Member] = MappingProxyType(
    {
        "first": Member(NEWS, TALK, served="/sum"),
        **{board: Member(TALK, NEWS, requested="/sum") for board in ("second", "third", "fourth")},
    }
)
"""One image sends to three others and serves all of them, which send to it."""
FOUR_SYSTEM = GROUP_SYSTEM.replace("third]", "third, fourth]").replace(
    "chips:", "  fourth: {application: fourth/microros.yaml}\nchips:"
)


def write_group(folder: Path, system: str = GROUP_SYSTEM, **applications: str) -> Path:
    """Write a system of one chip with three images, some with another application, or more; return the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "system.yaml").write_text(system)
    texts = {board: member.application(board) for board, member in MEMBERS.items()} | applications
    for board, text in texts.items():
        (folder / board).mkdir(exist_ok=True)
        (folder / board / "microros.yaml").write_text(text)
    return folder


def group_program(folder: Path, own: str, old: str = "", new: str = "") -> Path:
    """Build the image `own` of three, in all of whose applications `old` is replaced by `new`."""
    texts = {board: member.application(board).replace(old, new) for board, member in MEMBERS.items()}
    home = write_group(folder / f"of_{own}", **(texts if old else {}))
    return _linked(home, own, (f'-DOWN="{own}"', *MEMBERS[own].flags))


def program_of_four(folder: Path, own: str) -> Path:
    """Build the image `own` of a chip with four."""
    texts = {board: member.application(board) for board, member in FOUR.items()}
    home = write_group(folder / f"of_{own}", FOUR_SYSTEM, **texts)
    return _linked(home, own, (f'-DOWN="{own}"', *FOUR[own].flags))


def written(folder: Path, system: str = SYSTEM, first: str = FIRST, second: str = SECOND) -> Path:
    """Write a system and the applications of its two images; return the folder."""
    (folder / "system.yaml").write_text(system)
    for board, text in (("first", first), ("second", second)):
        (folder / board).mkdir(parents=True, exist_ok=True)
        (folder / board / "microros.yaml").write_text(text)
    return folder


def program(folder: Path, own: str, text: str = TOPICS) -> Path:
    """Build the image `own` of a system whose images have the application `text`."""
    first, second = (text.replace("OWN", a).replace("OTHER", b) for a, b in (BOARDS, BOARDS[::-1]))
    home = folder / f"of_{own}"
    home.mkdir()
    written(home, SYSTEM, first, second)
    return _linked(home, own, (f'-DOWN="{own}"', f'-DOTHER="{BOARDS[1 - BOARDS.index(own)]}"'))


def _linked(home: Path, own: str, names: tuple[str, ...]) -> Path:
    """Build the image of an application below a folder with its system."""
    out = rendered(home / own, (home / own / "microros.yaml").read_text())
    flags = (*SANITIZE, *names)
    sources = sorted((out / "src").rglob("*.c"))
    objects = compile_merged(Tree(out, ()), sources, [UNITS / "shared_image.c"], SANITIZER, flags)
    return link(objects, SANITIZER, flags, out / "unit")


class Image(CommandedProgram):
    """A process that is an image."""

    def __init__(self, program: Path, memory: Path) -> None:
        self.process = subprocess.Popen(
            [program],
            env={**os.environ, "MICROROS_SHARED": str(memory)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        super().__init__(self.process)

    def __enter__(self) -> Image:
        return self

    def __exit__(self, *_: object) -> None:
        self.kill()

    def publish(self, topic: int, text: str, how: str = "publish") -> str:
        """Publish; return the error text, empty for none."""
        return self.call(f"{how} {topic} {text}")[1]

    def spin(self, milliseconds: int = 2) -> list[str]:
        """Return what it hears, and what the executor reports."""
        return self.call(f"spin {milliseconds}")[2]

    def ask(self, a: int, b: int) -> tuple[str, list[str]]:
        """Send a request; return the error text and `sent` with its number."""
        return self.call(f"ask {a} {b}")[1:]

    def counts(self, command: str) -> dict[str, int]:
        """Return the numbers that a command prints, by their names."""
        return {name: int(count) for name, count in (line.split() for line in self.call(command)[2])}

    def listened(self, before: int) -> dict[str, int]:
        """Listen until it has received more than the `before` messages; return its counts."""
        end = deadline(10)
        counts = self.counts("listen 150")
        while counts["heard"] <= before and time.monotonic() < end:
            counts = self.counts("listen 150")
        return counts

    def kill(self) -> None:
        """End it as if it lost its supply."""
        self.process.kill()
        self.process.communicate()
