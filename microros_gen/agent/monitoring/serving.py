# SPDX-License-Identifier: Apache-2.0
"""Answers questions about the status of an agent at a local socket."""

from __future__ import annotations

import os
import select
import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from microros_gen.agent.monitoring import metrics
from microros_gen.agent.monitoring.document import PATH, text_of
from microros_gen.agent.monitoring.page import PAGE
from microros_gen.agent.monitoring.sockets import listen
from microros_gen.agent.monitoring.status import AgentStatus, StatusBoard

if TYPE_CHECKING:
    from microros_gen.web.server import Answer, Routes


_TEXT = "text/plain; charset=utf-8"
NO_RESPONSE = b"the agent does not respond\n"
"""The answer to all questions while the agent's thread does not run."""


class Rendered:
    """A form of the status, which is made once for each status, however many ask for it."""

    def __init__(self, board: StatusBoard, kind: str, render: Callable[[AgentStatus], str]) -> None:
        """`kind` is the type of the content."""
        self._board = board
        self._kind = kind
        self._render = render
        self._lock = threading.Lock()
        self._of: AgentStatus | None = None
        self._content = b""

    def __call__(self) -> Answer:
        """Return the answer; status 503 if the agent does not respond."""
        from microros_gen.web.server import Answer

        status = self._board.ask()
        if status is None:
            return Answer(_TEXT, NO_RESPONSE, 503)
        with self._lock:
            if self._of is not status:
                self._of, self._content = status, self._render(status).encode()
            return Answer(self._kind, self._content)


def status_routes(board: StatusBoard) -> Routes:
    """Return the answers to questions about status and health."""
    return {**health_routes(board), PATH: Rendered(board, "application/json", text_of)}


def health_routes(board: StatusBoard) -> Routes:
    """Return whether the agent responds (`/healthz`), and whether all of its transports accept messages (`/readyz`)."""
    return {"/healthz": lambda: _health(board, False), "/readyz": lambda: _health(board, True)}


def _health(board: StatusBoard, needs_transports: bool) -> Answer:
    from microros_gen.web.server import Answer

    status = board.ask()
    if status is None:
        return Answer(_TEXT, NO_RESPONSE, 503)
    if needs_transports and status.late:
        return Answer(_TEXT, "".join(f"{line}\n" for line in status.late).encode(), 503)
    return Answer(_TEXT, b"ok\n")


def metrics_routes(board: StatusBoard) -> Routes:
    """Return the metrics of Prometheus, and the health."""
    return {**health_routes(board), metrics.PATH: Rendered(board, metrics.CONTENT_TYPE, metrics.metrics_text)}


def page_routes(board: StatusBoard) -> Routes:
    """Return the page and its data."""
    from microros_gen.web.server import Answer

    return {"/": lambda: Answer("text/html; charset=utf-8", PAGE.encode()), **status_routes(board)}


class StatusSocket:
    """A local socket at which `routes` are answered; HTTP is loaded with the first question."""

    def __init__(self, path: Path, routes: Routes) -> None:
        """Listen at `path`. Raises SocketError."""
        self.path = path
        self._routes = routes
        self._listener = listen(path)
        self._inode = path.stat().st_ino
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._stopped = threading.Event()

    def __del__(self) -> None:
        if hasattr(self, "_wake"):
            os.close(self._wake)

    def run(self) -> None:
        """Answer until `stop`; then close and remove the socket."""
        try:
            self._wait()
            if not self._stopped.is_set():
                self._serve()
        finally:
            self._listener.close()
            if self._is_own():
                self.path.unlink(missing_ok=True)

    def stop(self) -> None:
        """Let `run` return; called once, from another thread."""
        self._stopped.set()
        os.eventfd_write(self._wake, 1)

    def _serve(self) -> None:
        from microros_gen.web.server import HttpServer, anyone

        server = HttpServer(self._listener, self._routes, anyone)
        server.timeout = 0
        while not self._stopped.is_set():
            self._wait()
            server.handle_request()

    def _wait(self) -> None:
        """Wait until somebody connects, or for `stop`."""
        select.select([self._listener.fileno(), self._wake], [], [])

    def _is_own(self) -> bool:
        """Return whether the file was not replaced."""
        try:
            return self.path.stat().st_ino == self._inode
        except OSError:
            return False
