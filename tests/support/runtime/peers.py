# SPDX-License-Identifier: Apache-2.0
"""Two boards of one system as processes, and a relay of datagrams between them that decodes, loses and repeats."""

from __future__ import annotations

import random
import select
import socket
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.submessages import decode
from tests.support.components.rendered import program_of, rendered
from tests.support.e2e.commanded import CommandedProgram
from tests.support.patience import deadline

HOST = "127.0.0.1"
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
system: {file: ../system.yaml, board: OWN}
session: {round_trip: 20 ms, heartbeat: 10 ms}
nodes:
  - name: board
    publishers:
      - {topic: /OWN/best, type: std_msgs/msg/Int32, peer: only, qos: {reliability: best_effort}}
      - {topic: /OWN/sure, type: std_msgs/msg/Int32, peer: only}
    subscriptions:
      - topic: /OTHER/best
        type: std_msgs/msg/Int32
        peer: only
        queue: 40
        qos: {reliability: best_effort}
      - {topic: /OTHER/sure, type: std_msgs/msg/Int32, peer: only, queue: 40}
"""
PAIR = ("a", "b")
COUNTS = ("times ", "reconnects ", "dropped ", "wakes ", "sessions ")
"""Lines of a board that are a number."""

Fate = Callable[[bytes], Sequence[bytes]]
"""What becomes of a datagram: those that arrive instead of it, in order."""


def system(first: str, second: str, kind: str = "udp") -> str:
    """Return a system file of the boards a and b, with the ends of their link."""
    return f"""\
version: 1
boards:
  a: {{application: a/microros.yaml}}
  b: {{application: b/microros.yaml}}
links:
  - {{type: {kind}, ends: {{a: "{first}", b: "{second}"}}}}
