# SPDX-License-Identifier: Apache-2.0
"""The application file (design: "The application file"), as data. None means: not said, the default holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from fractions import Fraction
from pathlib import Path

from microros_gen.application.action_decl import ActionClientDecl, ActionDecl
from microros_gen.application.diagnosis_decl import DiagnosisDecl
from microros_gen.application.limit_rule import LimitRule as LimitRule
from microros_gen.application.log_decl import LogWriter
from microros_gen.application.mode_decl import ModeDecl
from microros_gen.application.silence import SilenceDecl
from microros_gen.application.system_decl import BusSender, Link, SystemRef
from microros_gen.application.task_decl import TaskDecl
from microros_gen.application.time_source import TimeSourceDecl
from microros_gen.application.transport_decl import Transport
from microros_gen.application.watchdog import WatchdogDecl
from microros_gen.diagnostics import Span
from microros_gen.documents.named import Named
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class ComponentChange:
    """`+timers` (add) or `-ping` (drop)."""

    name: str
    add: bool
    span: Span | None = None


def component_change(text: str, span: Span | None) -> ComponentChange:
    """Return what `timers`, `+timers` (both add) or `-timers` (drop) says."""
    return ComponentChange(text.lstrip("+-"), not text.startswith("-"), span)


DISCOVERY_PORT = 7400
"""Where agents are asked for by multicast, unless the application says another port."""

LARGEST_UDP_PAYLOAD = 65_507
"""Bytes that fit one UDP datagram over IPv4 (RFC 768, RFC 791)."""

DISTRIBUTIONS = ("jazzy", "kilted")
"""Distributions of ROS 2 whose interfaces are included; application.schema.json says it too."""

MOST_HISTORY = 16
"""Most messages that a reliable stream keeps; application.schema.json says it too."""


@dataclass(frozen=True)
class Qos:
    """QoS of an endpoint.

    The values are those of rmw/types.h in lower case, the defaults rmw_qos_profile_default. `deadline_ms` and
    `lifespan_ms`: 0 for none.
    """

    reliability: str = "reliable"
    durability: str = "volatile"
    history: str = "keep_last"
    depth: int = 10
    span: Span | None = None
    deadline_ms: int = 0
    lifespan_ms: int = 0


CLOCK_TOPIC = "/clock"
"""The source of ROS time (design.ros2.org, "Clock and Time")."""


@dataclass(frozen=True)
class EndpointDecl:
    """A publisher, subscription, service or client of a node.

    `topic` holds the service's name for the latter two. {node} and {ns} in it are replaced. `queue`: how many samples
    wait on the device at most until they are taken; None: follows from the depth. Publishers have none. `queue_bytes`:
    what these take together; None: as much as that many of the largest. `stored`: the library has storage for what is
    received (`storage: none`: the program has). `declared_as`: the fully qualified name in the source, if `remap:`
    changes it to `topic`; empty: the same.
    `of_the_library`: nobody declared it, and the library itself opens it; `executed`: an executor runs it all the
    same. `usual_limits` are then those of its component, which hold where the application says nothing but `*`.
    `streamed`: its samples are taken piece by piece and never wait; `outside_ros`: `topic` is the name in DDS.
    `managed`: a publisher that drops what is published while its node is not active.
    `local`: whether its messages are exchanged inside the image without the agent: `never`, `also` or `only`; `peer`:
    the same with other boards of the system. `interval_us`: a publisher publishes at most once in that time (`rate`);
    None: not said.
    """

    kind: str
    topic: str
    type: str
    qos: Qos = Qos()
    limits: tuple[LimitRule, ...] = ()
    span: Span | None = None
    type_span: Span | None = None
    topic_span: Span | None = None
    queue: int | None = None
    queue_bytes: int | None = None
    queue_bytes_span: Span | None = None
    stored: bool = True
    declared_as: str = ""
    of_the_library: bool = False
    executed: bool = False
    usual_limits: tuple[LimitRule, ...] = ()
    streamed: bool = False
    outside_ros: bool = False
    managed: bool = False
    local: str = "never"
    peer: str = "never"
    interval_us: Fraction | None = None
    rate_span: Span | None = None
    silence: SilenceDecl | None = None

    @property
    def exists_at_agent(self) -> bool:
        """Whether an agent knows it."""
        return "only" not in (self.local, self.peer) and self.local != "chip"

    @property
    def takes_handle(self) -> bool:
        """Whether an executor of the application can have a handle for it."""
        return self.executed or not self.of_the_library


@dataclass(frozen=True)
class EndpointChange:
    """What the application changes of an endpoint that a component opens by itself; `name` is the component's for it.

    Paths of `limits` begin with the member. None: unchanged.
    """

    name: str
    depth: int | None = None
    queue: int | None = None
    limits: tuple[LimitRule, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class TimerDecl:
    """A timer of a node; its period in microseconds. `kind` is what makes it ready: clock, rtos or hardware.

    `managed`: it is never ready while its node is not active.
    """

    name: str
    period_us: int
    span: Span | None = None
    kind: str = "clock"
    managed: bool = False


Scalar = bool | int | float | str
"""A value of a parameter, or an element of one."""


@dataclass(frozen=True)
class ParameterRule:
    """A rule of generate_parameter_library that ROS has not: its name without `<>`, and its arguments in one list."""

    name: str
    values: tuple[Scalar, ...] = ()


@dataclass(frozen=True)
class ParameterDecl:
    """A parameter of a node. `type` is bool, integer, double or string, or `T[]` of one of them or of byte.

    `size` bounds a string, bytes without its terminator, or the elements of an array. `one_of` has the values that
    are accepted, where not all are. `unit` is shown behind the description. `minimum`, `maximum` and `step` are
    the range of rcl_interfaces/msg/ParameterDescriptor; None: no range. `constraints` says in words what nothing else
    says; nobody checks it. `rules` are checked in this order.
    """

    name: str
    type: str
    default: bool | int | float | str | tuple[bool | int | float | str, ...] | None = None
    description: str = ""
    read_only: bool = False
    minimum: int | float | None = None
    maximum: int | float | None = None
    step: int | float | None = None
    span: Span | None = None
    size: int | None = None
    one_of: tuple[int | float | str, ...] = ()
    unit: str = ""
    constraints: str = ""
    rules: tuple[ParameterRule, ...] = ()

    @property
    def is_array(self) -> bool:
        """Return whether a value has elements."""
        return self.type.endswith("[]")

    @property
    def shown(self) -> str:
        """Return the description that other nodes read: with the unit, in brackets as ROS users write it."""
        return f"{self.description} [{self.unit}]".strip() if self.unit else self.description


@dataclass(frozen=True)
class ParameterClientDecl:
    """Another node, by its fully qualified name, and what is done with its parameters: get, set, …, watch.

    At most `parameters` of a call or event. `types`: those of values, besides bool, integer and double. `string`: bytes
    of a string without its terminator; `elements`: of arrays; `description`: bytes of a description.
    """

    node: str
    operations: tuple[str, ...] = ("get", "set")
    parameters: int = 4
    types: tuple[str, ...] = ("string",)
    string: int = 49
    elements: int = 0
    description: int = 99
    span: Span | None = None


@dataclass(frozen=True)
class ExecutorDecl:
    """An executor and what it runs: names of timers, topics and services of the node, in this order.

    `handles` empty: everything of the node. `timeout_us` is how long one spin waits for work at most.
    """

    name: str
    handles: tuple[Named, ...] = ()
    timeout_us: int | None = None
    span: Span | None = None


def logger_name(namespace: str, name: str) -> str:
    """Return the name that ROS 2 gives to the logger of a node: `namespace.name`."""
    return ".".join(part for part in (*namespace.split("/"), name) if part)


@dataclass(frozen=True)
class NodeDecl:
    """A node and what it owns. `given_name`, `given_namespace`: what the source has, where `remap:` changes them.

    `parameter_file`: one of generate_parameter_library, relative to the folder of the application file; its
    parameters are among `parameters` once it was read, before those of the application file.
    `parameters_at`: who holds their values, `device` or `agent`; None: nothing is said.
    `modes`: `__DEFAULT__` first.
    `clock_topic`: where a rule of `remap:` puts /clock, to which a node subscribes by itself; empty: no rule.
    """

    name: str
    namespace: str = "/"
    domain_id: int = 0
    endpoints: tuple[EndpointDecl, ...] = ()
    span: Span | None = None
    timers: tuple[TimerDecl, ...] = ()
    parameters: tuple[ParameterDecl, ...] = ()
    parameter_file: Named | None = None
    parameters_at: Named | None = None
    parameter_clients: tuple[ParameterClientDecl, ...] = ()
    modes: tuple[ModeDecl, ...] = ()
    actions: tuple[ActionDecl, ...] = ()
    action_clients: tuple[ActionClientDecl, ...] = ()
    executors: tuple[ExecutorDecl, ...] = ()
    name_span: Span | None = None
    given_name: str = ""
    given_namespace: str = ""
    clock_topic: str = ""
    clock_span: Span | None = None

    @property
    def full_name(self) -> str:
        """Return namespace and name: `/arm/motor`."""
        return f"{self.namespace.rstrip('/')}/{self.name}"


@dataclass(frozen=True)
class Memory:
    """Budgets and the arena, bytes; None: no budget. `messages` of each sender get storage; None: not said."""

    arena: int = 0
    messages: int | None = None
    ram_budget: int | None = None
    flash_budget: int | None = None
    stack: int | None = None
    ram_span: Span | None = None
    flash_span: Span | None = None
    arena_span: Span | None = None
    stack_span: Span | None = None

    @property
    def has_budget(self) -> bool:
        """Whether there is a budget that an image can exceed."""
        return any(budget is not None for budget in (self.ram_budget, self.flash_budget, self.stack))


@dataclass(frozen=True)
class TargetRef:
    """`name` of a built-in target or path of a target file.

    `rtos` and `network` replace the operating system and the IP stack of that target; `rtos` none: it has no system.
    """

    name: str = "host"
    rtos: Named | None = None
    network: Named | None = None
    span: Span | None = None


@dataclass(frozen=True)
class SessionTimes:
    """Times of the protocol, milliseconds; None: as the plan derives it from `round_trip` and the transport."""

    round_trip: int | None = None
    retry_max: int | None = None
    heartbeat: int | None = None
    liveliness_period: int | None = None
    liveliness_timeout: int | None = None
    connect_timeout: int | None = None
    create_timeout: int | None = None
    close_timeout: int | None = None


@dataclass(frozen=True)
class ChipImage:
    """Another image of this one's chip: the board that it is in the system, its `position`, and its application.

    `hashes`: of the types that its own interface files define, by name; with more than two images of all types at its
    ends, whose `messages` are closed. `files` were read for it.
    """

    board: str
    position: int
    application: Application
    hashes: Mapping[str, str]
    files: tuple[Path, ...]
    messages: Mapping[TypeName, Message] = field(default_factory=dict)


@dataclass(frozen=True)
class Chip:
    """The chip that this image is on: its position there, the other images, and the bytes of its `memory`, if known."""

    position: int
    images: tuple[ChipImage, ...]
    memory: int | None = None
    span: Span | None = None


@dataclass(frozen=True)
class Application:
    """The whole file. `interfaces` are `pkg` or `pkg/msg/Type`.

    `hard_liveliness_ms`: how long the agent goes on without hearing the client; 0: as it likes.
    `pools` count entities where no nodes are given. `creation` (best_effort, reliable) is the stream of CREATE; None:
    best effort. `clock` (steady, ros) is an axis like `entities` and `liveliness`. `interface_paths` are relative to
    the file. `implied` are the endpoints of the library itself where there are no nodes (with nodes they are among
    their endpoints), `endpoints` what the file changes of those. `spans` holds the places of top-level keys and of
    the keys of `pools` (as `pools.history`), for later steps. `exact_float64`: what would
    round a float64 is an error. `links` are those of this board in its `system`, `chip` the images of the other
    cores there, `bus_senders` what others send on its CAN buses. `bus_files` were read for these boards alone.
    """

    distro: str = DISTRIBUTIONS[0]
    profiles: tuple[Named, ...] = ()
    components: tuple[ComponentChange, ...] = ()
    entities: Named | None = None
    creation: Named | None = None
    liveliness: Named | None = None
    transport: Transport = Transport()
    session_key: int | str | None = None
    hard_liveliness_ms: int = 0
    times: SessionTimes = SessionTimes()
    target: TargetRef = TargetRef()
    nodes: tuple[NodeDecl, ...] = ()
    interfaces: tuple[Named, ...] = ()
    interface_paths: tuple[Named, ...] = ()
    pools: Mapping[str, int] = field(default_factory=dict)
    limits: tuple[LimitRule, ...] = ()
    memory: Memory = Memory()
    on_full: str = "error"
    on_full_block_ms: int = 0
    error_text: bool = True
    exact_float64: bool = False
    clock: Named | None = None
    logging: tuple[LogWriter, ...] = ()
    diagnosis: DiagnosisDecl | None = None
    time_source: TimeSourceDecl | None = None
    watchdog: WatchdogDecl | None = None
    implied: tuple[EndpointDecl, ...] = ()
    endpoints: tuple[EndpointChange, ...] = ()
    system: SystemRef | None = None
    links: tuple[Link, ...] = ()
    bus_files: tuple[Path, ...] = ()
    bus_senders: tuple[BusSender, ...] = ()
    tasks: tuple[TaskDecl, ...] = ()
    chip: Chip | None = None
    spans: Mapping[str, Span] = field(default_factory=dict)
