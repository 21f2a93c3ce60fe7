# SPDX-License-Identifier: Apache-2.0
"""The view of clients in ROS 2, from inside the agent: `--client-state` and `--diagnostics`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from microros_gen.agent.client_diagnostics import DiagnosticsPublisher
from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.state_node import NODE, StateNode, StatePublisher, States
from microros_gen.agent.workers.front import Front
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.ros_node import node_of
from microros_gen.diagnostics import Diagnostic
from microros_gen.ros.peer import Peer


@contextmanager
def client_state_node(
    options: AgentOptions, limits: Limits, agent: Agent | Front, log: EventLog
) -> Iterator[None]:
    """Publish from a thread while the block runs, where the options ask for it.

    The node has its own context, in the domain of the options, otherwise of ROS_DOMAIN_ID. Raises UserError if it
    cannot be made.
    """
    if not options.watches_clients:
        yield
        return
    with _peer(options.domain) as peer:
        publishers: list[Callable[[States, float], object]] = []
        if options.client_state:
            publishers.append(
                StatePublisher(peer, agent.latest_client_states, 2 * limits.clients * options.workers)
            )
        if options.diagnostics:
            publishers.append(DiagnosticsPublisher(peer, limits.client_timeout_s))
        node = StateNode(
            peer,
            agent.latest_client_states,
            publishers,
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
