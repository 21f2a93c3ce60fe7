# SPDX-License-Identifier: Apache-2.0
"""An agent without sockets, clock and ROS: what it sends and what it would put into the graph are lists."""

from __future__ import annotations

import io
import itertools
import os
import re
from collections import deque
from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import Qos, References, Service, Topic
from microros_gen.agent.ros.bridge import BridgeError, BusyError, HashOf, Source
from microros_gen.agent.ros.names import ros_node, ros_topic, ros_type
from microros_gen.agent.transport.addresses import parse_address
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.wire.constants import Status

SomeSource = TypeVar("SomeSource", bound="FakeSource")


@dataclass
class FakeWriter:
    bridge: FakeBridge
    label: str
    qos: Qos

    def publish(self, serialized: bytes) -> None:
        if self.bridge.room is not None:
            if not self.bridge.room:
                raise BusyError(f"{self.label} is full")
            self.bridge.room -= 1
        self.bridge.published.append((self.label, serialized))

    def settled(self, wait_s: float = 0.0) -> bool:
        if not self.bridge.settled:
            self.bridge.waited.append(wait_s)
        return self.bridge.settled

    def destroy(self) -> None:
        self.bridge.graph.remove(self.label)


@dataclass(eq=False)
class FakeSource:
    """Has what a test puts into it; is named by the bridge again only after it had nothing, as the contract says."""

    bridge: FakeBridge
    label: str
    waiting: deque[Any] = field(default_factory=deque)
    idle: bool = True
    failing: bool = False

    def put(self, *items: Any) -> None:
        self.waiting.extend(items)
        if self.idle:
            self.idle = False
            self.bridge.tell(self)

    def take(self) -> Any:
        if self.failing:
            raise BridgeError("taking failed")
        if self.waiting:
            return self.waiting.popleft()
        self.idle = True
        return None

    def unread(self) -> int:
        return len(self.waiting)

    def destroy(self) -> None:
        self.bridge.graph.remove(self.label)
        self.bridge.sources.remove(self)
        if self in self.bridge.named:
            self.bridge.named.remove(self)


@dataclass(eq=False)
class FakeReader(FakeSource):
    qos: Qos = field(default_factory=Qos)


@dataclass(eq=False)
class FakeReplier(FakeSource):
    replies: list[tuple[bytes, bytes]] = field(default_factory=list)

    def reply(self, identity: bytes, serialized: bytes) -> None:
        self.replies.append((identity, serialized))


@dataclass(eq=False)
class FakeRequester(FakeSource):
    requests: list[tuple[int, bytes]] = field(default_factory=list)
    numbers: itertools.count[int] = field(default_factory=lambda: itertools.count(1))

    def request(self, serialized: bytes) -> int:
        number = next(self.numbers)
        self.requests.append((number, serialized))
        return number


SERVICE_TYPE = re.compile(r"([a-z0-9_]+)::srv::dds_::([A-Za-z0-9]+)_Request_")


@dataclass
class FakeNode:
    bridge: FakeBridge
    label: str
    domain: int = 0

    def create_writer(self, topic: Topic, qos: Qos) -> FakeWriter:
        return FakeWriter(self.bridge, self._topic(topic), qos)

    def create_reader(self, topic: Topic, qos: Qos) -> FakeReader:
        return self._known(FakeReader(self.bridge, self._topic(topic), qos=qos))

    def create_replier(self, service: Service) -> FakeReplier:
        return self._known(FakeReplier(self.bridge, self._service(service)))

    def create_requester(self, service: Service) -> FakeRequester:
        return self._known(FakeRequester(self.bridge, self._service(service)))

    def destroy(self) -> None:
        self.bridge.graph.remove(self.label)

    def _topic(self, topic: Topic) -> str:
        type_name = ros_type(topic.type_name)
        if type_name.package == "no_such_package":
            raise BridgeError(f"type {type_name} is not known")
        label = f"{ros_topic(topic.name)} [{type_name}]"
        self.bridge.graph.append(label)
        return label

    def _service(self, service: Service) -> str:
        match = SERVICE_TYPE.fullmatch(service.request_type)
        if not match:
            raise BridgeError(f"'{service.request_type}' is not a ROS service", Status.INVALID_DATA)
        label = f"{service.name} [{match[1]}/srv/{match[2]}]"
        self.bridge.graph.append(label)
        return label

    def _known(self, source: SomeSource) -> SomeSource:
        self.bridge.sources.append(source)
        return source


