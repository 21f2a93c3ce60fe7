# SPDX-License-Identifier: Apache-2.0
"""A parameter server inside the agent, from when a client has parameters that one holds."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from microros_gen.agent.log import EventLog, Level
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.parameter_server import parameter_peer, usual_file
from microros_gen.diagnostics import UserError
from microros_gen.parameter_server.claims import AGENT
from microros_gen.parameter_server.file import FileInUseError, ParameterFile
from microros_gen.parameter_server.server import NODE
from microros_gen.parameter_server.turns import ServerInTurn
from microros_gen.ros.errors import RosError

NOTICE = "microros_parameter_msgs/msg/Notice"
"""Type of an endpoint that only clients with such parameters have."""
_FILE_S = 5.0
"""Between two looks whether the file is free."""


class ParametersOnDemand:
    """Starts when a client has an endpoint of a type that only clients with such parameters have."""

    def __init__(self, allowed: bool, file: Path | None, domain: int | None, log: EventLog) -> None:
        """Prepare it. `allowed`: it may start; `domain` None: ROS_DOMAIN_ID; `file` None: the default of the domain."""
        self._allowed = allowed
        self._file = file or usual_file(domain)
        self._log = log
        self._wanted = threading.Event()
        self._stopped = threading.Event()
        self._server = ServerInTurn(AGENT, lambda name: parameter_peer(name, domain), self)

    def on_type(self, type_name: str) -> None:
        """Take the type of an endpoint of a client."""
        if type_name == NOTICE:
            self._wanted.set()

    @contextmanager
    def running(self) -> Iterator[None]:
        """Serve from a thread while the block runs, as soon as it is needed."""
        if not self._allowed:
            yield
            return
        with in_background("parameter server", self._run, self._end):
            yield

    def _end(self) -> None:
        self._stopped.set()
        self._wanted.set()
        self._server.stop()

    def _run(self) -> None:
        self._wanted.wait()
        is_reported = False
        while not self._stopped.is_set():
            try:
                self._server.run(lambda: closing(ParameterFile(self._file)))
            except FileInUseError as error:
                if not is_reported:
                    self._report(error)
                is_reported = True
                self._stopped.wait(_FILE_S)
                continue
            except UserError as error:
                self._report(error)
            except RosError as error:
                self.log(str(error))
            return

    def waits(self, other: str) -> None:
        """Report that another server serves."""
        text = "parameters are held by another /{node}: {server}"
        self._log.emit(Level.INFO, "parameter_server_other", text, node=NODE, server=other)

    def ready(self, node: str) -> None:
        """Report that this one serves."""
        text, file = "parameter server ready: {node}, values in {file}", str(self._file)
        self._log.emit(Level.INFO, "parameter_server_ready", text, node=node, file=file)

    def log(self, line: str) -> None:
        """Report a line of the server."""
        self._log.emit(Level.WARNING, "parameter_server", "parameter server: {reason}", reason=line)

    def _report(self, error: UserError) -> None:
        for diagnostic in error.diagnostics:
            self.log(f"{diagnostic.message}. {diagnostic.hint or ''}".rstrip())
