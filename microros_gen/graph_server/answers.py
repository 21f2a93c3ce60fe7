# SPDX-License-Identifier: Apache-2.0
"""Responses to requests of microros_graph_msgs, from a graph."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeVar

from microros_gen.ros.endpoints import Value
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphEndpoint, Names

OK, UNKNOWN_NODE, INVALID = 0, 1, 2
"""`status` of both services."""
NODES, TOPICS, SERVICES, PUBLISHERS_OF, SUBSCRIPTIONS_OF, SERVICES_OF, CLIENTS_OF = range(7)
DDS_TOPICS, DDS_PUBLISHERS_OF, DDS_SUBSCRIPTIONS_OF, NODES_WITH_ENCLAVES = range(7, 11)
"""`what` of microros_graph_msgs/srv/ListNames."""
PUBLISHERS, SUBSCRIPTIONS, SERVERS, CLIENTS = range(4)
"""`what` of microros_graph_msgs/srv/ListEndpoints."""
DURABILITY, DEADLINE, LIVELINESS, RELIABILITY = 1 << 1, 1 << 2, 1 << 3, 1 << 4
"""Policies of rmw/qos_policy_kind.h."""
_RELIABLE, _BEST_EFFORT = 1, 2
_TRANSIENT_LOCAL, _VOLATILE = 1, 2
"""Values of rmw/types.h."""
_NAME = re.compile("(?:/[A-Za-z_][A-Za-z0-9_]*)+", re.ASCII)
_Item = TypeVar("_Item")
Version = Callable[[object, object], int]
"""Returns the version of the graph (0 to 2^32 - 1) in which a question, the first argument, has this answer."""
_NOTHING = ((), ())
"""A question without an answer."""


def list_names(graph: Graph, request: Value, version: Version) -> Value:
    """Return the response of ListNames."""
    found = _names(graph, request["what"], request["node"])
    if isinstance(found, int):
        return {"status": found, "version": version(*_NOTHING)}
    chosen = [entry for entry in found if _passes(entry[0], request["filter"])]
    size, types_max = request["name_size"], request["types_max"]

    def item(entry: tuple[str, tuple[str, ...]]) -> tuple[Value | None, bool]:
        name, types = entry
        fitting = [text for text in types if _fits(text, size)][:types_max]
        complete = not types_max or len(fitting) == len(types)
        return ({"name": name, "types": fitting} if _fits(name, size) else None), complete

    of = version((request["what"], request["node"]), found)
    return _page(chosen, request["first"], request["names_max"], item, "names", of)


def list_endpoints(graph: Graph, request: Value, version: Version) -> Value:
    """Return the response of ListEndpoints."""
    what, name, node = request["what"], request["name"], request["matched_by"]
    if not is_name(name):
        return {"status": INVALID, "version": version(*_NOTHING)}
    try:
        if what in (SERVERS, CLIENTS):
            total = graph.count_servers(name) if what == SERVERS else graph.count_clients(name)
            return {"status": OK, "version": version(*_NOTHING), "total": total, "next": total}
        if what not in (PUBLISHERS, SUBSCRIPTIONS):
            return {"status": INVALID, "version": version(*_NOTHING)}
        found: Sequence[GraphEndpoint] | None
        found = graph.publishers(name) if what == PUBLISHERS else graph.subscriptions(name)
        if node:
            others = graph.subscriptions(name) if what == PUBLISHERS else graph.publishers(name)
            found = _matched(what, found, meant([other for other in others if other.node == node], request))
    except RosError:  # a name too long
        return {"status": INVALID, "version": version(*_NOTHING)}
    if found is None:
        return {"status": UNKNOWN_NODE, "version": version(*_NOTHING)}
    size = request["name_size"]

    def item(endpoint: GraphEndpoint) -> tuple[Value | None, bool]:
        fits = _fits(endpoint.node, size) and _fits(endpoint.type, size)
        return (_endpoint(endpoint) if fits else None), True

    of = version((what, name, node, *_qos(request)), tuple(found))
    return _page(found, request["first"], request["endpoints_max"], item, "endpoints", of)


def is_name(name: str) -> bool:
    """Return whether a topic can have this fully qualified name."""
    return _NAME.fullmatch(name) is not None


def match(publisher: GraphEndpoint, subscription: GraphEndpoint) -> bool:
    """Return whether DDS connects them: the same type, and QoS that offers what is requested (DDS 1.4, 2.2.3)."""
    return publisher.type == subscription.type and not incompatibility(publisher, subscription)


def incompatibility(publisher: GraphEndpoint, subscription: GraphEndpoint) -> int:
    """Return the policy that keeps endpoints of one type apart, 0 for none (DDS 1.4, 2.2.3).

    Of several it is the one that Fast DDS reports last: that with the largest number in DDS.
    """
    if publisher.reliability == _BEST_EFFORT and subscription.reliability == _RELIABLE:
        return RELIABILITY
    if publisher.liveliness < subscription.liveliness or publisher.lease > subscription.lease:
        return LIVELINESS
    if publisher.deadline > subscription.deadline:
        return DEADLINE
    if publisher.durability == _VOLATILE and subscription.durability == _TRANSIENT_LOCAL:
        return DURABILITY
    return 0


def meant(own: Sequence[GraphEndpoint], request: Value) -> Sequence[GraphEndpoint]:
    """Return the endpoints of a node that have the QoS of the request; all, if none has or it names none."""
    wanted = _qos(request)
    return [end for end in own if (end.reliability, end.durability, end.deadline) == wanted] or own


def _names(graph: Graph, what: int, node: str) -> Names | int:
    """Return what is listed, or the status of a request that cannot be answered."""
    of_node: dict[int, Callable[[str], Names | None]] = {
        PUBLISHERS_OF: graph.publishers_of,
        SUBSCRIPTIONS_OF: graph.subscriptions_of,
        SERVICES_OF: graph.services_of,
        CLIENTS_OF: graph.clients_of,
        DDS_PUBLISHERS_OF: partial(graph.publishers_of, demangle=False),
        DDS_SUBSCRIPTIONS_OF: partial(graph.subscriptions_of, demangle=False),
    }
    if what in of_node:
        found = of_node[what](node)
        return UNKNOWN_NODE if found is None else found
    if what == NODES:
        return tuple((name, ()) for name in graph.nodes())
    if what == NODES_WITH_ENCLAVES:
        return tuple((name, (enclave,)) for name, enclave in graph.nodes_with_enclaves())
    if what in (TOPICS, DDS_TOPICS):
        return graph.topics(demangle=what == TOPICS)
    return graph.services() if what == SERVICES else INVALID


def _qos(request: Value) -> tuple[int, int, int]:
    return request["reliability"], request["durability"], request["deadline"]


def _matched(
    what: int, found: Sequence[GraphEndpoint], own: Sequence[GraphEndpoint]
) -> Sequence[GraphEndpoint] | None:
    """Return those of `found` that match one of `own`, which are of the other kind; None without any."""
    if not own:
        return None
    if what == PUBLISHERS:
        return [candidate for candidate in found if any(match(candidate, other) for other in own)]
    return [candidate for candidate in found if any(match(other, candidate) for other in own)]


def _page(
    found: Sequence[_Item],
    first: int,
    most: int,
    item: Callable[[_Item], tuple[Value | None, bool]],
    key: str,
    version: int,
) -> Value:
    """Return at most `most` items from index `first`; `item` gives None for what does not fit, and whether all did.

    Items that do not fit do not count, so a page with room for any is empty only after the last one.
    """
    items: list[Value] = []
    truncated, at = False, min(first, len(found))
    while at < len(found) and len(items) < most:
        value, complete = item(found[at])
        if value is not None:
            items.append(value)
        truncated = truncated or value is None or not complete
        at += 1
    return {
        "status": OK,
        "version": version,
        "total": len(found),
        "next": at,
        "truncated": truncated,
        key: items,
    }


def _passes(name: str, wanted: str) -> bool:
    return name.startswith(wanted) if wanted.endswith("/") else wanted in ("", name)


def _fits(text: str, size: int) -> bool:
    return size == 0 or len(text.encode()) < size


def _endpoint(endpoint: GraphEndpoint) -> Value:
    values: dict[str, Any] = {name: getattr(endpoint, name) for name in GraphEndpoint.__dataclass_fields__}
    return {**values, "hash": list(endpoint.hash), "gid": list(endpoint.gid)}
