# SPDX-License-Identifier: Apache-2.0
"""A short parameter server in place of the tool's: it holds values in memory, without checks, events and a file.

With `--volatile` it gets no notice of before it started, as if the last one was lost.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos

BEGIN, LIST, _, ACKNOWLEDGE, SET = range(5)
CHANGED = 2


class HeldNode:
    def __init__(self, peer: Peer, name: str, later: Callable[[Callable[[], None]], None]) -> None:
        self.values: dict[str, Any] = {}
        self._client = peer.client(f"{name}/exchange_parameters", "microros_parameter_msgs/srv/Exchange")
        peer.serve(f"{name}/get_parameters", "rcl_interfaces/srv/GetParameters", self._get)
        kind = "rcl_interfaces/srv/SetParameters"
        peer.serve_later(f"{name}/set_parameters", kind, lambda *call: later(partial(self._set, *call)))

    def ask(self, what: int, **members: Any) -> dict[str, Any]:
        self._number += 1
        request = {"what": what, "board": self._board, "session": self._session, "number": self._number}
        return self._client.call({**request, **members}, 2.0) or {}

    def follow(self, notice: dict[str, Any]) -> None:
        """List what the node has, set what is held, acknowledge."""
        self._board, self._session, self._number = notice["board"], random.randrange(1, 1 << 32), 0
        page = first = self.ask(BEGIN)
        items = list(page.get("parameters", ()))
        while page and page["next"] < page["total"]:
            page = self.ask(LIST, first=page["next"])
            items += page.get("parameters", ())
        for item in items:
            value = self.values.setdefault(item["descriptor"]["name"], item["value"])
            if item["change"] == CHANGED:
                self.values[item["descriptor"]["name"]] = item["value"]
            elif value != item["value"]:
                self.ask(SET, parameters=[{"name": item["descriptor"]["name"], "value": value}])
        self.ask(ACKNOWLEDGE, revision=first.get("revision", 0))

    def _get(self, request: dict[str, Any]) -> dict[str, Any]:
        return {"values": [self.values[name] for name in request["names"] if name in self.values]}

    def _set(self, request: dict[str, Any], respond: Callable[[dict[str, Any]], object]) -> None:
        results = []
        for wanted in request["parameters"]:
            result = self.ask(SET, parameters=[wanted]) or {"successful": True, "reason": "held"}
            if result["successful"]:
                self.values[wanted["name"]] = wanted["value"]
            results.append({"successful": result["successful"], "reason": result["reason"]})
        respond({"results": results})


def main() -> None:
    nodes: dict[str, HeldNode] = {}
    work: list[Callable[[], None]] = []

    def follow(notice: dict[str, Any]) -> None:
        if notice["node"] not in nodes:
            nodes[notice["node"]] = HeldNode(peer, notice["node"], work.append)
        nodes[notice["node"]].follow(notice)
        print("follows", notice["node"], flush=True)

    with Peer("microros_parameters") as peer:
        qos = Qos(transient_local="--volatile" not in sys.argv, depth=10)
        kind = "microros_parameter_msgs/msg/Notice"
        peer.subscribe("/microros_parameters/notices", kind, lambda n: work.append(partial(follow, n)), qos)
        print("parameter server ready:", peer.name, flush=True)
        while True:
            peer.spin_once(0.2)
            while work:
                work.pop(0)()


if __name__ == "__main__":
    main()
