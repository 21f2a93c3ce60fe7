# SPDX-License-Identifier: Apache-2.0
"""Two boards of one system as processes that serve, call and publish over their link."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.support.components.rendered import program_of, rendered
from tests.support.e2e.commanded import CommandedProgram
from tests.support.patience import deadline
from tests.support.runtime.peers import PAIR, application, written

SERVICES = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services]
system: {file: ../system.yaml, board: OWN}
session: {round_trip: 20 ms, heartbeat: 10 ms}
nodes:
  - name: board
    publishers:
      - {topic: /OWN/sure, type: std_msgs/msg/Int32, peer: only}
      - {topic: /OWN/best, type: std_msgs/msg/Int32, peer: only, qos: {reliability: best_effort}}
    subscriptions:
      - {topic: /OTHER/sure, type: std_msgs/msg/Int32, peer: only}
      - {topic: /OTHER/best, type: std_msgs/msg/Int32, peer: only, qos: {reliability: best_effort}}
    services:
      - {name: /OWN/add, type: example_interfaces/srv/AddTwoInts, peer: only}
      - {name: /OWN/later, type: example_interfaces/srv/AddTwoInts, peer: only}
    clients:
      - {name: /OTHER/add, type: example_interfaces/srv/AddTwoInts, peer: only}
      - {name: /OTHER/later, type: example_interfaces/srv/AddTwoInts, peer: only}
"""


class ServiceBoard(CommandedProgram):
    """A process that is a board; what it printed is in `served`, `replies`, `later`, `received` and `words`."""

    def __init__(self, program: Path, clock: int = 0) -> None:
        self.process = subprocess.Popen(
            [str(program), str(clock)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        super().__init__(self.process)
        self.served: list[tuple[int, int]] = []
        self.replies: list[tuple[int, int]] = []
        self.later: list[tuple[int, int]] = []
        self.received: list[int] = []
        self.words: list[str] = []

    def tell(self, command: str) -> str:
        """Return the error of a command, empty for none."""
        code, error, lines = self.call(command)
        assert bool(code) == bool(error), (code, error)
        for line in lines:
            word, *rest = line.split()
            kept = {"served": self.served, "reply": self.replies, "later": self.later}.get(word)
            if kept is not None:
                kept.append((int(rest[0]), int(rest[1])))
            elif word == "got":
                self.received.append(int(rest[0]))
            else:
                self.words.append(line)
        return error

    def takes(self, count: int) -> bool:
        """Take a request of /OWN/later if there is one; return whether so many were taken since the start."""
        assert not self.tell("take")
        return sum(line.startswith("taken") for line in self.words) >= count

    def counts(self) -> tuple[int, int, int]:
        """Return the numbers of dropped messages, interrupted requests of /OTHER/later, and reliable ones that wait."""
        assert not self.tell("counts")
        dropped, interrupted, waiting = map(int, self.words[-1].split()[1:])
        return dropped, interrupted, waiting

    def kill(self) -> None:
        """End it as if it lost its supply."""
        self.process.kill()
        self.process.communicate()


def service_board_program(
    folder: Path,
    own: str,
    system_text: str,
    text: str = SERVICES,
    others: str = SERVICES,
    flags: tuple[str, ...] = (),
) -> Path:
    """Build the program of a board, with a separate system file; `others`: what the other board has."""
    home = written(folder / f"of_{own}", system_text, others)
    out = rendered(home / own, application(own, text))
    names = (f'-DOWN="{own}"', f'-DOTHER="{PAIR[1 - PAIR.index(own)]}"')
    return program_of(out, "peer_service_board.c", ("port_posix_time.c",), (*names, *flags))


@contextmanager
def service_board(program: Path, clock: int = 0) -> Iterator[ServiceBoard]:
    """Start a board; end it afterwards, whatever happened."""
    board = ServiceBoard(program, clock)
    try:
        yield board
    finally:
        if board.process.poll() is None:
            board.kill()


def until(seen: Callable[[], object], *boards: ServiceBoard) -> None:
    """Let boards run until something is true."""
    end = deadline(10)
    while not seen():
        assert time.monotonic() < end, [(b.served, b.replies, b.later, b.words) for b in boards]
        for board in boards:
            assert not board.tell("spin 2")
