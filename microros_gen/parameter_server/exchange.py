# SPDX-License-Identifier: Apache-2.0
"""The requests to one node: a session, its pages, and sets; one request is on its way at a time."""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value

BEGIN, LIST, LIST_CHANGES, ACKNOWLEDGE, SET = range(5)
"""`what` of microros_parameter_msgs/srv/Exchange."""
OK, OTHER_BOARD, OTHER_SESSION, OLD = range(4)
"""Its `status`."""
ANSWER_S = 2.0
"""Longest wait for a response: below the patience of those who set parameters."""
FIRST_RETRY_S, LAST_RETRY_S = 1.0, 30.0
"""Until a node that did not answer is asked again; twice as long each time."""
SETTLE_S = 0.1
"""From the discovery of a node's service to the first request: see `ros.endpoints`."""
_LOOK_S = 0.2
"""Between two looks whether a node is there that announced itself."""
_SAME_S = 60.0
"""Between two lines about boards that have the same node."""
_SESSIONS_AT_ONCE, _SESSIONS_S = 4, 10.0
"""So many sessions that end within so many seconds mean that another server begins its own."""

Done = Callable[["Outcome | None"], object]


@dataclass(frozen=True)
class Outcome:
    """What a node said to a set."""

    successful: bool
    reason: str


class Line(Protocol):
    """The way to a node."""

    def send(self, request: Value, done: Callable[[Value], object]) -> int:
        """Send; `done` gets each response until the number that this returns is forgotten."""

    def forget(self, number: int) -> None:
        """Ignore further responses."""

    def available(self) -> bool:
        """Return whether the node is there."""

    def size(self, request: Value) -> int:
        """Return the bytes of a request without its encapsulation header."""


class Owner(Protocol):
    """What an exchange tells."""

    def listed(self, items: Sequence[Mapping[str, Any]], complete: bool) -> None:
        """Take what the node has; all of it where `complete`."""

    def log(self, text: str) -> None:
        """Take a line for the log."""


@dataclass(frozen=True)
class _Job:
    parameters: list[Value]
    done: Done


