# SPDX-License-Identifier: Apache-2.0
"""A worker as its front sees it: its process, the channel to it, and when it is started again."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import time
from collections.abc import Sequence

from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.workers.channel import Channel, Kind
from microros_gen.agent.workers.report import Report

STEADY_S = 10.0
"""Seconds after which a worker that ends is started again at once."""
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.5, 30.0
"""Seconds until one that ended earlier is started again: doubled each time."""
START_S = 60.0
"""Seconds in which a worker must serve after its start; then it is ended."""
STUCK_S = 30.0
"""Seconds after which a worker that serves and does not answer is ended."""
STUCK_LOOKS = 20
"""Number of looks at which that must be so: the front itself may have been stopped meanwhile."""
IGNORED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that a worker ignores: its front passes on what they mean. It starts with them blocked."""
ENDS_S = 0.5
"""Seconds from the end of a channel to that of its process; then it is killed."""


class WorkerProcess:
    """One worker, which is started, asked, and started again."""

    def __init__(
        self, number: int, command: Sequence[str], shared: Sequence[int], start: bytes, log: EventLog
    ) -> None:
        """Prepare worker `number` (from 1).

        `command` is run with the descriptors `shared`, `start` on its standard input, and the descriptor of its end of
        the channel as last argument.
        """
        self.number = number
        self._command = command
        self._shared = tuple(shared)
        self.start_data = start
        """What the next process gets on its standard input."""
        self.failure = ""
        """Why it could not start again, as the log says; empty: it could."""
        self._log = log
        self._process: subprocess.Popen[bytes] | None = None
        self.channel: Channel | None = None
        self.ready = False
        self.late = False
        """Whether a view of the clients was taken without its answer."""
        self.report = Report()
        """Its last report."""
        self.restarts = 0
        self._started_at = 0.0
        self._start_at: float | None = None
        self._pause_s = 0.0
        self._asked_at: float | None = None
        self._stuck = 0

    @property
    def pid(self) -> int:
        """The number of its process; 0: none runs."""
        return self._process.pid if self._process is not None else 0

    @property
    def answers(self) -> bool:
        """Whether it serves, and answers in time."""
        return self.ready and not self.late

    def start(self) -> Channel:
        """Start the process; return the channel to it. Raises OSError."""
        own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
        with other:
            try:
                channel = Channel(own)
                self._process = self._run(other)
            except OSError:
                own.close()
                raise
        self.channel = channel
        self._started_at = time.monotonic()
        self._start_at = self._asked_at = None
        self.ready = False
        self.report = Report()
        return self.channel

    def _run(self, other: socket.socket) -> subprocess.Popen[bytes]:
        with os.fdopen(os.memfd_create("worker"), "w+b") as file:
            file.write(self.start_data)
            file.flush()
            file.seek(0)
            # Until it ignores them they wait: a service manager signals all processes of a service that it stops.
            before = signal.pthread_sigmask(signal.SIG_BLOCK, IGNORED)
            try:
                return subprocess.Popen(
                    [*self._command, str(other.fileno())],
                    stdin=file,
                    stdout=2,  # stdout of the agent has the ready lines alone
                    pass_fds=(other.fileno(), *self._shared),
                    start_new_session=True,  # Ctrl-C is for the front, which lets its workers end in order
                )
            finally:
                signal.pthread_sigmask(signal.SIG_SETMASK, before)

    def put_off(self, now: float) -> None:
        """Start it again after a pause, because this was not possible now."""
        self.kill()
        self._plan(now, steady=False)

    def ask(self, now: float, states: bool) -> None:
        """Ask for a report, with the states of all clients if `states`."""
        if self.channel is not None and self.ready:
            self.channel.send(Kind.ASK, b"1" if states else b"")
            if self._asked_at is None:
                self._asked_at = now

    def answered(self, report: Report) -> None:
        """Take a report."""
        self.report = report
        self._asked_at = None
        self.late = False
        self._stuck = 0

    def is_due(self, now: float) -> bool:
        """Return whether it is to be started again now."""
        return self._start_at is not None and now >= self._start_at

    def look(self, now: float) -> None:
        """End the process if it has not answered, or does not serve, for a long time."""
        since, wait_s = (self._asked_at, STUCK_S) if self.ready else (self._started_at, START_S)
        self._stuck = self._stuck + 1 if since is not None and now - since > wait_s else 0
        if self._stuck >= STUCK_LOOKS and self._process is not None:
            text = "worker {worker} has not answered for {seconds} s: it is ended"
            self._log.emit(Level.WARNING, "worker_stuck", text, worker=self.number, seconds=wait_s)
            self._process.kill()
            self._stuck = 0

    def ended(self, now: float) -> str:
        """Note that the channel was closed; return how the process ended, which is waited for."""
        if self.channel is not None:
            self.channel.close()
        self.channel = None
        self.ready = self.late = False
        how = self._wait()
        self._plan(now, steady=now - self._started_at >= STEADY_S)
        self.restarts += 1
        return how

    def _plan(self, now: float, steady: bool) -> None:
        self._pause_s = 0.0 if steady else min(max(2 * self._pause_s, FIRST_PAUSE_S), LONGEST_PAUSE_S)
        self._start_at = now + self._pause_s

    def kill(self) -> None:
        """End the process at once, if it runs."""
        if self.channel is not None:
            self.channel.close()
            self.channel = None
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None

    def _wait(self) -> str:
        process, self._process = self._process, None
        if process is None:
            return ""
        try:
            status = process.wait(ENDS_S)  # it has closed its end, so it ends now
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        return f"signal {signal.Signals(-status).name}" if status < 0 else f"status {status}"
