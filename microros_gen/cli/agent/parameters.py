# SPDX-License-Identifier: Apache-2.0
"""A parameter server inside the agent, from when a client has parameters that one holds."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from microros_gen.agent.log import EventLog, Level
from microros_gen.cli.parameter_server import parameter_peer, usual_file
from microros_gen.diagnostics import UserError
from microros_gen.parameter_server.file import ParameterFile
from microros_gen.parameter_server.server import NODE, ParameterServer
from microros_gen.ros.errors import RosError

_NOTICE = "microros_parameter_msgs/msg/Notice"
_LOOKING_NODE = f"_{NODE}_of_agent"
_DISCOVERY_S = 1.5
"""A server that somebody else runs is known by then."""
_LOOK_S = 0.2


class ParametersOnDemand:
    """Starts when a client has an endpoint of a type that only clients with such parameters have."""

    def __init__(self, allowed: bool, file: Path | None, domain: int | None, log: EventLog) -> None:
        """`allowed`: it may start. `domain` None: ROS_DOMAIN_ID; `file` None: the usual one of the domain."""
        self._allowed = allowed
        self._file = file or usual_file(domain)
        self._domain = domain
        self._log = log
        self._wanted = threading.Event()
        self._stopped = threading.Event()
        self._server: ParameterServer | None = None

    def on_type(self, type_name: str) -> None:
        """Take the type of an endpoint of a client."""
        if type_name == _NOTICE:
            self._wanted.set()

    @contextmanager
    def running(self) -> Iterator[None]:
        """Serve from a thread while the block runs, as soon as it is needed."""
        if not self._allowed:
            yield
            return
        thread = threading.Thread(target=self._run, name="parameter server", daemon=True)
        thread.start()
        try:
            yield
        finally:
            self._stopped.set()
            self._wanted.set()
            if self._server is not None:
                self._server.stop()
            thread.join()

    def _run(self) -> None:
        self._wanted.wait()
        if self._stopped.is_set():
            return
        try:
            self._wait_for_others()
            if not self._stopped.is_set():
                self._serve()
        except UserError as error:
            for diagnostic in error.diagnostics:
                self._report(f"{diagnostic.message}. {diagnostic.hint or ''}".rstrip())
        except RosError as error:
            self._report(str(error))

    def _wait_for_others(self) -> None:
        """Return when no other server has been there for a while."""
        is_reported = False
        with parameter_peer(_LOOKING_NODE, self._domain) as peer:
            graph, free_since = peer.graph(), time.monotonic()
            while not self._stopped.is_set() and time.monotonic() - free_since < _DISCOVERY_S:
                peer.spin_once(_LOOK_S)
                if f"/{NODE}" in graph.nodes():
                    free_since = time.monotonic()
                    if not is_reported:
                        text = "parameters are held by another /{node}"
                        self._log.emit(Level.INFO, "parameter_server_other", text, node=NODE)
                    is_reported = True

    def _serve(self) -> None:
        with closing(ParameterFile(self._file)) as kept, parameter_peer(NODE, self._domain) as peer:
            self._server = ParameterServer(peer, self._report, kept)
            if self._stopped.is_set():
                return
            text, file = "parameter server ready: {node}, values in {file}", str(self._file)
            self._log.emit(Level.INFO, "parameter_server_ready", text, node=peer.name, file=file)
            self._server.run()

    def _report(self, line: str) -> None:
        self._log.emit(Level.WARNING, "parameter_server", "parameter server: {reason}", reason=line)
