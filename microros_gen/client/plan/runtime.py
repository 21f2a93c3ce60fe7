# SPDX-License-Identifier: Apache-2.0
"""The numbers and tables of the C runtime: everything that microros_config.h and microros_plan.c print."""

from __future__ import annotations

from microros_gen.application.model import DISCOVERY_PORT, MOST_HISTORY
from microros_gen.client.plan.runtime_entities import (
    NodePlan,
    PublisherPlan,
    QueuePlan,
    SubscriptionPlan,
    TimerPlan,
)
from microros_gen.client.plan.runtime_rows import EndpointRow, QueueRow
from microros_gen.client.plan.services import ServicePlan
from microros_gen.client.plan.session_times import TimesPlan
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.message_pools import MessagePool, PoolPointer, pool_pointers
from microros_gen.typesupport.plan.names import include_path, type_files

DISCOVERY_GROUP = "239.255.0.2"
"""Where clients ask for agents and agents listen (OMG DDS-XRCE 1.0, 9.3)."""
LINE_CHUNK = 32
"""Bytes that are read of a line at a time."""


@dataclass(frozen=True, kw_only=True)
class RuntimePlan(TimesPlan):
    """Sizes are bytes, times are milliseconds.

    `declared` is false for an application without `nodes:`: then names come from the calls and are kept in
    pools (`nodes_max`, `publishers_max` slots, names of at most `name_size` bytes with their terminator, DDS
    type names of `type_name_size`). `creation_size`: the largest CREATE, where creation is reliable, else 0.
    `client_key` None: the port supplies it (`session.key: device`).
    `entities` is preconfigured, reference, xml or binary; `creation` the stream of CREATE (best_effort, reliable).
    `transport` is udp, tcp, serial or custom; `framing` of a custom one on, off or either (chosen at run time),
    `read_polls`: its function that reads packets never waits with a time-out of 0.
    `send_buffer`: bytes that wait for a serial line; `keeps_output`: it takes messages of the reliable stream from
    where they are; `line_input`: the largest message that it must not lose while nobody reads; `line_chunk`: bytes
    that are read of it at a time; `own_line`: the application has its functions.
    `fragments`: some reliable message is larger than the MTU, `reliable_slot_size` holds it whole.
    `arrives_in_fragments`: some reliable DATA is larger than the input buffer. `input_reader`: the queue whose one slot
    is the end of the input buffer, behind `input_free` bytes.
    `reliable_input_slots`: messages of the agent's reliable stream that the client holds at a time; 0: no such stream.
    `subscriptions_max`: places, at least one where they are selected; `services_max`, `clients_max`: 0 where `nodes:`
    declares none; `queues` has one entry for each of the three, in this order.
    `timers_max` to `jump_callbacks_max`: places of each; 0 timers, executors or clocks: the component is not selected.
    `has_ros_time`: the first subscription is that of /clock, which the library opens itself.
    `message_pools`: storage of `kept_messages` messages of each sender.
    `fixed_messages`: no message that is sent has a string or sequence. `timed_qos`: one has a deadline or lifespan.
    `hard_liveliness_ms`: after so long a silence the agent gives the client up; 0: as it likes.
    `error_text_size` 0: codes only. `best_effort_size` 0 or `reliable_slots` 0: there is no such stream.
    """

    plan_id: str
    error_text_size: int
    agent_host: str
    agent_port: int
    mtu: int
    input_size: int
    client_key: int | None
    session_id: int
    best_effort_size: int
    reliable_slots: int
    reliable_slot_size: int
    declared: bool
    nodes_max: int
    publishers_max: int
    name_size: int
    nodes: tuple[NodePlan, ...]
    publishers: tuple[PublisherPlan, ...]
    arena_size: int
    on_full: str
    on_full_block_ms: int
    entities: str = "binary"
    creation: str = "best_effort"
    transport: str = "udp"
    serial_device: str = ""
    serial_baud: int = 115_200
    send_buffer: int = 2048
    keeps_output: bool = False
    line_input: int = 64
    line_chunk: int = LINE_CHUNK
    own_line: bool = False
    framing: str = "either"
    read_polls: bool = False
    fragments: bool = False
    arrives_in_fragments: bool = False
    input_reader: int | None = None
    input_free: int = 0
    reliable_input_slots: int = 0
    reliable_input_slot_size: int = 0
    type_name_size: int = 0
    creation_size: int = 0
    subscriptions: tuple[SubscriptionPlan, ...] = ()
    subscriptions_max: int = 0
    services: tuple[ServicePlan, ...] = ()
    services_max: int = 0
    clients: tuple[ServicePlan, ...] = ()
    clients_max: int = 0
    queues: tuple[QueuePlan, ...] = ()
    timers: tuple[TimerPlan, ...] = ()
    timers_max: int = 0
    executors_max: int = 0
    handles_max: int = 0
    guard_conditions_max: int = 0
    wait_sets_max: int = 0
    ros_clocks_max: int = 0
    jump_callbacks_max: int = 0
    has_time_sync: bool = False
    has_ros_time: bool = False
    has_discovery: bool = False
    has_session_state: bool = False
    has_sleep: bool = False
    multithread: bool = False
    hard_liveliness_ms: int = 0
    discovery_port: int = DISCOVERY_PORT
    fixed_messages: bool = False
    timed_qos: bool = False
    kept_messages: int = 0
    message_pools: tuple[MessagePool, ...] = ()

    @property
    def has_subscriptions(self) -> bool:
        """Whether `subscribe` is selected."""
        return self.subscriptions_max > 0

    @property
    def application_subscriptions(self) -> int:
        """Places of subscriptions that the application opens: the last ones."""
        return self.subscriptions_max - (1 if self.has_ros_time else 0)

    @property
    def has_timers(self) -> bool:
        """Whether `timers` is selected."""
        return self.timers_max > 0

    @property
    def has_executors(self) -> bool:
        """Whether `executor` is selected."""
        return self.executors_max > 0

    @property
    def has_clocks(self) -> bool:
        """Whether `clock` is selected."""
        return self.ros_clocks_max > 0

    @property
    def has_sockets(self) -> bool:
        """Whether the transport goes over a socket of the port."""
        return self.transport in ("udp", "tcp")

    @property
    def has_device_key(self) -> bool:
        """Whether the port supplies the client key."""
        return self.client_key is None

    @property
    def send_may_wait(self) -> bool:
        """Whether sending is a function of the application, which may wait for its line."""
        return self.transport == "custom" or self.own_line

    @property
    def discovers(self) -> bool:
        """Whether a session searches for its agent by itself."""
        return self.agent_host == DISCOVERY_GROUP

    @property
    def agent_place(self) -> str:
        """Where the agent is: `192.168.1.10:8888`, `[::1]:8888`."""
        host = f"[{self.agent_host}]" if ":" in self.agent_host else self.agent_host
        return f"{host}:{self.agent_port}"

    @property
    def has_rtos_timers(self) -> bool:
        """Whether a timer of the system drives a declared one."""
        return any(timer.kind == "rtos" for timer in self.timers)

    @property
    def has_hardware_timers(self) -> bool:
        """Whether the application drives a declared timer."""
        return any(timer.kind == "hardware" for timer in self.timers)

    @property
    def has_ticked_timers(self) -> bool:
        """Whether something else than its clock makes a timer ready."""
        return self.has_rtos_timers or self.has_hardware_timers

    @property
    def waited_kinds(self) -> tuple[tuple[str, bool], ...]:
        """What one can wait for, and whether there are places for any."""
        return (
            ("subscription", self.has_subscriptions),
            ("guard_condition", self.guard_conditions_max > 0),
            ("timer", self.has_timers),
            ("client", self.clients_max > 0),
            ("service", self.services_max > 0),
        )

    @property
    def receives(self) -> bool:
        """Whether there are endpoints that receive: then `read` is selected."""
        return self.subscriptions_max + self.services_max + self.clients_max > 0

    @property
    def publisher_places(self) -> int:
        """Places of publishers, which come first among the endpoints; a table needs one place at least."""
        return max(self.publishers_max, 0 if self.receives else 1)

    @property
    def endpoints(self) -> tuple[EndpointRow, ...]:
        """The declared endpoints in the order of their places, with the places that nobody declared."""
        publishers = [EndpointRow(p.topic, p.dds_type, p.node, p.limited, p.given) for p in self.publishers]
        subscriptions = [EndpointRow(s.topic, s.dds_type, s.node, given=s.given) for s in self.subscriptions]
        rows = publishers + [EndpointRow()] * (self.publisher_places - len(publishers))
        subscriptions += [EndpointRow()] * (self.subscriptions_max - len(subscriptions))
        services = [
            EndpointRow(s.name, s.dds_type, s.node, s.limited, s.given)
            for s in (*self.services, *self.clients)
        ]
        return (*rows, *subscriptions, *services)

    @property
    def has_services(self) -> bool:
        """Whether there are places of service servers."""
        return self.services_max > 0

    @property
    def has_clients(self) -> bool:
        """Whether there are places of service clients."""
        return self.clients_max > 0

    @property
    def serves(self) -> bool:
        """Whether there are places of services or of clients."""
        return self.has_services or self.has_clients

    @property
    def requests_max(self) -> int:
        """Requests of all clients that can be under way: as many as their replies have room."""
        return sum(queue.slots for queue in self.queues[len(self.queues) - self.clients_max :])

    @property
    def remaps(self) -> bool:
        """Whether some name of the source is another one on the wire."""
        return any(node.given_name for node in self.nodes) or any(row.given for row in self.endpoints)

    @property
    def queue_rows(self) -> tuple[QueueRow, ...]:
        """The queues with their places in the storage."""
        rows: list[QueueRow] = []
        first, offset = 0, 0
        for queue in self.queues:
            lent = len(rows) == self.input_reader
            rows.append(QueueRow(queue.slots, queue.slot_size, first, 0 if lent else offset, queue.size))
            first, offset = first + queue.slots, offset + (0 if lent else queue.size)
        return tuple(rows)

    @property
    def queue_mode(self) -> str:
        """`bytes` or `slots`: whether a sample in a queue takes its own size, or that of the largest."""
        return "bytes" if any(queue.asked is not None for queue in self.queues) else "slots"

    @property
    def queue_slots(self) -> int:
        """Slots of all queues together."""
        return sum(queue.slots for queue in self.queues)

    @property
    def queues_size(self) -> int:
        """Bytes of all queues together, that in the input buffer left out."""
        queues = (queue for i, queue in enumerate(self.queues) if i != self.input_reader)
        return sum(queue.size for queue in queues)

    @property
    def lends_input(self) -> bool:
        """Whether a sample waits in the input buffer."""
        return self.input_reader is not None

    @property
    def input_is_free(self) -> bool:
        """Whether the input buffer is free between two looks at the line, for what is asked over another one.

        A session keeps the part of a message there that has come over a line of bytes. A board has one such line, and
        nothing else is asked while it is a session's.
        """
        lines_of_bytes = self.transport == "tcp" or bool(self.serial_device)
        return not lines_of_bytes and (self.transport != "custom" or self.framing == "off")

    @property
    def input_buffer_size(self) -> int:
        """Bytes of the buffer that messages are received in."""
        slot = 0 if self.input_reader is None else self.queues[self.input_reader].slot_size
        return max(self.input_size, self.input_free + slot)

    @property
    def reliable_front(self) -> int:
        """Bytes of a reliable slot before the first submessage: a message header, with fragments also FRAGMENT's."""
        return 8 if self.fragments else 4

    @property
    def reliable_begun(self) -> int:
        """How many messages may be on their way at a time. With drop_oldest one is left that can be dropped."""
        return self.reliable_slots - (1 if self.on_full == "drop_oldest" and self.reliable_slots > 1 else 0)

    @property
    def history_can_grow(self) -> bool:
        """Whether `pools: {history: …}` may be larger than it is."""
        return 0 < self.reliable_slots < MOST_HISTORY

    @property
    def reliable_input_mode(self) -> str:
        """`ordered` or `held`: what becomes of a reliable message of the agent that comes before its turn."""
        return "held" if self.reliable_input_slots > 1 else "ordered"

    @property
    def fragment_input(self) -> str:
        """`kept`, `refused` or `none`: what becomes of samples that come in fragments.

        Where every sample fits the input buffer, one that does not is too large for its queue as well.
        """
        if not self.receives or not self.reliable_input_slots:
            return "none"
        return "kept" if self.arrives_in_fragments else "refused"

    @property
    def error_mode(self) -> str:
        """`text` or `code`: which file speaks for errors."""
        return "text" if self.error_text_size else "code"

    @property
    def refusal_mode(self) -> str:
        """`told` or `never`: whether an encoder can refuse a message."""
        return "never" if self.fixed_messages else "told"

    @property
    def limited_headers(self) -> tuple[str, ...]:
        """Headers that declare the types of what sends with limits of their own; none: no publisher has such."""
        senders: list[PublisherPlan | ServicePlan] = [*self.publishers, *self.services, *self.clients]
        headers = {type_files(s.type).type_support for s in senders if s.limited}
        return tuple(sorted(map(include_path, headers)))

    @property
    def names_mode(self) -> str:
        """`declared` or `pool`: where names of nodes and publishers come from."""
        return "declared" if self.declared else "pool"

    @property
    def memory_mode(self) -> str:
        """`arena` or `none`: what is behind the default allocator."""
        return "arena" if self.arena_size else "none"

    @property
    def message_memory(self) -> str:
        """`pools` or `allocator`: where strings and sequences get their memory."""
        return "pools" if self.message_pools else "allocator"

    @property
    def pool_pointers(self) -> tuple[PoolPointer, ...]:
        """What functions of rosidl_runtime_c name for each kind of element."""
        return pool_pointers(self.message_pools)