@dataclass
class FakeBridge:
    graph: list[str] = field(default_factory=list)
    published: list[tuple[str, bytes]] = field(default_factory=list)
    sources: list[FakeSource] = field(default_factory=list)
    named: list[FakeSource] = field(default_factory=list)
    hashes: list[HashOf | None] = field(default_factory=list)
    closed: bool = False
    trimmed: int = 0
    descriptor: int = -1
    settled: bool = True
    """Whether readers have everything that was published."""
    waited: list[float] = field(default_factory=list)
    """Seconds for which each writer was waited for without success."""
    room: int | None = None
    """How many samples its writers take before they are full; None: any number."""

    def create_node(self, name: str, domain: int, hash_of: HashOf | None = None) -> FakeNode:
        node, namespace = ros_node(name)
        self.hashes.append(hash_of)
        label = f"{domain}:{namespace.rstrip('/')}/{node}"
        self.graph.append(label)
        return FakeNode(self, label, domain)

    def source(self, label: str) -> Any:
        """Return the source with a label."""
        (found,) = (source for source in self.sources if source.label == label)
        return found

    def tell(self, source: FakeSource) -> None:
        self.named.append(source)
        if self.descriptor >= 0:
            os.eventfd_write(self.descriptor, 1)

    def fileno(self) -> int:
        if self.descriptor < 0:
            self.descriptor = os.eventfd(len(self.named), os.EFD_NONBLOCK)
        return self.descriptor

    def ready(self) -> list[Source]:
        named, self.named = self.named, []
        if named and self.descriptor >= 0:
            os.eventfd_read(self.descriptor)
        return list(named)

    def trim(self) -> None:
        self.trimmed += 1

    def close(self) -> None:
        self.closed = True
        if self.descriptor >= 0:
            os.close(self.descriptor)


@dataclass(eq=False)
class FakeTransport:
    sent: list[tuple[Hashable, bytes]] = field(default_factory=list)
    label: str = "fake"
    writing: bool = False
    ready: bool = True
    forgeable: bool = False

    def tick(self, now: float) -> None:
        """Time brings nothing."""

    def fileno(self) -> int:
        raise NotImplementedError

    def pump(self, receive: Receive) -> None:
        raise NotImplementedError

    def claim(self, address: Hashable, account: Account) -> None:
        """All are read alike."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """All are read alike."""

    def send(self, data: bytes, address: Hashable) -> None:
        self.sent.append((address, data))

    def flush(self) -> None:
        """All are sent at once."""

    def name_of(self, address: Hashable) -> str:
        return str(address)

    def origin(self, address: Hashable) -> Origin:
        """A text with a dot or a colon is an address, another one a path."""
        text = str(address)
        return parse_address(text) if "." in text or ":" in text else text

    def proved_key(self, address: Hashable) -> bytes:
        return b""

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
        manifests: Manifests | None = None,
        watched: bool = False,
        policy: Policy | None = None,
    ) -> None:
        self.now = 1000.0
        self.waited = 0.0
        """Seconds for which other programs had the agent's processor."""
        self.bridge = FakeBridge()
        self.transport = FakeTransport()
        self.text = io.StringIO()
        self.log = EventLog(self.text, verbosity=verbosity, clock=lambda: self.now)
        self.agent = Agent(
            self.bridge,
            self.log,
            limits or Limits(),
            references,
            preconfigured,
            clock=lambda: self.now,
            processor=lambda: self.now,
            manifests=manifests,
            watched=watched,
            policy=policy,
            fair=Fairness(lambda: self.now, lambda: self.waited),
        )

    def say(self, data: bytes | str, address: Hashable = "a") -> list[str]:
        """Send a message (bytes, or hexadecimal text); return the answers to that address in hexadecimal."""
        message = bytes.fromhex(data) if isinstance(data, str) else data
        del self.transport.sent[:]
        self.agent.receive(message, address, self.transport)
        self.agent.flush()
        return [answer.hex(" ") for to, answer in self.transport.sent if to == address]

    def take(self) -> list[str]:
        """Let the agent take what ROS has; return what it sends, in hexadecimal."""
        del self.transport.sent[:]
        self.agent.take()
        return [answer.hex(" ") for _, answer in self.transport.sent]

    def wait(self, seconds: float, step: float = 0.05) -> list[str]:
        """Let time pass; return what the agent sends meanwhile."""
        del self.transport.sent[:]
        end = self.now + seconds
        while self.now < end:
            self.now += step
            self.agent.tick()
        return [answer.hex(" ") for _, answer in self.transport.sent]