"""


def application(own: str, text: str = APPLICATION) -> str:
    """Return the application of board a or b."""
    other = PAIR[1 - PAIR.index(own)]
    return text.replace("OWN", own).replace("OTHER", other)


def written(folder: Path, system_text: str, text: str = APPLICATION) -> Path:
    """Write a system and the applications of its two boards; return the folder."""
    for own in PAIR:
        (folder / own).mkdir(parents=True, exist_ok=True)
        (folder / own / "microros.yaml").write_text(application(own, text))
    (folder / "system.yaml").write_text(system_text)
    return folder


def board_program(
    folder: Path,
    own: str,
    system_text: str,
    text: str = APPLICATION,
    others: str = APPLICATION,
    waits_here: bool = False,
    source: str = "peer_board.c",
    late: bool = False,
) -> Path:
    """Build the program of a board, with a separate system file: the relay may be the other end of its link.

    `others`: what the other board has. `waits_here`: without the wait of the port, for `Board.wakes`. `source`: a
    file of tests/runtime/c. `late`: it opens its subscriptions when it is asked to.
    """
    home = written(folder / f"of_{own}", system_text, others)
    out = rendered(home / own, application(own, text))
    flags = (f'-DOWN="{own}"', f'-DOTHER="{PAIR[1 - PAIR.index(own)]}"')
    own_time = ("port_posix_time.c",) if source == "peer_board.c" else ()
    without = (*own_time, *(("port_posix_wait.c",) if waits_here else ()))
    waits = ("-DWAITS_HERE",) if waits_here else ()
    return program_of(out, source, without, (*flags, *waits, *(("-DLATE=true",) if late else ())))


class Board(CommandedProgram):
    """A process that is a board; `values` has what it received, by topic."""

    def __init__(self, program: Path, clock: int = 0) -> None:
        self.process = subprocess.Popen(
            [str(program), str(clock)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        super().__init__(self.process)
        self.values: tuple[list[int], list[int]] = ([], [])

    def spin(self, milliseconds: int = 2) -> None:
        """Let it run."""
        self.begin(f"spin {milliseconds}")
        self.heard()

    def heard(self) -> int:
        """Note what came during a command; return the number that it printed last, 0 without one."""
        _, _, lines = self.result()
        numbers = [int(line.split()[1]) for line in lines if line.startswith(COUNTS)]
        for line in lines:
            if line.startswith("got "):
                _, topic, value = line.split()
                self.values[int(topic)].append(int(value))
        return numbers[-1] if numbers else 0

    def publish(self, topic: int, value: int) -> str:
        """Publish; return the error text, empty for none."""
        return self._error(f"publish {topic} {value}")

    def publish_serialized(self, topic: int, size: int) -> str:
        """Publish so many bytes of CDR, with their header; return the error text."""
        return self._error(f"serialized {topic} {size}")

    def dropped(self) -> int:
        """Return how many messages it has dropped."""
        self.begin("dropped")
        return self.heard()

    def open(self, topic: int) -> None:
        """Open a subscription of a program that is `late`."""
        assert self._error(f"open {topic}") == ""

    def close(self, topic: int) -> None:
        """Close a subscription."""
        assert self._error(f"close {topic}") == ""

    def let_pass(self, milliseconds: int) -> None:
        """Let its time pass."""
        assert self._error(f"pass {milliseconds}") == ""

    def continue_with(self, number: int) -> None:
        """Let all streams continue with this message number; nothing is under way."""
        assert self._error(f"numbers {number}") == ""

    def reconnects(self) -> int:
        """Return how often its line has returned."""
        self.begin("reconnects")
        return self.heard()

    def _error(self, command: str) -> str:
        code, error, _ = self.call(command)
        assert bool(code) == bool(error)
        return error

    def wakes(self, topic: int, value: int) -> int:
        """Publish as another task during a wait; return how often that ended the wait."""
        self.begin(f"meanwhile {topic} {value}")
        return self.heard()

    def end(self) -> None:
        """End it in order."""
        self.begin("end")
        assert self.heard() == 0, "another session began before the end of this one"
        assert self.process.wait(10) == 0

    def kill(self) -> None:
        """End it as if it lost its supply."""
        self.process.kill()
        self.process.communicate()


class Relay:
    """Passes datagrams between two ports and their boards.

    `seen` has sender, session id and decoded form of each submessage. `fate` decides what becomes of a datagram; by
    default it arrives.
    """

    def __init__(self) -> None:
        self._sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in PAIR]
        for end in self._sockets:
            end.bind((HOST, 0))
        self.ports = [int(end.getsockname()[1]) for end in self._sockets]
        self._boards: list[tuple[str, int] | None] = [None, None]
        self.seen: list[tuple[int, int, object]] = []
        self.faults: list[str] = []
        self.fate: Fate = lambda data: (data,)
        self._passing = threading.Lock()
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Relay:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.set()
        self._thread.join(10)
        for end in self._sockets:
            end.close()

    def is_idle(self) -> bool:
        """Return whether each datagram that was sent so far has been passed on."""
        if not self._passing.acquire(blocking=False):
            return False
        try:
            return not select.select(self._sockets, [], [], 0)[0]
        finally:
            self._passing.release()

    @property
    def passed(self) -> int:
        """How many submessages it has had."""
        return len(self.seen)

    def of(self, name: str) -> list[tuple[int, int]]:
        """Return sender and session id of the submessages of a kind: `Heartbeat`."""
        return [(sender, session) for sender, session, sub in self.seen if type(sub).__name__ == name]

    def _serve(self) -> None:
        while not self._ends.is_set():
            for ready in select.select(self._sockets, [], [], 0.02)[0]:
                with self._passing:
                    self._pass_on(ready)

    def _pass_on(self, ready: socket.socket) -> None:
        sender = self._sockets.index(ready)
        data, source = ready.recvfrom(65536)
        if data.startswith(b"RTPS"):
            return  # DDS of another test looks for participants at every port of its range
        self._boards[sender] = source
        self._note(sender, data)
        target = self._boards[1 - sender]
        for passed in self.fate(data) if target else ():
            self._sockets[1 - sender].sendto(passed, target or ("", 0))

    def _note(self, sender: int, data: bytes) -> None:
        try:
            found = [decode(*span[:2], data, *span[2:]) for span in split(data, header_size(data))]
            self.seen += [(sender, data[0], submessage) for submessage in found]
        except Exception as fault:  # a thread: the test reports it
            self.faults.append(f"{data.hex()}: {fault!r}")


class Network(Protocol):
    """What boards send passes through it."""

    @property
    def passed(self) -> int:
        """How much that was so far."""

    def is_idle(self) -> bool:
        """Return whether all that was sent so far has been passed on."""


def calm(network: Network, run: Callable[[], object]) -> None:
    """Let boards `run` until nothing is under way any more: on a busy machine, a HEARTBEAT may follow much later.

    They have nothing to send by then.
    """
    end = deadline(20)
    while True:
        before = network.passed
        run()
        if network.is_idle() and network.passed == before:
            return
        assert time.monotonic() < end, "boards do not end"


def unreliable(seed: int) -> Fate:
    """Return a network that loses, repeats and reorders datagrams: one in eight each."""
    chance = random.Random(seed)
    late: list[bytes] = []

    def fate(data: bytes) -> Sequence[bytes]:
        what = chance.randrange(8)
        kept, late[:] = list(late), []
        if what == 0:
            return kept
        if what == 1:
            return (data, data, *kept)
        if what == 2:
            late.append(data)
            return kept
        return (data, *kept)

    return fate


@contextmanager
def started(program: Path, clock: int = 0) -> Iterator[Board]:
    """Start a board; end it afterwards, whatever happened."""
    board = Board(program, clock)
    try:
        yield board
    finally:
        if board.process.poll() is None:
            board.kill()


def until(seen: Callable[[], object], *boards: Board, at_most_s: float = 10) -> None:
    """Let boards run until something is true."""
    end = deadline(at_most_s)
    while not seen():
        assert time.monotonic() < end, [board.values for board in boards]
        for board in boards:
            board.spin()


def published(board: Board, topic: int, value: int) -> bool:
    """Publish; return whether it succeeded."""
    return not board.publish(topic, value)


def received(board: Board, topic: int, count: int) -> bool:
    """Return whether a board has as many messages of a topic."""
    return len(board.values[topic]) >= count
