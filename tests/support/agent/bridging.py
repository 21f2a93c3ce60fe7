# SPDX-License-Identifier: Apache-2.0
"""The bridge in the test's own process, and how a test waits for what it gives."""

from __future__ import annotations

import select
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import pytest

from microros_gen.agent.representation import Service
from microros_gen.agent.ros.bridge import Bridge, GraphReport, HashOf, Source
from microros_gen.agent.ros.rclpy_bridge import open_bridge
from tests.support.agent.process import environment
from tests.support.patience import deadline

GET_TYPES = "rcl_interfaces/srv/GetParameterTypes"
"""A service that every rclpy has: a list of names, answered by as many bytes."""


@dataclass(eq=False)
class Bridged:
    """An open bridge, and what it reported."""

    bridge: Bridge
    domain: int
    reports: list[GraphReport]

    def take(self, source: Any, count: int, timeout_s: float = 15.0) -> list[Any]:
        """Wait for `count` things from one source, as the core does; return them."""
        found: list[Any] = []
        self.wait(lambda: len(found) >= count, {source: found.append}, timeout_s)
        return found

    def wait(
        self,
        done: Callable[[], object],
        sources: dict[Any, Callable[[Any], object]] | None = None,
        timeout_s: float = 15.0,
    ) -> None:
        """Serve `sources` until `done`; only what the bridge names is looked at."""
        end = deadline(timeout_s)
        while not done():
            assert time.monotonic() < end, f"not seen; reports: {[str(r) for r in self.reports]}"
            for source in self.named(0.05):
                take = (sources or {}).get(source)
                while take and (taken := source.take()) is not None:  # type: ignore[attr-defined]
                    take(taken)

    def wait_for(self, seconds: float) -> None:
        """Let the bridge work for some time."""
        end = time.monotonic() + seconds
        self.wait(lambda: time.monotonic() > end)

    def named(self, timeout_s: float = 0.0) -> list[Source]:
        """Return what the bridge names when its descriptor is readable."""
        readable, _, _ = select.select([self.bridge.fileno()], [], [], timeout_s)
        return self.bridge.ready() if readable else []


@contextmanager
def opened(
    domain: int, hash_of: HashOf | None = None, maximum_domains: int = 4, request_wait_s: float = 5.0
) -> Iterator[Bridged]:
    """Open a bridge that keeps to this machine."""
    reports: list[GraphReport] = []
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment(domain).items():
            patch.setenv(name, value)
        bridge = open_bridge(maximum_domains, None, hash_of, reports.append, request_wait_s)
        try:
            yield Bridged(bridge, domain, reports)
        finally:
            bridge.close()


def get_types(name: str) -> Service:
    """Return the service `name` of the type that the observer serves and calls, as a client describes it."""
    types = "rcl_interfaces::srv::dds_::GetParameterTypes_{}_"
    return Service(
        f"/{name}", types.format("Request"), types.format("Response"), f"rq/{name}Request", f"rr/{name}Reply"
    )


def names_body(names: list[str], byteorder: str = "little") -> bytes:
    """Return the CDR of a request: encapsulation, count, and each name with its length."""
    order: Any = byteorder
    body = len(names).to_bytes(4, order)
    for name in names:
        body += bytes(-len(body) % 4) + (len(name) + 1).to_bytes(4, order) + name.encode() + b"\0"
    return (b"\0\1\0\0" if byteorder == "little" else b"\0\0\0\0") + body


def types_body(types: list[int]) -> bytes:
    """Return the CDR of a response."""
    return b"\0\1\0\0" + len(types).to_bytes(4, "little") + bytes(types)


def read_names(serialized: bytes) -> list[str]:
    """Read a request."""
    assert serialized[:4] == b"\0\1\0\0"
    body, at, names = serialized[4:], 4, []
    for _ in range(int.from_bytes(body[:4], "little")):
        at += -at % 4
        size = int.from_bytes(body[at : at + 4], "little")
        names.append(body[at + 4 : at + 3 + size].decode())
        at += 4 + size
    return names


def read_types(serialized: bytes) -> list[int]:
    """Read a response."""
    assert serialized[:4] == b"\0\1\0\0"
    return list(serialized[8 : 8 + int.from_bytes(serialized[4:8], "little")])
