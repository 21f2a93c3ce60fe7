# SPDX-License-Identifier: Apache-2.0
"""The status of the agent for people and programs outside of ROS, from inside the agent."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from microros_gen import __version__
from microros_gen.agent.compiled import core_kind
from microros_gen.agent.configuration.model import NamedPath
from microros_gen.agent.core import Agent
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.monitoring import metrics
from microros_gen.agent.monitoring.serving import StatusSocket, metrics_routes, page_routes, status_routes
from microros_gen.agent.monitoring.sockets import SocketError, default_path
from microros_gen.agent.monitoring.status import AgentStatus, StatusBoard, TransportState, WorkerState
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.workers.front import Front
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.agent.options import NO_SOCKET, AgentOptions
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.web.places import Place, read_place

if TYPE_CHECKING:
    from microros_gen.web.server import Answer, Routes


_PATHS = {"metrics": metrics.PATH.lstrip("/"), "page": ""}


@contextmanager
def monitoring(
    options: AgentOptions, agent: Agent | Front, transports: Sequence[Transport], log: EventLog
) -> Iterator[None]:
    """Answer questions in threads while the block runs, where the options ask for it. Raises UserError."""
    board = StatusBoard(_Observer(options, agent, transports, log))
    agent.on_care = board.look
    with ExitStack() as stack:
        status = _status_socket(options.status_socket, board, log)
        if status is not None:
            stack.enter_context(in_background("status", status.run, status.stop))
            log.emit(Level.INFO, "status_ready", "status: {socket}", socket=str(status.path))
        addresses = stack.enter_context(serve_pages(options, board))
        if "metrics" in addresses:
            log.emit(Level.INFO, "metrics_ready", "metrics: {address}", address=addresses["metrics"])
        if "page" in addresses:
            log.emit(Level.INFO, "page_ready", "page: {address}", address=addresses["page"])
        yield


@contextmanager
def serve_pages(options: AgentOptions, board: StatusBoard) -> Iterator[dict[str, str]]:
    """Serve `metrics` and `page` within the context, from one server where both have the same address.

    Give the address of each. Raises UserError.
    """
    places = checked_places(options)
    routes: dict[Place, dict[str, Callable[[], Answer]]] = {}
    for name, (_, place) in places.items():
        answers = metrics_routes(board) if name == "metrics" else page_routes(board)
        routes.setdefault(place, {}).update(answers)
    with ExitStack() as stack:
        urls: dict[Place, str] = {}
        for name, (named, place) in places.items():
            if place not in urls:
                urls[place] = stack.enter_context(_served(name, named, place, routes[place]))
        yield {name: urls[place] + _PATHS[name] for name, (_, place) in places.items()}


def checked_places(options: AgentOptions) -> dict[str, tuple[NamedPath, Place]]:
    """Return the addresses of `metrics` and `page`, as far as the options have them. Raises UserError."""
    diagnostics = Diagnostics()
    places: dict[str, tuple[NamedPath, Place]] = {}
    for name, named in (("metrics", options.metrics), ("page", options.page)):
        place = read_place(named.path) if named is not None else None
        if named is not None and place is None:
            message = f"'{named.path}' is no address for the {name}"
            diagnostics.error(message, named.span, "Write 127.0.0.1:9464, or a port alone", id="MG-9791")
        elif named is not None and place is not None:
            places[name] = named, place
    diagnostics.check()
    return places


@contextmanager
def _served(name: str, named: NamedPath, place: Place, routes: Routes) -> Iterator[str]:
    from microros_gen.web.server import served

    with ExitStack() as stack:
        try:
            address = stack.enter_context(served(place, routes))
        except OSError as error:
            message = f"the {name} cannot be served at '{named.path}': {error.strerror or error}"
            hint = "Choose another address or port; port 0 is a free one"
            raise UserError([Diagnostic(message, named.span, hint, id="MG-9792")]) from error
        yield address


def _status_socket(named: str | None, board: StatusBoard, log: EventLog) -> StatusSocket | None:
    """Return the socket; None if it is not wanted, or a default one is not possible."""
    if named == NO_SOCKET:
        return None
    routes = status_routes(board)
    if named is not None:
        try:
            return StatusSocket(Path(named), routes)
        except SocketError as error:
            message = f"the status socket {named} cannot be made: {error}"
            hint = "Choose another path, or --status-socket none"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9788")]) from error
    try:
        return StatusSocket(default_path(), routes)
    except SocketError as error:
        text = "`microros-gen agent status` cannot ask this agent: no status socket: {reason}"
        log.emit(Level.WARNING, "status_socket", text, reason=str(error))
        return None


class _Observer:
    """Takes the status of an agent."""

    def __init__(
        self, options: AgentOptions, agent: Agent | Front, transports: Sequence[Transport], log: EventLog
    ) -> None:
        self._options = options
        self._agent = agent
        self._transports = transports
        self._log = log
        self._started, self._started_at = time.time(), time.monotonic()

    def __call__(self) -> AgentStatus | None:
        """Return the status, None until all workers have answered; called in the agent's thread."""
        workers: tuple[WorkerState, ...] = ()
        faults = dict(self._log.counters)
        if isinstance(self._agent, Front):
            if not self._agent.has_new_view():
                return None
            workers = tuple(WorkerState(w.number, w.pid, w.answers, w.restarts) for w in self._agent.workers)
            faults = self._agent.faults
        labels = [(*transport.label.partition(" ")[::2], transport.ready) for transport in self._transports]
        return AgentStatus(
            pid=os.getpid(),
            version=__version__,
            core=core_kind(),
            started=self._started,
            now=time.time(),
            uptime_s=time.monotonic() - self._started_at,
            domain=self._options.domain,
            transports=tuple(TransportState(*label) for label in labels),
            clients_max=self._options.limits.clients * max(1, len(workers)),
            from_clients=self._agent.samples,
            to_clients=self._agent.delivered,
            clients=self._agent.client_states(),
            faults=faults,
            workers=workers,
        )
