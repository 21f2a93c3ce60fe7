# SPDX-License-Identifier: Apache-2.0
"""The application file (design: "The application file"), as data. None means: not said, the default holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from microros_gen.diagnostics import Span


@dataclass(frozen=True)
class Named:
    """A name that the user wrote, and where."""

    name: str
    span: Span | None = None


@dataclass(frozen=True)
class ComponentChange:
    """`+timers` (add) or `-ping` (drop)."""

    name: str
    add: bool
    span: Span | None = None


@dataclass(frozen=True)
class Transport:
    """How the firmware reaches its agent. `mtu`: largest datagram or frame payload, bytes; None: planned."""

    type: str = "udp"
    host: str = "127.0.0.1"
    port: int = 8888
    mtu: int | None = None
    span: Span | None = None
    mtu_span: Span | None = None


@dataclass(frozen=True)
class Qos:
    """QoS of an endpoint; the values are those of rmw/types.h in lower case."""

    reliability: str = "reliable"
    durability: str = "volatile"
    history: str = "keep_last"
    depth: int = 10
    span: Span | None = None


@dataclass(frozen=True)
class LimitRule:
    """One capacity rule. `path` is `*`, a type (`sensor_msgs/msg/Imu`) or a type and a field path below it.

    `path` for a field is `("sensor_msgs/msg/Imu", "header", "frame_id")`. `string` counts bytes without the
    terminator, `sequence` counts elements; None where the rule says nothing of it.
    """

    path: tuple[str, ...]
    string: int | None = None
    sequence: int | None = None
    span: Span | None = None


@dataclass(frozen=True)
class EndpointDecl:
    """A publisher, subscription, service or client of a node (`topic` holds the service name for the latter)."""

    kind: str
    topic: str
    type: str
    qos: Qos = Qos()
    limits: tuple[LimitRule, ...] = ()
    span: Span | None = None
    type_span: Span | None = None


@dataclass(frozen=True)
class NodeDecl:
    """A node and what it owns."""

    name: str
    namespace: str = "/"
    domain_id: int = 0
    endpoints: tuple[EndpointDecl, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class Memory:
    """Budgets and the arena, bytes; None: no budget."""

    arena: int = 0
    ram_budget: int | None = None
    flash_budget: int | None = None
    stack: int | None = None
    ram_span: Span | None = None
    flash_span: Span | None = None


@dataclass(frozen=True)
class TargetRef:
    """`name` of a built-in target or path of a target file."""

    name: str = "host"
    rtos: str | None = None
    span: Span | None = None


@dataclass(frozen=True)
class Application:
    """The whole file. `interfaces` are `pkg` or `pkg/msg/Type`; `pools` count entities where no nodes are given."""

    distro: str = "jazzy"
    profiles: tuple[Named, ...] = ()
    components: tuple[ComponentChange, ...] = ()
    entities: Named | None = None
    liveliness: Named | None = None
    transport: Transport = Transport()
    session_key: int | str | None = None
    target: TargetRef = TargetRef()
    nodes: tuple[NodeDecl, ...] = ()
    interfaces: tuple[Named, ...] = ()
    pools: Mapping[str, int] = field(default_factory=dict)
    limits: tuple[LimitRule, ...] = ()
    memory: Memory = Memory()
    on_full: str = "error"
    on_full_block_ms: int = 0
    error_text: bool = True
