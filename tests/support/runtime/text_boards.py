# SPDX-License-Identifier: Apache-2.0
"""Boards as processes whose messages are longer than the MTU of their link: texts, requests and replies."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tests.support.e2e.commanded import CommandedProgram
from tests.support.patience import deadline
from tests.support.runtime.peers import Network, calm

LONGEST = 3000
"""Characters of the longest text."""
TEXT_APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services]
system: {file: ../system.yaml, board: OWN}
session: {round_trip: 20 ms, heartbeat: 10 ms}
nodes:
  - name: board
    publishers: [{topic: /OWN/text, type: std_msgs/msg/String, peer: only, limits: {data: 3000}}]
    subscriptions: [{topic: /OTHER/text, type: std_msgs/msg/String, peer: only, queue: 9, limits: {data: 3000}}]
    services:
      - name: /OWN/check
        type: diagnostic_msgs/srv/AddDiagnostics
        peer: only
        limits: {load_namespace: 450, message: 900}
    clients:
      - name: /OTHER/check
        type: diagnostic_msgs/srv/AddDiagnostics
        peer: only
        limits: {load_namespace: 450, message: 900}
"""
Text = tuple[int, int]
"""Seed and length."""


class TextBoard(CommandedProgram):
    """A process that is a board; `received`, `served` and `replies` are what it has received."""

    def __init__(self, program: Path, *arguments: str) -> None:
        pipe = subprocess.PIPE
        self.process = subprocess.Popen([str(program), *arguments], stdin=pipe, stdout=pipe, text=True)
        super().__init__(self.process)
        self.received: list[Text] = []
        self.served: list[Text] = []
        self.replies: list[Text] = []
        self.counts = (0, 0, 0)

    def tell(self, command: str) -> str:
        """Return the error of a command, empty for none."""
        code, error, lines = self.call(command)
        assert bool(code) == bool(error), (code, error)
        for line in lines:
            word, *numbers = line.split()
            if word == "counts":
                self.counts = (int(numbers[0]), int(numbers[1]), int(numbers[2]))
            else:
                lists = {"got": self.received, "served": self.served, "reply": self.replies}[word]
                lists.append((int(numbers[0]), int(numbers[1])))
        return error

    def waiting(self) -> int:
        """Return how many messages are not acknowledged."""
        assert not self.tell("counts")
        return self.counts[2]


@contextmanager
def running(program: Path, *arguments: str) -> Iterator[TextBoard]:
    """Start a board, and wait until it has opened everything; with an argument, all but its subscription."""
    board = TextBoard(program, *arguments)
    try:
        assert not board.tell("counts")
        yield board
    finally:
        board.process.kill()
        board.process.communicate()


@contextmanager
def pair(programs: tuple[Path, Path]) -> Iterator[tuple[TextBoard, TextBoard]]:
    """Start both boards and wait until each has received from the other."""
    with running(programs[0]) as first, running(programs[1]) as second:
        meet(first, second)
        yield first, second


def meet(first: TextBoard, second: TextBoard) -> None:
    """Let both boards run until each has received from the other one, and forget what that took."""
    for sender, receiver in ((first, second), (second, first)):
        until(lambda sender=sender: not sender.tell("publish 1 1"), first, second)  # type: ignore[misc]
        until(lambda receiver=receiver: receiver.received, first, second)  # type: ignore[misc]
    until(lambda: not first.waiting() and not second.waiting(), first, second)
    for board in (first, second):
        board.received.clear()


def until(seen: Callable[[], object], *boards: TextBoard) -> None:
    """Let boards run until something is true."""
    end = deadline(20)
    while not seen():
        assert time.monotonic() < end, [(board.received, board.replies, board.counts) for board in boards]
        for board in boards:
            board.tell("spin 1")


def renumber(network: Network, first: TextBoard, second: TextBoard, number: int) -> None:
    """Let both boards count from a number on, when nothing of the numbers before is under way."""
    boards = (first, second)
    calm(network, lambda: [board.tell("spin 1") for board in boards])
    for board in boards:
        assert not board.tell(f"numbers {number} {number}")


def publish(board: TextBoard, other: TextBoard, texts: Sequence[Text]) -> None:
    """Publish each text; repeat a call that finds no room."""
    for seed, size in texts:
        until(lambda seed=seed, size=size: not board.tell(f"publish {seed} {size}"), board, other)  # type: ignore[misc]
