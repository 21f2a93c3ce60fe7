# SPDX-License-Identifier: Apache-2.0
"""The view of clients in ROS 2, from inside the agent: `--client-state`."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from microros_gen.agent.core import Agent
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.state_node import NODE, StateNode
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.ros.errors import RosUnusableError
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
        thread = threading.Thread(target=node.run, name="client state", daemon=True)
        thread.start()
        log.emit(Level.INFO, "client_state_ready", "client state ready: {node}", node=peer.name)
        try:
            yield
        finally:
            node.stop()
            thread.join()


def _peer(domain: int | None) -> Peer:
    try:
        return Peer(NODE, domain=domain)
    except RosUnusableError as error:
        raise UserError(
            [Diagnostic(f"the client state {error.reason}", hint=error.hint, id="MG-9725")]
        ) from error
