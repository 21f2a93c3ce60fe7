# SPDX-License-Identifier: Apache-2.0
"""Logger services with a scripted agent: levels, reasons as those of rclpy, and the end of their node."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import build
from tests.support.runtime.serving_agent import ServingAgent, identity
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+logger_services]
logging: callback
nodes: [{name: device, namespace: /arm}]
"""
SERVICES = ("GetLoggerLevels", "SetLoggerLevels")
IDENTITY_SIZE, STEP_MS, SPINS = 24, 20, 12
INVALID = "Failed reason: Invalid logger level."


class Device:
    """The program and its agent."""

    def __init__(self, client: Client, agent: ServingAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec, self._requests = client, agent, codec, 0

    def ask(self, service: str, **members: Any) -> dict[str, Any]:
        self._requests += 1
        body = self._codec.encode(f"rcl_interfaces/srv/{service}_Request", members)[ENCAPSULATION_BYTES:]
        # One place is for a publisher.
        target = ((1 + SERVICES.index(service)) << 4 | 8).to_bytes(2, "big")
        self.client.queued += self.agent.give(target, identity(self._requests) + body)
        for _ in range(SPINS):
            self.client.wait(STEP_MS)
            self.client.ok("spin")
        (reply,) = [
            b[IDENTITY_SIZE:] for b in self.agent.answered if b[:IDENTITY_SIZE] == identity(self._requests)
        ]
        return self._codec.decode(f"rcl_interfaces/srv/{service}_Response", b"\0\1\0\0" + reply)

    def set(self, *levels: tuple[str, int]) -> list[tuple[bool, str]]:
        requested = [{"name": name, "level": level} for name, level in levels]
        results = self.ask("SetLoggerLevels", levels=requested)["results"]
        return [(result["successful"], result["reason"]) for result in results]

    def get(self, *names: str) -> list[tuple[str, int]]:
        levels = self.ask("GetLoggerLevels", names=list(names))["levels"]
        return [(level["name"], level["level"]) for level in levels]


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Device]:
    tree = write_application(tmp_path_factory.mktemp("levels") / "tree", APPLICATION)
    program = build(tree.without_port(), ["port_fake.c", "client_levels.c"], "levels")
    names = tuple(Named(f"rcl_interfaces/srv/{name}", None) for name in SERVICES)
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    codec = Codec(resolve_interfaces(names, finder, Diagnostics()))
    agent = ServingAgent(mtu=400)
    with Client(program, agent) as client:
        client.ok("init")
        yield Device(client, agent, codec)


def test_levels_are_set_and_read(device: Device) -> None:
    assert device.get("arm", "") == [("arm", 0), ("", 20)]
    assert device.set(("arm", 30), ("arm.left", 33), ("arm.right", 4_000_000_000)) == [
        (True, ""),
        (False, INVALID),
        (False, INVALID),
    ]
    assert device.client.ok("level arm").lines == ("level 30",)
    assert device.get("arm.left", "arm") == [("arm.left", 0), ("arm", 30)]
    full = device.set(("a", 10), ("b", 10), ("c", 10), ("d", 10))
    assert full == [(True, "")] * 3 + [(False, "all 4 loggers have a level: set pools: {loggers: 5} for d")]
    assert device.set(("arm", 0), ("a", 0), ("b", 0), ("c", 0)) == [(True, "")] * 4
    assert device.get() == []


def test_the_services_end_with_the_node(device: Device) -> None:
    device.client.ok("end")
    device.client.ok("init")
    assert device.set(("arm", 50)) == [(True, "")]
    device.client.ok("end")
