# SPDX-License-Identifier: Apache-2.0
"""Topics whose messages are delivered inside the image: their ends agree, queues of C structures, and routes."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.application.kinds import NAMES, RECEIVING, EntityKind
from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.agentless.plan import in_c, is_alone
from microros_gen.components.local_delivery.check import MOST_SLOTS, check_topics
from microros_gen.components.local_delivery.check_services import SERVICE_SLOTS, check_services
from microros_gen.components.local_delivery.check_shared import check_count, check_memory, check_shared
from microros_gen.components.local_delivery.copies import copy_lines, get_body, put_body
from microros_gen.components.local_delivery.shared import (
    IMAGE_WORDS,
    WORD,
    ChipRing,
    SharedRing,
    chip_rings,
    key_of,
    own_rings,
    shown_pairs,
)
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import include_path
from microros_gen.typesupport.plan.size import is_fixed
from microros_gen.typesupport.plan.storage_units import StorageMember
from microros_gen.typesupport.plan.types import TypePlan

_NONE = "RMW_LOCAL_NONE"


@dataclass(frozen=True)
class LocalQueue:
    """The queue of an endpoint that receives: `slots` messages, `only` (as C writes it) those of the image.

    `storage` begins the names of that of its type; empty: it needs none. `put` and `get`: how a
    message is copied to a slot and from it, as C.
    """

    index: int
    kind: str
    receiver: int
    topic: str
    type: TypeName
    c_type: str
    slots: int
    storage: str
    put: tuple[str, ...]
    get: tuple[str, ...]
    only: str

    @property
    def storage_lines(self) -> tuple[str, ...]:
        """The memory of strings and sequences, and the function that binds it, as lines of C."""
        if not self.storage:
            return ()
        i = self.index
        return (
            f"static {self.storage}__Storage local_storage_{i}[{self.slots}];",
            "",
            f"static void local_bind_{i}(void)",
            "{",
            f"  for (size_t i = 0; i < {self.slots}u; ++i) {{",
            f"    {self.storage}__bind(&local_messages_{i}[i], &local_storage_{i}[i]);",
            "  }",
            "}",
        )

    @property
    def origins(self) -> str:
        """What C calls the origins of waiting requests or replies: NULL for a subscription."""
        return "NULL" if self.kind == "subscription" else f"local_origins_{self.index}"

    @property
    def origin_lines(self) -> tuple[str, ...]:
        """Their memory, as lines of C."""
        if self.kind == "subscription":
            return ()
        return (f"static rmw_local_origin_t local_origins_{self.index}[{self.slots}];",)

    @property
    def bind(self) -> str:
        """The C function that gives each slot its storage: NULL without such."""
        return f"local_bind_{self.index}" if self.storage else "NULL"


@dataclass(frozen=True)
class LocalRoute:
    """Where the messages of a publisher go: to `queues`, and to the agent unless `only`.

    `checks`: its messages can be above their limits.
    """

    index: int
    queues: tuple[int, ...]
    only: bool
    checks: bool

    @property
    def lines(self) -> tuple[str, ...]:
        """The list of queues and the function that delivers to them, as lines of C."""
        if not self.queues:
            return ()
        queues = ", ".join(map(str, self.queues))
        return (
            "",
            f"static const uint8_t local_route_{self.index}[] = {{{queues}}};",
            "",
            f"static void local_deliver_{self.index}(xrce_client_t * client, const void * message)",
            "{",
            "  const uint32_t now = port_time_ms();",
            "",
            *(
                f"  rmw_local_deliver(client, &rmw_local_queues[{i}], &rmw_local_states[{i}], message, now);"
                for i in self.queues
            ),
            "}",
        )

    @property
    def entry(self) -> str:
        """The entry of the table of routes."""
        if not self.queues:
            return "{NULL, NULL, 0, false, false}"
        i = self.index
        return f"{{local_deliver_{i}, local_route_{i}, {len(self.queues)}, {in_c(self.only)}, {in_c(self.checks)}}}"


@dataclass(frozen=True, kw_only=True)
class LocalPlan:
    """`queue_of`: of each receiver, as C.

    `server_of`: the queue of each client's server, as C, and an end. `services`: there is such a server, or one in
    another image. `chip_rings` are those of topics and services between the images of the chip, `rings` those with an
    end in this image, `ring_of`: the first one of each endpoint (that of the requests of a service), as C.
    `chip_images`: how many there are, `shared_image`: the position of this one among them. `memory_limit`: bytes of the
    shared memory, if known.
    `copies` are functions that the queues call, as lines of C; `headers`: of the types and of their storage.
    What they copy is bounded by `text`, the characters of the longest string of a type and its terminator, `elements`
    of the longest sequence of strings or messages, and `room`, the bytes of all strings and sequences of a message.
    """

    queues: tuple[LocalQueue, ...]
    queue_of: tuple[str, ...]
    server_of: tuple[str, ...]
    services: bool
    routes: tuple[LocalRoute, ...]
    copies: tuple[str, ...]
    text: int
    elements: int
    room: int
    headers: tuple[str, ...]
    chip_rings: tuple[ChipRing, ...]
    rings: tuple[SharedRing, ...]
    ring_of: tuple[str, ...]
    chip_images: int
    shared_image: int
    memory_limit: int | None
    shown: str

    @property
    def shared(self) -> bool:
        """Return whether a topic or service leads to another image of the chip."""
        return bool(self.rings)

    @property
    def calls(self) -> bool:
        """Return whether a service does."""
        return any(ring.ring.part for ring in self.rings)

    @property
    def hears(self) -> bool:
        """Return whether messages of another image arrive."""
        return any(not ring.sends for ring in self.rings)

    @property
    def group(self) -> bool:
        """Return whether the chip has more than two images, so that an endpoint can have several rings."""
        return self.shared and self.chip_images > 2

    @property
    def pair(self) -> bool:
        """Return whether it has two."""
        return self.shared and not self.group

    @property
    def shared_key(self) -> int:
        """Return the number that all images have."""
        return key_of(self.chip_rings, self.chip_images)

    @property
    def shared_own(self) -> int:
        """Return where the words of this image are in the shared memory."""
        return self.shared_image * IMAGE_WORDS

    @property
    def shared_other(self) -> int:
        """Return where those of the other image are, if there are two."""
        return IMAGE_WORDS - self.shared_own

    @property
    def ring_count(self) -> int:
        """Return the number of rings."""
        return len(self.rings)

    @property
    def ring_words(self) -> int:
        """Return the size of the shared memory, words of 4 bytes."""
        return max((ring.end for ring in self.chip_rings), default=0)

    @property
    def shared_bytes(self) -> int:
        """Return the same in bytes."""
        return self.ring_words * WORD

    @property
    def shared_shown(self) -> str:
        """Return what a report says of the shared memory."""
        limit = "" if self.memory_limit is None else f" of {self.memory_limit}"
        return f"{self.shared_bytes} bytes{limit}: {', '.join(shown_pairs(self.chip_rings))}"

    @property
    def queue_count(self) -> int:
        """Return the number of queues."""
        return len(self.queues)


def plan(context: PlanContext, diagnostics: Diagnostics) -> LocalPlan:
    """Return the queues and routes; ends of a topic that do not agree are reported."""
    application = context.application
    chip = application.chip
    check_topics(context, diagnostics)
    check_services(context, diagnostics)
    check_shared(context, diagnostics)
    queues = tuple(_queues(context))
    receivers = [_NONE] * sum(context.runtime.entities.places(kind.name).max for kind in RECEIVING)
    for queue in queues:
        receivers[queue.receiver] = str(queue.index)
    all_rings = chip_rings(context)
    check_memory(all_rings, application, diagnostics)
    shared = own_rings(all_rings, context)
    check_count(shared, diagnostics)
    ring_of: dict[int, str] = {}
    for index, ring in enumerate(shared):
        ring_of.setdefault(ring.endpoint, str(index))
    endpoints = context.runtime.entities.publisher_places + len(receivers)
    servers = tuple(_servers(context, queues))
    types = [queue.type for queue in queues]
    messages = {name: known.message for name, known in context.types.items()}
    stored = [m for known in context.types.values() for unit in known.storage for m in unit.members]
    return LocalPlan(
        queues=queues,
        queue_of=tuple(receivers),
        server_of=(*servers, _NONE),
        services=any(ring.ring.part for ring in shared) or any(server != _NONE for server in servers),
        routes=tuple(_routes(context, queues)),
        copies=copy_lines(types, messages),
        text=max((m.dimensions[-1] for m in stored if m.characters), default=0),
        elements=max((n for m in stored if not m.primitive for n in _elements(m)), default=0),
        room=max((n for known in context.types.values() for n in _rooms(known)), default=0),
        headers=tuple(sorted({h for name in types for h in _headers(context.types[name])})),
        chip_rings=all_rings,
        rings=shared,
        chip_images=len(chip.images) + 1 if chip else 0,
        shared_image=chip.position if chip else 0,
        memory_limit=chip.memory if chip else None,
        ring_of=tuple(ring_of.get(place, _NONE) for place in range(endpoints)),
        shown=_shown(application, is_alone(application)),
    )


def _elements(member: StorageMember) -> Iterable[int]:
    return member.dimensions[:-1] if member.characters else member.dimensions


def _rooms(known: TypePlan) -> Iterable[int]:
    return (*known.storage_sizes, *(size for sizes in known.topic_sizes.values() for size in sizes))


def record(part: LocalPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "queues": [[q.receiver, q.slots] for q in part.queues],
        "routes": [[list(r.queues), r.only] for r in part.routes],
        "servers": list(part.server_of),
        "rings": [part.shared_key, part.shared_image, [ring.endpoint for ring in part.rings]],
    }


def slots_of(endpoint: EndpointDecl) -> int:
    """Return how many messages wait: `queue`, otherwise the depth."""
    return min(endpoint.queue or max(endpoint.qos.depth, 1), MOST_SLOTS)


def _queues(context: PlanContext) -> Iterable[LocalQueue]:
    """Yield the queues in the order of the places: of subscriptions, of services and of clients."""
    types = context.types
    messages = {name: known.message for name, known in types.items()}
    index = first = 0
    for kind in RECEIVING:
        for place, (_, node, endpoint) in enumerate(declarations(context.application, kind.name), first):
            if endpoint.local == "never":
                continue
            name, topic = _received(kind, endpoint), full_name(node, endpoint)
            storage = types[name].storage_name(topic) if types[name].storage else ""
            slot = f"local_messages_{index}[index]"
            yield LocalQueue(
                *(index, kind.name, place, topic, name, types[name].c_name),
                *(_slots(kind, endpoint), storage, put_body(name, messages, slot)),
                *(get_body(name, messages, slot), in_c(endpoint.local != "also")),
            )
            index += 1
        first += context.runtime.entities.places(kind.name).max


def _received(kind: EntityKind, endpoint: EndpointDecl) -> TypeName:
    """Return the type of what an endpoint receives."""
    name = type_name(endpoint.type, kind.type_kind)
    return derived_name(name, kind.receives[0]) if kind.service_type else name


def _slots(kind: EntityKind, endpoint: EndpointDecl) -> int:
    return endpoint.queue or SERVICE_SLOTS if kind.service_type else slots_of(endpoint)


def _servers(context: PlanContext, queues: tuple[LocalQueue, ...]) -> Iterable[str]:
    """Yield for each place of a client the queue of its server in the image, as C."""
    requesting = RECEIVING[-1]
    subscriptions = context.runtime.entities.subscriptions.max
    queue_of = {queue.receiver - subscriptions: queue.index for queue in queues if queue.kind == "service"}
    services = {
        _key(node, endpoint): index
        for index, (_, node, endpoint) in enumerate(declarations(context.application, "service"))
    }
    declared = declarations(context.application, requesting.name)
    for _, node, endpoint in declared:
        server = services.get(_key(node, endpoint)) if endpoint.local != "never" else None
        yield _NONE if server is None else str(queue_of.get(server, _NONE))
    yield from (_NONE for _ in range(context.runtime.entities.places(requesting.name).max - len(declared)))


def _key(node: NodeDecl, endpoint: EndpointDecl) -> tuple[int, str]:
    return node.domain_id, full_name(node, endpoint)


def _routes(context: PlanContext, queues: tuple[LocalQueue, ...]) -> Iterable[LocalRoute]:
    readers = declarations(context.application, "subscription")
    messages = {name: known.message for name, known in context.types.items()}
    by_topic: dict[tuple[int, str], list[int]] = {}
    for queue in queues:
        if queue.kind != "subscription":
            continue
        _, node, endpoint = readers[queue.receiver]
        by_topic.setdefault(_key(node, endpoint), []).append(queue.index)
    index = 0
    for index, (_, node, endpoint) in enumerate(declarations(context.application, "publisher"), 1):
        found = tuple(by_topic.get(_key(node, endpoint), ())) if endpoint.local != "never" else ()
        checks = not is_fixed(messages[type_name(endpoint.type)], messages)
        yield LocalRoute(index - 1, found, endpoint.local == "only", checks)
    for other in range(index, context.runtime.entities.publisher_places or 1):
        yield LocalRoute(other, (), False, False)


def _headers(type_: TypePlan) -> Iterable[str]:
    yield include_path(type_.files.struct)
    if type_.storage:
        yield include_path(type_.files.storage)


def _shown(application: Application, alone: bool) -> str:
    """Return what a report says: the topics, and of each whether its messages leave the image."""
    words = {
        full_name(node, endpoint): f"{full_name(node, endpoint)} ({endpoint.local})"
        for _, node, endpoint in declarations(application, *NAMES)
        if endpoint.local == "chip"
        or (endpoint.local != "never" and endpoint.kind in ("subscription", "service"))
    }
    return ", ".join(words.values()) + ("; no agent is needed" if alone else "")
