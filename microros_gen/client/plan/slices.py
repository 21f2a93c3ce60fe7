# SPDX-License-Identifier: Apache-2.0
"""The slices of the client's plan, by subject. Sizes are bytes, times are milliseconds."""

from __future__ import annotations

from microros_gen.application.model import DISCOVERY_PORT, MOST_HISTORY
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.client.plan.runtime_rows import QueueRow
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.message_pools import MessagePool, PoolPointer, pool_pointers

DISCOVERY_GROUP = "239.255.0.2"
"""Where clients ask for agents and agents listen (OMG DDS-XRCE 1.0, 9.3)."""
LINE_CHUNK = 32
"""Bytes that are read of a line at a time."""


@dataclass(frozen=True, kw_only=True)
class SessionPlan:
    """The session with the agent; its times are in TimesPlan.

    `client_key` None: the port supplies it (`session.key: device`). `hard_liveliness_ms`: after so long a silence the
    agent gives the client up; 0: as it likes.
    """

    id: int
    client_key: int | None
    multithread: bool = False
    hard_liveliness_ms: int = 0
    has_state: bool = False
    has_sleep: bool = False
    has_time_sync: bool = False

    @property
    def key_of_device(self) -> bool:
        """Whether the port supplies the key."""
        return self.client_key is None

    @property
    def key_constant(self) -> str:
        """The key as C: a constant, or the port's function."""
        return "port_unique_id()" if self.client_key is None else f"0x{self.client_key:08x}u"

    @property
    def has_device_key(self) -> bool:
        """Whether the port supplies the client key."""
        return self.client_key is None


@dataclass(frozen=True, kw_only=True)
class TransportPlan:
    """How messages reach the agent, and where it is.

    `kind` is udp, tcp, serial, canfd or custom; `framing` of a custom one on, off or either (chosen at run time),
    `read_polls`: its function that reads packets never waits with a time-out of 0.
    `device` and `baud` are those of a serial line. `send_buffer`: bytes that wait for it; `keeps_output`: it takes
    messages of the reliable stream from where they are; `line_input`: the largest message that it must not lose while
    nobody reads; `line_chunk`: bytes that are read of it at a time; `own_line`: the application has its functions.
    `wakes_for_room`: room in it ends a wait; `wakes`: what arrives calls port_wake, so nobody waits for its handle.
    """

    agent_host: str
    agent_port: int
    kind: str = "udp"
    has_discovery: bool = False
    discovery_port: int = DISCOVERY_PORT
    framing: str = "either"
    read_polls: bool = False
    device: str = ""
    baud: int = 115_200
    send_buffer: int = 2048
    keeps_output: bool = False
    line_input: int = 64
    line_chunk: int = LINE_CHUNK
    own_line: bool = False
    wakes_for_room: bool = False
    wakes: bool = False

    @property
    def has_handle(self) -> bool:
        """Whether there is a handle of the port that one can wait for."""
        return self.kind != "custom"

    @property
    def has_sockets(self) -> bool:
        """Whether it goes over a socket of the port."""
        return self.kind in ("udp", "tcp")

    @property
    def has_system_line(self) -> bool:
        """Whether it goes over a serial line whose functions the platform has."""
        return self.kind == "serial" and not self.own_line

    @property
    def send_may_wait(self) -> bool:
        """Whether sending is a function of the application, which may wait for its line."""
        return self.kind == "custom" or self.own_line

    @property
    def input_is_free(self) -> bool:
        """Whether the input buffer is free between two polls of the line, for a request over another line.

        A session keeps the part of a message there that was received over a line of bytes. A board has one such
        line, and nothing else is asked while it is a session's.
        """
        lines_of_bytes = self.kind == "tcp" or bool(self.device)
        return not lines_of_bytes and (self.kind != "custom" or self.framing == "off")

    @property
    def reading_waits(self) -> str:
        """When a custom read function waits for a message: never, always, or unframed (chosen at run time)."""
        if self.read_polls or self.framing == "on":
            return "never"
        return "always" if self.framing == "off" else "unframed"

    @property
    def reads_may_wait(self) -> bool:
        """Whether a custom transport's read function may wait for a message."""
        return self.reading_waits != "never"

    @property
    def framing_is_fixed(self) -> bool:
        """Whether the application file says whether a custom transport has framing."""
        return self.framing != "either"

    @property
    def framing_is_on(self) -> bool:
        """Whether a custom transport always has framing."""
        return self.framing == "on"

    @property
    def host_format(self) -> str:
        """How a text of C prints the agent's host: an IPv6 address in brackets."""
        return "[%s]" if ":" in self.agent_host else "%s"

    @property
    def host_size(self) -> int:
        """Bytes for a host in digits, with its NUL: an IPv6 address where the plan has one."""
        return 46 if ":" in self.agent_host else 32

    @property
    def discovers(self) -> bool:
        """Whether a session searches for its agent by itself."""
        return self.agent_host == DISCOVERY_GROUP

    @property
    def agent_place(self) -> str:
        """Where the agent is: `192.168.1.10:8888`, `[::1]:8888`."""
        host = f"[{self.agent_host}]" if ":" in self.agent_host else self.agent_host
        return f"{host}:{self.agent_port}"


