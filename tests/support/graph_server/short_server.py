# SPDX-License-Identifier: Apache-2.0
"""A short graph server in place of the tool's: what rclpy says of the graph, page by page."""

from __future__ import annotations

import time
from functools import partial
from typing import Any

import rclpy
from rclpy.qos import QoSCompatibility, qos_check_compatible

from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos

OK, UNKNOWN_NODE, INVALID = range(3)
LISTS = ("node", *("topic", "service"), *("publisher", "subscriber", "service", "client"))
LISTS_OF_DDS = ("topic", "publisher", "subscriber")
PUBLISHERS, _, SERVERS, CLIENTS = range(4)
Value = dict[str, Any]


def page(request: Value, found: list[Value], key: str, *names: str) -> Value:
    """Return what the caller has room for, and leave out what has too long a name."""
    items, at, room = list[Value](), request["first"], request["name_size"] or 1 << 16
    while at < len(found) and len(items) < request[f"{key}_max"]:
        if all(len(found[at][name].encode()) < room for name in names):
            items.append(found[at])
        at += 1
    left_out = at - request["first"] > len(items)
    return {"status": OK, "total": len(found), "next": at, "truncated": left_out, key: items}


def list_names(node: Any, request: Value) -> Value:
    what, wanted = request["what"], request["filter"]
    if what >= len(LISTS) + len(LISTS_OF_DDS):
        return {"status": INVALID}
    kind = (*LISTS, *LISTS_OF_DDS)[what]
    of_node = 2 < what < len(LISTS) or what > len(LISTS)
    namespace, _, name = request["node"].rpartition("/")
    found: list[tuple[str, list[str]]]
    options = {"no_demangle": True} if what >= len(LISTS) else {}
    try:
        if kind == "node":
            found = [(f"{ns.rstrip('/')}/{name}", []) for name, ns in node.get_node_names_and_namespaces()]
        elif of_node:
            found = getattr(node, f"get_{kind}_names_and_types_by_node")(name, namespace or "/", **options)
        else:
            found = getattr(node, f"get_{kind}_names_and_types")(**options)
    except RuntimeError:
        return {"status": UNKNOWN_NODE}
    items = [{"name": text, "types": sorted(types)[: request["types_max"]]} for text, types in sorted(found)]
    below = wanted if wanted.endswith("/") else "?"
    chosen = [i for i in items if wanted in ("", i["name"]) or str(i["name"]).startswith(below)]
    return page(request, chosen, "names", "name")


def endpoint(info: Any) -> Value:
    qos = info.qos_profile
    return {
        **{
            policy: getattr(qos, policy).value
            for policy in ("reliability", "durability", "history", "liveliness")
        },
        **{"depth": qos.depth, "deadline": qos.deadline.nanoseconds, "lifespan": qos.lifespan.nanoseconds},
        **{"lease": qos.liveliness_lease_duration.nanoseconds, "gid": list(info.endpoint_gid)[:16]},
        **{"hash_version": info.topic_type_hash.version, "hash": list(info.topic_type_hash.value)},
        **{"node": f"{info.node_namespace.rstrip('/')}/{info.node_name}", "type": info.topic_type},
    }


def match(publisher: Any, subscription: Any) -> bool:
    compatible = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)[0]
    return bool(publisher.topic_type == subscription.topic_type and compatible != QoSCompatibility.ERROR)


def list_endpoints(node: Any, request: Value) -> Value:
    what, topic, matched_by = request["what"], request["name"], request["matched_by"]
    if what in (SERVERS, CLIENTS):
        total = node.count_services(topic) if what == SERVERS else node.count_clients(topic)
        return {"status": OK, "total": total, "next": total}
    found, others = node.get_publishers_info_by_topic(topic), node.get_subscriptions_info_by_topic(topic)
    found, others = (found, others) if what == PUBLISHERS else (others, found)
    if matched_by:
        own = [info for info in others if endpoint(info)["node"] == matched_by]
        same = [
            i
            for i in own
            if all(endpoint(i)[k] == request[k] for k in ("reliability", "durability", "deadline"))
        ]
        if not own:
            return {"status": UNKNOWN_NODE}
        pairs = [(info, o) if what == PUBLISHERS else (o, info) for info in found for o in same or own]
        found = [info for info in found if any(match(*pair) for pair in pairs if info in pair)]
    items = sorted(map(endpoint, found), key=lambda item: (item["node"], item["gid"]))
    return page(request, items, "endpoints", "node", "type")


def main() -> None:
    rclpy.init()
    node, graph = rclpy.create_node("short_graph_server"), {"version": 0}
    with Peer("microros_graph") as peer:
        for name, kind, answer in (
            ("names", "ListNames", list_names),
            ("endpoints", "ListEndpoints", list_endpoints),
        ):
            reply = partial(lambda answer, request: {**answer(node, request), **graph}, answer)
            peer.serve(f"/microros_graph/list_{name}", f"microros_graph_msgs/srv/{kind}", reply)
        qos = Qos(transient_local=True, depth=1)
        changes = peer.publisher("/microros_graph/changes", "microros_graph_msgs/msg/Change", qos)
        peer.on_graph_change(lambda: graph.update(version=(graph["version"] + 1) % (1 << 32)))
        print("graph server ready:", peer.name, flush=True)
        published, due = 0, 0.0
        while True:
            peer.spin_once(0.2)
            if published != graph["version"] and time.monotonic() > due:
                published, due = graph["version"], time.monotonic() + 0.2
                changes.publish(graph)


if __name__ == "__main__":
    main()
