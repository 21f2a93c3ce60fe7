# SPDX-License-Identifier: Apache-2.0
"""An agent without sockets, clock and ROS: what it sends and what it would put into the graph are lists."""

from __future__ import annotations

import io
from collections.abc import Hashable
from dataclasses import dataclass, field

from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import Qos, References, Topic
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.names import ros_node, ros_topic, ros_type
from microros_gen.agent.transport.base import Receive


@dataclass
class FakeWriter:
    bridge: FakeBridge
    label: str
    qos: Qos

    def publish(self, serialized: bytes) -> None:
        self.bridge.published.append((self.label, serialized))

    def destroy(self) -> None:
        self.bridge.graph.remove(self.label)


@dataclass
class FakeNode:
    bridge: FakeBridge
    label: str

    def create_writer(self, topic: Topic, qos: Qos) -> FakeWriter:
        type_name = ros_type(topic.type_name)
        if type_name.package == "no_such_package":
            raise BridgeError(f"type {type_name} is not known")
        label = f"{ros_topic(topic.name)} [{type_name}]"
        self.bridge.graph.append(label)
        return FakeWriter(self.bridge, label, qos)

    def destroy(self) -> None:
        self.bridge.graph.remove(self.label)


@dataclass
class FakeBridge:
    graph: list[str] = field(default_factory=list)
    published: list[tuple[str, bytes]] = field(default_factory=list)
    closed: bool = False

    def create_node(self, name: str, domain: int) -> FakeNode:
        node, namespace = ros_node(name)
        label = f"{domain}:{namespace.rstrip('/')}/{node}"
        self.graph.append(label)
        return FakeNode(self, label)

    def close(self) -> None:
        self.closed = True


@dataclass(eq=False)
class FakeTransport:
    sent: list[tuple[Hashable, bytes]] = field(default_factory=list)
    label: str = "fake"
    writing: bool = False

    def tick(self, now: float) -> None:
        """Time brings nothing."""

    def fileno(self) -> int:
        raise NotImplementedError

    def pump(self, receive: Receive) -> None:
        raise NotImplementedError

    def send(self, data: bytes, address: Hashable) -> None:
        self.sent.append((address, data))

    def name_of(self, address: Hashable) -> str:
        return str(address)

    def close(self) -> None:
        """Nothing is open."""


class Bench:
    """An agent with its fakes; `say` sends bytes to it and returns what comes back."""

    def __init__(
        self,
        limits: Limits | None = None,
        verbosity: int = 0,
        references: References | None = None,
        preconfigured: Preconfigured | None = None,
    ) -> None:
        self.now = 1000.0
        self.bridge = FakeBridge()
        self.transport = FakeTransport()
        self.text = io.StringIO()
        self.log = EventLog(self.text, verbosity=verbosity)
        self.agent = Agent(
            self.bridge, self.log, limits or Limits(), references, preconfigured, clock=lambda: self.now
        )

    def say(self, data: bytes | str, address: Hashable = "a") -> list[str]:
        """Send a message (bytes, or hexadecimal text); return the answers to that address in hexadecimal."""
        message = bytes.fromhex(data) if isinstance(data, str) else data
        del self.transport.sent[:]
        self.agent.receive(message, address, self.transport)
        self.agent.flush()
        return [answer.hex(" ") for to, answer in self.transport.sent if to == address]

    def wait(self, seconds: float, step: float = 0.05) -> list[str]:
        """Let time pass; return what the agent sends meanwhile."""
        del self.transport.sent[:]
        end = self.now + seconds
        while self.now < end:
            self.now += step
            self.agent.tick()
        return [answer.hex(" ") for _, answer in self.transport.sent]
