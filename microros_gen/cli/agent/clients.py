# SPDX-License-Identifier: Apache-2.0
"""The view of clients in ROS 2, from inside the agent: `--client-state`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from microros_gen.agent.core import Agent
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.state_node import NODE, StateNode
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.ros_node import node_of
from microros_gen.diagnostics import Diagnostic
from microros_gen.ros.peer import Peer


@contextmanager
def client_state_node(
    wanted: bool, agent: Agent, domain: int | None, most: int, log: EventLog
) -> Iterator[None]:
    """Serve from a thread while the block runs, where `wanted`; `domain` None: ROS_DOMAIN_ID.

    The node has its own context. `most`: clients of the agent. UserError: it cannot be made.
    """
    if not wanted:
        yield
        return
    with _peer(domain) as peer:
        node = StateNode(
            peer,
            agent.latest_client_states,
            2 * most,
            lambda line: log.emit(Level.WARNING, "client_state", "client state: {reason}", reason=line),
        )
        with in_background("client state", node.run, node.stop):
            log.emit(Level.INFO, "client_state_ready", "client state ready: {node}", node=peer.name)
            yield


def _peer(domain: int | None) -> Peer:
    return node_of(
        NODE,
        domain,
        lambda error: Diagnostic(f"the client state {error.reason}", hint=error.hint, id="MG-9725"),
    )