@dataclass(frozen=True, kw_only=True)
class OutputPlan:
    """The output streams. `mtu`: the largest message that is sent.

    `best_effort_size` 0 or `reliable_slots` 0: the stream does not exist. `fragments`: some reliable message is larger
    than the MTU, `reliable_slot_size` holds it whole. `on_full`: what a write does when no slot is free.
    `best_effort_slots`: messages that wait until a task sends them; 0: they are sent at once. `best_effort_places`: how
    many messages its storage holds, one of them of the session itself where that creates entities on the stream.
    """

    mtu: int
    best_effort_size: int
    reliable_slots: int
    reliable_slot_size: int
    on_full: str
    on_full_block_ms: int
    fragments: bool = False
    best_effort_slots: int = 0
    best_effort_places: int = 1

    @property
    def queues_best_effort(self) -> bool:
        """Whether best-effort messages wait until a task sends them."""
        return self.best_effort_slots != 0

    @property
    def best_effort_bytes(self) -> int:
        """Bytes of the storage of the best-effort stream."""
        return self.best_effort_size * self.best_effort_places

    @property
    def reliable_front(self) -> int:
        """Bytes of a reliable slot before the first submessage: a message header, with fragments also FRAGMENT's."""
        return 8 if self.fragments else 4

    @property
    def reliable_begun(self) -> int:
        """How many messages may be on their way at a time. With drop_oldest one is left that can be dropped."""
        return self.reliable_slots - (1 if self.on_full == "drop_oldest" and self.reliable_slots > 1 else 0)

    @property
    def reliable_storage(self) -> str:
        """How reliable messages are stored: in a `ring`; `replaced` by newer ones; or whole and sent in `fragments`."""
        if self.fragments:
            return "fragments"
        return "replaced" if self.on_full == "drop_oldest" else "ring"

    @property
    def keeps_all(self) -> bool:
        """Whether the storage of reliable messages cannot drop one: all of them may be on their way at a time."""
        return self.reliable_storage == "ring"

    @property
    def history_can_grow(self) -> bool:
        """Whether `pools: {history: …}` may be larger than it is."""
        return 0 < self.reliable_slots < MOST_HISTORY


