# SPDX-License-Identifier: Apache-2.0
"""Topics whose messages are delivered inside the image: their ends agree, queues of C structures, and routes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.agentless.plan import in_c, is_alone
from microros_gen.components.local_delivery.check import MOST_SLOTS, check_topics
from microros_gen.components.local_delivery.copies import copy_lines, get_body, put_body
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import include_path
from microros_gen.typesupport.plan.size import is_fixed
from microros_gen.typesupport.plan.types import TypePlan

_NONE = "RMW_LOCAL_NONE"


@dataclass(frozen=True)
class LocalQueue:
    """The queue of a subscription: `slots` messages, `only` (as C writes it) those of the image.

    `storage` begins the names of that of its type; empty: it needs none. `put` and `get`: how a
    message is copied to a slot and from it, as C.
    """

    index: int
    subscription: int
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
        return (
            f"{{local_deliver_{i}, local_route_{i}, {len(self.queues)}, {in_c(self.only)}, {in_c(self.checks)}}}"
        )


@dataclass(frozen=True, kw_only=True)
class LocalPlan:
    """`queue_of`: of each subscription, as C.

    `copies` are functions that the queues call, as lines of C; `headers`: of the types and of their storage.
    """

    queues: tuple[LocalQueue, ...]
    queue_of: tuple[str, ...]
    routes: tuple[LocalRoute, ...]
    copies: tuple[str, ...]
    headers: tuple[str, ...]
    shown: str

    @property
    def queue_count(self) -> int:
        """Return the number of queues."""
        return len(self.queues)


def plan(context: PlanContext, diagnostics: Diagnostics) -> LocalPlan:
    """Return the queues and routes; ends of a topic that do not agree are reported."""
    application = context.application
    check_topics(context, diagnostics)
    queues = tuple(_queues(application, context.types))
    places = context.runtime.entities
    subscriptions = [_NONE] * places.subscriptions.max
    for queue in queues:
        subscriptions[queue.subscription] = str(queue.index)
    types = [queue.type for queue in queues]
    messages = {name: known.message for name, known in context.types.items()}
    return LocalPlan(
        queues=queues,
        queue_of=tuple(subscriptions),
        routes=tuple(_routes(context, queues)),
        copies=copy_lines(types, messages),
        headers=tuple(sorted({h for name in types for h in _headers(context.types[name])})),
        shown=_shown(application, is_alone(application)),
    )


def record(part: LocalPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "queues": [[q.subscription, q.slots] for q in part.queues],
        "routes": [[list(r.queues), r.only] for r in part.routes],
    }


def slots_of(endpoint: EndpointDecl) -> int:
    """Return how many messages wait: `queue`, otherwise the depth."""
    return min(endpoint.queue or max(endpoint.qos.depth, 1), MOST_SLOTS)


def _queues(application: Application, types: Mapping[TypeName, TypePlan]) -> Iterable[LocalQueue]:
    messages = {name: known.message for name, known in types.items()}
    index = 0
    for subscription, (_, node, endpoint) in enumerate(declarations(application, "subscription")):
        if endpoint.local == "never":
            continue
        name, topic = type_name(endpoint.type), full_name(node, endpoint)
        storage = types[name].storage_name(topic) if types[name].storage else ""
        yield LocalQueue(
            *(index, subscription, topic, name, types[name].c_name, slots_of(endpoint), storage),
            put_body(name, messages, f"local_messages_{index}[index]"),
            get_body(name, messages, f"local_messages_{index}[index]"),
            in_c(endpoint.local == "only"),
        )
        index += 1


def _key(node: NodeDecl, endpoint: EndpointDecl) -> tuple[int, str]:
    return node.domain_id, full_name(node, endpoint)


def _routes(context: PlanContext, queues: tuple[LocalQueue, ...]) -> Iterable[LocalRoute]:
    readers = declarations(context.application, "subscription")
    messages = {name: known.message for name, known in context.types.items()}
    by_topic: dict[tuple[int, str], list[int]] = {}
    for queue in queues:
        _, node, endpoint = readers[queue.subscription]
        by_topic.setdefault(_key(node, endpoint), []).append(queue.index)
    index = 0
    for index, (_, node, endpoint) in enumerate(declarations(context.application, "publisher"), 1):
        found = tuple(by_topic.get(_key(node, endpoint), ())) if endpoint.local != "never" else ()
        checks = not is_fixed(messages[type_name(endpoint.type)], messages)
        yield LocalRoute(index - 1, found, endpoint.local == "only", checks)
    for other in range(index, context.runtime.entities.publisher_places):
        yield LocalRoute(other, (), False, False)


def _headers(type_: TypePlan) -> Iterable[str]:
    yield include_path(type_.files.struct)
    if type_.storage:
        yield include_path(type_.files.storage)


def _shown(application: Application, alone: bool) -> str:
    """Return what a report says: the topics, and of each whether its messages leave the image."""
    words = {
        full_name(node, endpoint): f"{full_name(node, endpoint)} ({endpoint.local})"
        for _, node, endpoint in declarations(application, "subscription")
        if endpoint.local != "never"
    }
    return ", ".join(words.values()) + ("; no agent is needed" if alone else "")
