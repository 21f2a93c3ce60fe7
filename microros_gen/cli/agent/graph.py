# SPDX-License-Identifier: Apache-2.0
"""A graph server inside the agent: `--graph-server`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from microros_gen.agent.log import EventLog, Level
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.graph_server import graph_peer
from microros_gen.graph_server.server import GraphServer


@contextmanager
def graph_server(wanted: bool, domain: int | None, log: EventLog) -> Iterator[None]:
    """Serve from a thread while the block runs, where `wanted`; `domain` None: ROS_DOMAIN_ID.

    The server has its own ROS node and context. UserError: it cannot have them.
    """
    if not wanted:
        yield
        return
    with graph_peer(domain) as peer:
        server = GraphServer(
            peer, lambda line: log.emit(Level.WARNING, "graph_server", "graph server: {reason}", reason=line)
        )
        with in_background("graph server", server.run, server.stop):
            log.emit(Level.INFO, "graph_server_ready", "graph server ready: {node}", node=peer.name)
            yield
