# SPDX-License-Identifier: Apache-2.0
"""What serves on the node of a peer: turn by turn, in one thread, until it is stopped from another one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

from microros_gen.ros.errors import CodecError, RosError
from microros_gen.ros.peer import Peer


class Serving(ABC):
    """Serves in the thread that calls `run`, or `turn` again and again."""

    def __init__(self, peer: Peer, report: Callable[[str], object]) -> None:
        """`report` gets a line about each request or message that could not be served."""
        self._peer = peer
        self._report = report
        self._stop = False

    def run(self) -> None:
        """Serve until `stop`."""
        while not self._stop:
            self.turn()

    @property
    def is_stopped(self) -> bool:
        """Return whether `stop` was called."""
        return self._stop

    def stop(self) -> None:
        """Let `run` end after its turn; any thread may call it."""
        self._stop = True

    @abstractmethod
    def turn(self) -> None:
        """Wait for requests and messages, for less than a second, and serve them."""

    def _spin(self, wait_s: float) -> None:
        """Wait for at most `wait_s` seconds, and serve what has arrived."""
        self._attempt(lambda: self._peer.spin_once(max(0.0, wait_s)))

    def _attempt(self, work: Callable[[], object]) -> None:
        """Work on one request or message; if that fails, report it and continue with the others."""
        try:
            work()
        except (CodecError, RosError) as error:
            self._report(str(error))