@dataclass(frozen=True, kw_only=True)
class InputPlan:
    """The input buffer, the reliable input stream and the queues of samples.

    `size`: the largest message of the agent, as it is told. `queues` has one entry for each place of a subscription,
    a service and a client, in this order. `reliable_slots`: messages of the agent's reliable stream that the client
    holds at a time; 0: no such stream. `arrives_in_fragments`: some reliable DATA is larger than the input buffer.
    `reader`: the queue whose one slot is the end of the input buffer, after `free` bytes.
    """

    size: int
    reader: int | None = None
    free: int = 0
    arrives_in_fragments: bool = False
    reliable_slots: int = 0
    reliable_slot_size: int = 0
    queues: tuple[QueuePlan, ...] = ()

    @property
    def receives(self) -> bool:
        """Whether there are endpoints that receive: then `read` is selected."""
        return bool(self.queues)

    @property
    def queue_rows(self) -> tuple[QueueRow, ...]:
        """The queues with their places in the storage."""
        rows: list[QueueRow] = []
        first, offset = 0, 0
        for queue in self.queues:
            in_input_buffer = len(rows) == self.reader
            rows.append(
                QueueRow(queue.slots, queue.slot_size, first, 0 if in_input_buffer else offset, queue.size)
            )
            first, offset = first + queue.slots, offset + (0 if in_input_buffer else queue.size)
        return tuple(rows)

    @property
    def queue_mode(self) -> str:
        """`bytes` or `slots`: whether a sample in a queue takes its own size, or that of the largest."""
        return "bytes" if any(queue.requested_bytes is not None for queue in self.queues) else "slots"

    @property
    def streams(self) -> bool:
        """Whether a component takes samples of some endpoint piece by piece."""
        return any(queue.streamed for queue in self.queues)

    @property
    def queue_slots(self) -> int:
        """Slots of all queues together."""
        return sum(queue.slots for queue in self.queues)

    @property
    def queues_size(self) -> int:
        """Bytes of all queues together, that in the input buffer left out."""
        queues = (queue for i, queue in enumerate(self.queues) if i != self.reader)
        return sum(queue.size for queue in queues)

    @property
    def queues_room(self) -> int:
        """Bytes of the table for all slots: C has no empty ones."""
        return max(self.queues_size, 4)

    @property
    def lends(self) -> bool:
        """Whether a sample waits in the input buffer."""
        return self.reader is not None

    @property
    def buffer_size(self) -> int:
        """Bytes of the buffer that messages are received in."""
        slot = 0 if self.reader is None else self.queues[self.reader].slot_size
        return max(self.size, self.free + slot)

    @property
    def reliable_mode(self) -> str:
        """`ordered` or `held`: what becomes of a reliable message of the agent that comes before its turn."""
        return "held" if self.reliable_slots > 1 else "ordered"

    @property
    def fragments(self) -> str:
        """`kept`, `refused` or `none`: what becomes of samples that come in fragments.

        Where every sample fits the input buffer, one that does not is too large for its queue as well.
        """
        if not self.receives or not self.reliable_slots:
            return "none"
        return "kept" if self.arrives_in_fragments else "refused"


@dataclass(frozen=True, kw_only=True)
class CreationPlan:
    """How the client's entities come to be at the agent.

    `entities` is preconfigured, reference, xml or binary; `stream` that of CREATE (best_effort, reliable). `size`: of
    the buffer for the largest CREATE, where creation is reliable, else 0. `fragments`: it is larger than a message.
    """

    entities: str = "binary"
    stream: str = "best_effort"
    size: int = 0
    fragments: bool = False

    @property
    def preconfigured(self) -> bool:
        """Whether the agent has the entities before the client comes."""
        return self.entities == "preconfigured"


@dataclass(frozen=True, kw_only=True)
class MemoryPlan:
    """Where messages get memory.

    `message_pools`: storage of `kept_messages` messages of each sender. `fixed_messages`: no message that is sent has
    a string or sequence.
    """

    arena_size: int
    fixed_messages: bool = False
    kept_messages: int = 0
    message_pools: tuple[MessagePool, ...] = ()

    @property
    def mode(self) -> str:
        """`arena` or `none`: what is behind the default allocator."""
        return "arena" if self.arena_size else "none"

    @property
    def messages(self) -> str:
        """`pools` or `allocator`: where strings and sequences get their memory."""
        return "pools" if self.message_pools else "allocator"

    @property
    def pool_headers(self) -> tuple[str, ...]:
        """Headers that declare the elements of the pools, sorted; those of characters and numbers need none."""
        return tuple(sorted({pool.header for pool in self.message_pools if pool.header}))

    @property
    def pool_pointers(self) -> tuple[PoolPointer, ...]:
        """What functions of rosidl_runtime_c name for each kind of element."""
        return pool_pointers(self.message_pools)

    @property
    def refusal(self) -> str:
        """`told` or `never`: whether an encoder can refuse a message."""
        return "never" if self.fixed_messages else "reported"


@dataclass(frozen=True, kw_only=True)
class ErrorsPlan:
    """Form of the error reports. `text_size` 0: codes only."""

    text_size: int

    @property
    def room(self) -> int:
        """Bytes for the text of the last error, with its NUL; a number needs few."""
        return self.text_size or 8

    @property
    def mode(self) -> str:
        """`text` or `code`: which file speaks for errors."""
        return "text" if self.text_size else "code"