class Exchange:
    """Not thread-safe; `step` is called again and again, and after each response."""

    def __init__(self, line: Line, owner: Owner, clock: Callable[[], float]) -> None:
        """`clock` gives seconds and never goes back."""
        self._line = line
        self._owner = owner
        self._clock = clock
        self.board = 0
        self.session = 0
        self._number = 0
        self._sent: tuple[int, int, float] | None = None
        self._working: Callable[[Value], None] = self._begun
        self._is_open = False
        self._jobs: deque[_Job] = deque()
        self._items: list[Mapping[str, Any]] = []
        self._first: int | None = None
        self._lists_changes = False
        self._revision = 0
        self._acknowledges: int | None = None
        self._known = 0
        self._request_size = 0
        self._wants_begin = self._wants_changes = False
        self._retry_at, self._retry_s = 0.0, FIRST_RETRY_S
        self._ended: deque[float] = deque()
        self._available_since: float | None = None
        self._other_board = 0
        self._reported_at = -_SAME_S

    @property
    def is_open(self) -> bool:
        """Return whether the node answers, as far as is known."""
        return self._is_open

    def notice(self, board: int, session: int, revision: int) -> None:
        """Take what a node published about itself."""
        if self._is_open and board != self.board:
            self._other_board = board
            self._wants_changes = True  # does the one that is known still answer?
        elif not self._is_open or session != self.session:
            if board != self.board or not self._is_beginning:
                self._begin(board)
        elif revision != self._known:
            self._wants_changes = True
        self.step()

    def set(self, parameters: list[Value], done: Done) -> None:
        """Have the node set all of them or none; `done` gets None where it does not answer in time."""
        if self._is_open or self._is_beginning:
            self._jobs.append(_Job(parameters, done))
            self.step()
        else:
            done(None)

    def list_again(self) -> None:
        """Have the node list everything."""
        self._begin(self.board)

    def step(self) -> None:
        """Send what is due, and give up what was not answered."""
        now = self._clock()
        is_available = self.board != 0 and self._line.available()
        self._available_since = (
            None if not is_available else now if self._available_since is None else self._available_since
        )
        if (self._sent is not None and now >= self._sent[2]) or (self._is_open and not is_available):
            self._lose()
        if self.board and not (self._is_open or self._is_beginning) and now >= self._retry_at:
            self._wants_begin = True
        if self._sent is None:
            self._send_next(now)

    def next_s(self) -> float:
        """Return when `step` has something to do at the latest, by the clock."""
        if self._sent is not None:
            return self._sent[2]
        if self._wants_begin:
            return self._clock() + (SETTLE_S if self._available_since is not None else _LOOK_S)
        return self._retry_at if self.board and not self._is_open else float("inf")

    @property
    def _is_beginning(self) -> bool:
        return self._wants_begin or self._sent is not None

    def _begin(self, board: int) -> None:
        if self._sent is not None:
            self._line.forget(self._sent[0])
            self._sent = None
        self.board = board
        self._is_open = False
        self._wants_begin = True

    def _send_next(self, now: float) -> None:
        if self._wants_begin:
            if self._available_since is None or now < self._available_since + SETTLE_S:
                return
            self._wants_begin = self._wants_changes = False
            self.session = random.randrange(1, 1 << 32)
            self._number, self._items, self._lists_changes, self._acknowledges = 0, [], False, None
            self._send(BEGIN, self._begun)
        elif not self._is_open:
            return
        elif self._first is not None:
            what = LIST_CHANGES if self._lists_changes else LIST
            self._send(what, self._paged, first=self._first)
        elif self._send_job():  # before ACKNOWLEDGE: so the node knows which of its changes are overruled
            pass
        elif self._acknowledges is not None:
            self._send(ACKNOWLEDGE, self._acknowledged, revision=self._acknowledges)
        elif self._wants_changes:
            self._wants_changes, self._items, self._lists_changes = False, [], True
            self._send(LIST_CHANGES, self._begun)

    def _send_job(self) -> bool:
        while self._jobs:
            job = self._jobs[0]
            request = {"parameters": job.parameters}
            if self._line.size(request) <= self._request_size:
                self._send(SET, self._was_set, **request)
                return True
            self._jobs.popleft()
            job.done(Outcome(False, "the request is too large, none of it was set"))
        return False

    def _send(self, what: int, working: Callable[[Value], None], **members: Any) -> None:
        self._number += 1
        request = {
            "what": what,
            "board": self.board,
            "session": self.session,
            "number": self._number,
            **members,
        }
        self._working = working
        number = self._line.send(request, self._answered)
        self._sent = (number, self._number, self._clock() + ANSWER_S)

    def _answered(self, response: Value) -> None:
        if self._sent is None or response["number"] != self._sent[1]:
            return
        if response["board"] != self.board:
            self._other_board = response["board"]
            return
        if self._other_board:
            self._report_two_boards()
        self._line.forget(self._sent[0])
        self._sent = None
        if response["status"] != OK:
            self._end_session()
        else:
            self._retry_s = FIRST_RETRY_S
            self._working(response)
        self.step()

    def _report_two_boards(self) -> None:
        boards, self._other_board = f"0x{self.board:08X} and 0x{self._other_board:08X}", 0
        if self._clock() >= self._reported_at + _SAME_S:
            self._reported_at = self._clock()
            self._owner.log(f"two boards have this node: {boards}; the first is served, rename one")

    def _end_session(self) -> None:
        now = self._clock()
        self._ended.append(now)
        while self._ended[0] < now - _SESSIONS_S:
            self._ended.popleft()
        if len(self._ended) >= _SESSIONS_AT_ONCE:
            self._ended.clear()
            self._owner.log("another parameter server also queries this node: stop one of them")
            self._lose()
            return
        self._begin(self.board)

    def _begun(self, response: Value) -> None:
        self._is_open = True
        self._revision = response["revision"]
        self._request_size = response["request_size"]
        self._paged(response)

    def _paged(self, response: Value) -> None:
        self._items += response["parameters"]
        stuck = not response["parameters"] and response["next"] < response["total"]
        if stuck:
            self._owner.log(f"parameter {response['next']} of the node does not fit its own response")
        self._first = response["next"] + (1 if stuck else 0)
        if self._first < response["total"]:
            return
        self._first, items, self._items = None, self._items, []
        self._known = self._acknowledges = self._revision
        self._owner.listed(items, complete=not self._lists_changes)

    def _acknowledged(self, response: Value) -> None:
        self._acknowledges = None
        self._look(response)

    def _was_set(self, response: Value) -> None:
        job = self._jobs.popleft()
        job.done(Outcome(response["successful"], response["reason"]))
        self._look(response)

    def _look(self, response: Value) -> None:
        """Ask for changes that the node made since."""
        self._wants_changes = self._wants_changes or response["revision"] != self._known

    def _lose(self) -> None:
        """Take the node for one that is away."""
        if self._sent is not None:
            self._line.forget(self._sent[0])
        self._sent, self._first, self._is_open = None, None, False
        self._retry_at = self._clock() + self._retry_s
        self._retry_s = min(LAST_RETRY_S, 2 * self._retry_s)
        jobs, self._jobs = self._jobs, deque()
        if self._other_board:
            other, self._other_board = self._other_board, 0
            self._begin(other)
        for job in jobs:
            job.done(None)
