# SPDX-License-Identifier: Apache-2.0
"""Serves while it is this server's turn, and waits while another one serves."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Protocol

from microros_gen.parameter_server.claims import AGENT, Candidate, Claim, Claims
from microros_gen.parameter_server.file import ParameterFile
from microros_gen.parameter_server.server import NODE, ParameterServer
from microros_gen.ros.peer import Peer

CLAIMING_NODE = f"_{NODE}_claim"
"""The node of a claim has another name: agents take any /microros_parameters for a server."""
DISCOVERY_S = 1.5
"""A server that somebody else runs is known by then."""
_LOOK_S = 0.2
_COUNT_S = 1.0
"""Between two looks at the graph while it serves."""
_UNCLAIMED_S = 3.0
"""A server that serves has claimed by then, if it does at all."""


class Observer(Protocol):
    """Receives the changes of who serves."""

    def waits(self, other: str) -> None:
        """Handle that another server, `other`, serves."""

    def ready(self, node: str) -> None:
        """Handle that this server serves from now on."""

    def log(self, line: str) -> None:
        """Handle a line for the log."""


class ServerInTurn:
    """`run` serves and waits until `stop`, which any thread or signal handler may call."""

    def __init__(
        self,
        rank: int,
        make_peer: Callable[[str], AbstractContextManager[Peer]],
        observer: Observer,
    ) -> None:
        """`make_peer` gives a node with a name. A server of the rank AGENT leaves nodes to servers without claims."""
        self._rank = rank
        self._make_peer = make_peer
        self._observer = observer
        self._stopped = False

    def stop(self) -> None:
        """Let `run` end within a second."""
        self._stopped = True

    def run(self, open_file: Callable[[], AbstractContextManager[ParameterFile]]) -> None:
        """Serve in turn; `open_file` gives the file for each turn. Raises as `ParameterServer` does."""
        with self._make_peer(CLAIMING_NODE) as peer:
            is_reported = False
            claims = Claims(self._rank, time.monotonic)
            turn = _Turn(peer, Candidate(peer, claims, time.monotonic, self._observer.log))
            while not self._stopped:
                turn.look()
                if turn.may_begin():
                    with open_file() as file:
                        self._serve(turn, file)
                    is_reported = False
                elif turn.other and not is_reported:
                    self._observer.waits(turn.other)
                    is_reported = True

    def _serve(self, turn: _Turn, file: ParameterFile) -> None:
        turn.candidate.set_serving(True)
        try:
            with self._make_peer(NODE) as peer:
                server = ParameterServer(peer, self._observer.log, file)
                self._observer.ready(peer.name)
                while not self._stopped and turn.goes_on():
                    server.turn()
                if not self._stopped:
                    kept = server.pending
                    left = f"; {kept} values that no node has yet stay in '{file.path}'" if kept else ""
                    self._observer.log(f"another one serves now ({turn.other}): this server waits{left}")
        finally:
            turn.candidate.set_serving(False)


class _Turn:
    """What is known of other servers: their claims, and the node of one that does not claim."""

    def __init__(self, peer: Peer, candidate: Candidate) -> None:
        self.candidate = candidate
        self.other = ""
        """Who has the turn, as far as is known; empty: nobody."""
        self._graph = peer.graph()
        self._looks_at_graph = candidate.claims.own.rank == AGENT
        self._free_since = self._alone_since = self._counted = time.monotonic()
        self._unclaimed = ""

    def look(self) -> None:
        """Look for others."""
        self.candidate.turn(_LOOK_S)
        self.other = self._leader(self.candidate.claims.leader(), own_nodes=0)
        if self.other:
            self._free_since = time.monotonic()

    def may_begin(self) -> bool:
        """Return whether nobody else has had the turn for a while."""
        return time.monotonic() - self._free_since >= DISCOVERY_S

    def goes_on(self) -> bool:
        """Return whether this server, which serves, keeps the turn."""
        self.candidate.turn(0)
        claims = self.candidate.claims
        leader = claims.leader()
        now = time.monotonic()
        if now - self._counted >= _COUNT_S:
            serving = sum(claim.serving for claim in claims.others())
            self._unclaimed, self._counted = self._leader(None, own_nodes=1 + serving), now
        if not self._unclaimed:
            self._alone_since = now
        is_long = now - self._alone_since >= _UNCLAIMED_S
        self.other = str(leader) if leader else self._unclaimed if is_long else ""
        self._free_since = now
        return not self.other

    def _leader(self, claim: Claim | None, own_nodes: int) -> str:
        if claim is not None:
            return str(claim)
        is_there = self._looks_at_graph and self._graph.nodes().count(f"/{NODE}") > own_nodes
        return f"a node /{NODE} without a claim" if is_there else ""
