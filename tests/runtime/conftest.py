# SPDX-License-Identifier: Apache-2.0
"""Client programs, each compiled once: with sanitizers, for one plan and one way of liveliness."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.harness import POOL, build, components, render

ProgramFactory = Callable[[RuntimePlan, str], Path]


@pytest.fixture(scope="session")
def programs(tmp_path_factory: pytest.TempPathFactory) -> ProgramFactory:
    """Return a function that compiles the client for a plan."""

    @cache
    def compiled(plan: RuntimePlan, liveliness: str) -> Path:
        names = [name for name in components(plan, liveliness) if name != "port_posix"]
        tree = render(tmp_path_factory.mktemp("client"), plan, names)
        ping = "client_ping.c" if liveliness == "ping" else "client_no_ping.c"
        read = ["types_read.c" if plan.receives else "types.c"]
        read += ["client_read.c" if plan.has_subscriptions else "client_no_read.c"]
        read += ["client_serve.c" if plan.serves else "client_no_serve.c"]
        epoch = "client_time.c" if plan.has_time_sync else "client_no_time.c"
        extra = "client_extra.c" if plan.has_session_state and plan.has_sleep else "client_no_extra.c"
        port = ["port_fake.c", *(["port_fake_lines.c"] if plan.has_discovery else [])]
        return build(tree, [*port, "client.c", ping, epoch, extra, *read], "client")

    return compiled


class Bench:
    """Starts clients and their agents for one test."""

    def __init__(self, programs: ProgramFactory, stack: ExitStack) -> None:
        self._programs = programs
        self._stack = stack

    def start(
        self, plan: RuntimePlan = POOL, liveliness: str = "ping", agent: FakeAgent | None = None
    ) -> Client:
        """Return a client that has made no call yet."""
        return self._stack.enter_context(Client(self._programs(plan, liveliness), agent or FakeAgent()))

    def connected(
        self,
        plan: RuntimePlan = POOL,
        liveliness: str = "ping",
        qos: str = "reliable",
        topic: str = "chatter",
    ) -> Client:
        """Return a client with node 0 and publisher 0 (Int32), whose datagrams so far are forgotten."""
        client = self.start(plan, liveliness)
        name = f"{plan.nodes[0].name} {plan.nodes[0].namespace}" if plan.declared else "talker -"
        for call in ("init", f"node 0 {name}", f"publisher 0 0 Int32 {topic} {qos}"):
            client.ok(call)
        client.sent.clear()
        return client


@pytest.fixture
def bench(programs: ProgramFactory) -> Iterator[Bench]:
    with ExitStack() as stack:
        yield Bench(programs, stack)
