# SPDX-License-Identifier: Apache-2.0
"""The agent of serving_agent.py and another node with parameters, which answers as rclcpp or as the test says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.serving_agent import ServingAgent

LITTLE = b"\0\1\0\0"
CALLS = (
    *("GetParameters", "SetParameters", "SetParametersAtomically"),
    *("ListParameters", "DescribeParameters", "GetParameterTypes"),
)
"""The clients, in the order of the component's plan."""
EVENT = "rcl_interfaces/msg/ParameterEvent"
MEMBERS = {
    1: "bool_value",
    2: "integer_value",
    3: "double_value",
    4: "string_value",
    5: "byte_array_value",
    6: "bool_array_value",
    7: "integer_array_value",
    8: "double_array_value",
    9: "string_array_value",
}


def value(kind: int, content: Any = None) -> dict[str, Any]:
    """Return a ParameterValue of a type."""
    return {"type": kind} | ({MEMBERS[kind]: content} if kind else {})


@dataclass
class ParameterAgent(ServingAgent):
    """`parameters` are those of the other node, by name, each with its type and content.

    `descriptors` has what it says of a parameter besides name and type. `running`: it answers. `rejects` has the reason
    why a parameter is not set. `known_alone`: an unknown name among those that are got makes the response empty, as
    rclcpp does. `change` gets each response before it is encoded, and `damage` its bytes. `seen` are the requests.
    """

    first_client: int = 0
    reader: int = 0
    parameters: dict[str, tuple[int, Any]] = field(default_factory=dict)
    descriptors: dict[str, dict[str, Any]] = field(default_factory=dict)
    rejects: dict[str, str] = field(default_factory=dict)
    running: bool = True
    known_alone: bool = True
    change: Callable[[dict[str, Any]], dict[str, Any]] = lambda response: response
    damage: Callable[[bytes], bytes] = lambda body: body
    seen: list[tuple[str, dict[str, Any]]] = field(default_factory=list)
    late: list[tuple[bytes, bytes]] = field(default_factory=list)
    codec: Codec = field(default_factory=lambda: parameter_codec())

    def event(self, node: str, **lists: list[tuple[str, int, Any]]) -> list[bytes]:
        """Return the datagrams of an event: `new`, `changed` and `deleted` are parameters."""
        names = {"new": "new_parameters", "changed": "changed_parameters", "deleted": "deleted_parameters"}
        members = {
            names[key]: [{"name": name, "value": value(kind, content)} for name, kind, content in listed]
            for key, listed in lists.items()
        }
        return self.offer(self.reader, self.encoded(EVENT, {"node": node, **members}))

    def encoded(self, name: str, message: dict[str, Any]) -> bytes:
        return self.codec.encode(name, message)[ENCAPSULATION_BYTES:]

    def answer_late(self) -> list[bytes]:
        """Return the datagrams of the responses that were not sent, while it did not run."""
        sent = [d for target, body in self.late for d in self.give(target, body)]
        self.late.clear()
        return sent

    def _write(self, payload: bytes) -> None:
        super()._write(payload)
        place = (int.from_bytes(payload[2:4], "big") >> 4) - self.first_client
        if payload[2:4] not in self.objects or payload[3] & 15 != 7 or not 0 <= place < len(CALLS):
            return
        kind = f"rcl_interfaces/srv/{CALLS[place]}"
        request = self.codec.decode(f"{kind}_Request", LITTLE + payload[4:])
        self.seen.append((CALLS[place], request))
        response = self.change(self._answer(CALLS[place], request))
        body = payload[:2] + payload[2:4] + self.damage(self.encoded(f"{kind}_Response", response))
        if self.running:
            self.history.setdefault(payload[2:4], []).append(body)
        else:
            self.late.append((payload[2:4], body))

    def _answer(self, call: str, request: dict[str, Any]) -> dict[str, Any]:
        if call == "GetParameters":
            found = [value(*self.parameters.get(name, (0, None))) for name in request["names"]]
            all_known = all(name in self.parameters for name in request["names"])
            return {"values": found if all_known or not self.known_alone else []}
        if call in ("DescribeParameters", "GetParameterTypes"):
            return self._describe(call, request["names"])
        if call == "ListParameters":
            starts = tuple(request["prefixes"]) or ("",)
            names = [name for name in self.parameters if name.startswith(starts)]
            return {"result": {"names": names, "prefixes": []}}
        results = [self._result(p["name"]) for p in request["parameters"]]
        failed = next((result for result in results if not result["successful"]), None)
        for parameter, result in zip(request["parameters"], results, strict=True):
            kind = parameter["value"]["type"]
            if result["successful"] and (call == "SetParameters" or failed is None):
                content = parameter["value"][MEMBERS[kind]] if kind else None
                self.parameters[parameter["name"]] = (kind, content)
        if call == "SetParameters":
            return {"results": results}
        return {"result": failed or {"successful": True, "reason": ""}}

    def _describe(self, call: str, names: list[str]) -> dict[str, Any]:
        kinds = [self.parameters.get(name, (0, None))[0] for name in names]
        known = all(name in self.parameters for name in names) or not self.known_alone
        if call == "GetParameterTypes":
            return {"types": bytes(kinds) if known else b""}
        described = [
            {"name": name, "type": kind, **self.descriptors.get(name, {})}
            for name, kind in zip(names, kinds, strict=True)
        ]
        return {"descriptors": described if known else []}

    def _result(self, name: str) -> dict[str, Any]:
        return {"successful": name not in self.rejects, "reason": self.rejects.get(name, "")}


def parameter_codec() -> Codec:
    """Return a codec of the services and of the event."""
    names = (*(Named(f"rcl_interfaces/srv/{call}", None) for call in CALLS), Named(EVENT, None))
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces(names, finder, Diagnostics()))
