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
from microros_gen.agent.configuration.model import NamedPath
from microros_gen.agent.core import Agent
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.monitoring import metrics
from microros_gen.agent.monitoring.serving import StatusSocket, metrics_routes, page_routes, status_routes
from microros_gen.agent.monitoring.sockets import SocketError, default_path
from microros_gen.agent.monitoring.status import AgentStatus, StatusBoard, TransportState
from microros_gen.agent.transport.base import Transport
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.agent.options import NO_SOCKET, AgentOptions
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.web.places import Place, read_place

if TYPE_CHECKING:
    from microros_gen.web.server import Answer


@contextmanager
def monitoring(
    options: AgentOptions, agent: Agent, transports: Sequence[Transport], log: EventLog
) -> Iterator[None]:
    """Answer questions in threads while the block runs, where the options ask for it. Raises UserError."""
    board = StatusBoard(_Observer(options, agent, transports, log))
    agent.on_care = board.look
    with ExitStack() as stack:
        status = _status_socket(options.status_socket, board, log)
        if status is not None:
            stack.enter_context(in_background("status", status.run, status.stop))
            log.emit(Level.INFO, "status_ready", "status: {socket}", socket=str(status.path))
        for event, name, address in stack.enter_context(serve_pages(options, board)):
            log.emit(Level.INFO, event, name + ": {address}", address=address)
        yield


@contextmanager
def serve_pages(options: AgentOptions, board: StatusBoard) -> Iterator[list[tuple[str, str, str]]]:
    """Serve metrics and page within the context, from one server where both have the same address.

    Give the event, the name and the address of each. Raises UserError.
    """
    wanted = (
        ("metrics_ready", "metrics", options.metrics, metrics_routes(board), metrics.PATH.lstrip("/")),
        ("page_ready", "page", options.page, page_routes(board) if options.page else {}, ""),
    )
    diagnostics = Diagnostics()
    routes: dict[Place, dict[str, Callable[[], Answer]]] = {}
    found: list[tuple[str, str, NamedPath, Place, str]] = []
    for event, name, named, answers, path in wanted:
        if named is None:
            continue
        place = read_place(named.path)
        if place is None:
            message = f"'{named.path}' is no address for the {name}"
            diagnostics.error(message, named.span, "Write 127.0.0.1:9464, or a port alone", id="MG-9791")
            continue
        routes.setdefault(place, {}).update(answers)
        found.append((event, name, named, place, path))
    diagnostics.check()
    with ExitStack() as stack:
        urls: dict[Place, str] = {}
        for _, name, named, place, _ in found:
            if place in urls:
                continue
            try:
                from microros_gen.web.server import served

                urls[place] = stack.enter_context(served(place, routes[place]))
            except OSError as error:
                message = f"the {name} cannot be served at '{named.path}': {error.strerror or error}"
                hint = "Choose another address or port; port 0 is a free one"
                raise UserError([Diagnostic(message, named.span, hint, id="MG-9792")]) from error
        yield [(event, name, urls[place] + path) for event, name, _, place, path in found]


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
        self, options: AgentOptions, agent: Agent, transports: Sequence[Transport], log: EventLog
    ) -> None:
        self._options = options
        self._agent = agent
        self._transports = transports
        self._log = log
        self._started, self._started_at = time.time(), time.monotonic()

    def __call__(self) -> AgentStatus:
        """Return the status; called in the agent's thread."""
        labels = [(*transport.label.partition(" ")[::2], transport.ready) for transport in self._transports]
        return AgentStatus(
            pid=os.getpid(),
            version=__version__,
            started=self._started,
            now=time.time(),
            uptime_s=time.monotonic() - self._started_at,
            domain=self._options.domain,
            transports=tuple(TransportState(*label) for label in labels),
            clients_max=self._options.limits.clients,
            from_clients=self._agent.samples,
            to_clients=self._agent.delivered,
            clients=self._agent.client_states(),
            faults=dict(self._log.counters),
        )
