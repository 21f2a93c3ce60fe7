# SPDX-License-Identifier: Apache-2.0
"""A program with a parameter server, its agent, and the codec for what goes between them."""

from __future__ import annotations

from typing import Any

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client, Result
from tests.support.runtime.parameter_program import IDENTITY_SIZE, STEP_MS
from tests.support.runtime.serving_agent import ServingAgent, identity

SERVICES = {
    "describe_parameters": "DescribeParameters",
    "get_parameter_types": "GetParameterTypes",
    "get_parameters": "GetParameters",
    "list_parameters": "ListParameters",
    "set_parameters": "SetParameters",
    "set_parameters_atomically": "SetParametersAtomically",
}
EVENT = "rcl_interfaces/msg/ParameterEvent"
INTEGER = 2
EVENT_WRITER = 0


def parameter_codec() -> Codec:
    """Return a codec of the six services and the event."""
    names = tuple(Named(f"rcl_interfaces/srv/{name}", None) for name in SERVICES.values())
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces((*names, Named(EVENT, None)), finder, Diagnostics()))


class Device:
    """The program, its agent, and the codec for what goes between them."""

    def __init__(self, client: Client, agent: ServingAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec = client, agent, codec
        self._requests = 0

    def open(self, *names: str) -> None:
        self.client.ok("open")
        for name in names:
            self.client.ok(f"add {name}")

    def ask(self, service: str, **members: Any) -> int:
        """Let DDS have a request; return its number."""
        name = f"rcl_interfaces/srv/{SERVICES[service]}_Request"
        self._requests += 1
        body = identity(self._requests) + self._codec.encode(name, members)[ENCAPSULATION_BYTES:]
        # The event's publisher and that of the application are before the services.
        target = ((2 + list(SERVICES).index(service)) << 4 | 8).to_bytes(2, "big")
        self.client.queued += self.agent.give(target, body)
        return self._requests

    def reply(self, service: str, number: int) -> dict[str, Any]:
        """Return the only reply to the request of this number."""
        (body,) = [b[IDENTITY_SIZE:] for b in self.agent.answered if b[:IDENTITY_SIZE] == identity(number)]
        return self._codec.decode(f"rcl_interfaces/srv/{SERVICES[service]}_Response", b"\0\1\0\0" + body)

    def call(self, service: str, **members: Any) -> dict[str, Any]:
        number = self.ask(service, **members)
        self.spin(12)
        return self.reply(service, number)

    def set(self, *pairs: tuple[str, int]) -> int:
        values = [{"name": n, "value": {"type": INTEGER, "integer_value": v}} for n, v in pairs]
        return self.ask("set_parameters", parameters=values)

    def spin(self, times: int) -> list[Result]:
        """Let the executor run; return what failed."""
        failed = []
        for _ in range(times):
            self.client.wait(STEP_MS)
            result = self.client.call("spin")
            failed += [result] if result.code else []
        return failed

    def events(self) -> list[dict[str, list[str]]]:
        """Return the names in each event so far."""
        writer = (EVENT_WRITER << 4 | 5).to_bytes(2, "big")
        bodies = [body for target, body in self.agent.written if target == writer]
        found = [self._codec.decode(EVENT, b"\0\1\0\0" + body) for body in bodies]
        kinds = ("new_parameters", "changed_parameters", "deleted_parameters")
        return [{k[:3]: [p["name"] for p in e[k]] for k in kinds if e[k]} for e in found]
