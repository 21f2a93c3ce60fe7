# SPDX-License-Identifier: Apache-2.0
"""The life cycle of one node over its services (lifecycle_msgs)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.ros.graph import Names
from microros_gen.ros.peer import Peer
from microros_gen.ros_tools.calls import ask

GET_STATE = "lifecycle_msgs/srv/GetState"
_GET_STATE = "/get_state"
Described = Mapping[str, Any]
"""A lifecycle_msgs/msg/TransitionDescription."""


class NodeLifecycle:
    """The life cycle services of a node. Calls raise RosError if the node does not answer in time (`calls`)."""

    def __init__(self, peer: Peer, node: str) -> None:
        """Use the services of `node`, a fully qualified name."""
        self._peer = peer
        self._node = node

    def state(self) -> tuple[str, int]:
        """Return label and number of the current state."""
        state = ask(self._peer, self._node, "get_state", GET_STATE, {})["current_state"]
        return state["label"], state["id"]

    def transitions(self, all_states: bool = False) -> list[Described]:
        """Return the transitions from the current state, or from all states."""
        service = "get_transition_graph" if all_states else "get_available_transitions"
        response = ask(self._peer, self._node, service, "lifecycle_msgs/srv/GetAvailableTransitions", {})
        return list(response["available_transitions"])

    def change(self, transition: Mapping[str, Any]) -> bool:
        """Request a transition (lifecycle_msgs/msg/Transition); return whether it succeeded."""
        request = {"transition": dict(transition)}
        return bool(
            ask(self._peer, self._node, "change_state", "lifecycle_msgs/srv/ChangeState", request)["success"]
        )


def lifecycle_nodes(services: Names) -> tuple[str, ...]:
    """Return the nodes with a life cycle: those that serve `~/get_state`, sorted."""
    return tuple(
        sorted(
            name.removesuffix(_GET_STATE)
            for name, types in services
            if GET_STATE in types and name.endswith(_GET_STATE)
        )
    )
