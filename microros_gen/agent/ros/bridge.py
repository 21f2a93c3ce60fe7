# SPDX-License-Identifier: Apache-2.0
"""What the agent needs of ROS 2. Everything else of the agent works, and is tested, without ROS."""

from __future__ import annotations

from typing import Protocol

from microros_gen.agent.representation.description import Qos, Topic
from microros_gen.agent.wire.constants import Status


class BridgeError(Exception):
    """ROS 2 refused something; the text says what and what to do, `status` is what the client is told."""

    def __init__(self, reason: str, status: Status = Status.DDS_ERROR) -> None:
        super().__init__(reason)
        self.status = status


class Writer(Protocol):
    """A ROS publisher of a client."""

    @property
    def label(self) -> str:
        """Topic and type by their ROS names, for the log."""

    def publish(self, serialized: bytes) -> None:
        """Publish a sample: encapsulation header, then CDR body. May raise BridgeError."""

    def destroy(self) -> None:
        """Leave the ROS graph; nothing else is called afterwards."""


class Node(Protocol):
    """A ROS node of a client."""

    @property
    def label(self) -> str:
        """Fully qualified name, for the log."""

    def create_writer(self, topic: Topic, qos: Qos) -> Writer:
        """Create a publisher; BridgeError when names or type are not possible."""

    def destroy(self) -> None:
        """Leave the ROS graph, after all writers of the node have."""


class Bridge(Protocol):
    """The way into ROS 2."""

    def create_node(self, name: str, domain: int) -> Node:
        """Create a node; `name` is `node` or `namespace/node`, in any characters; may raise BridgeError."""

    def close(self) -> None:
        """Give everything back; nodes are destroyed before."""
