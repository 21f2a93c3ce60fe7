# SPDX-License-Identifier: Apache-2.0
"""Starts client programs and the scripted agents that they talk to."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import POOL
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent

ProgramFactory = Callable[[RuntimePlan, str], Path]


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
        agent: FakeAgent | None = None,
    ) -> Client:
        """Return a client with node 0 and publisher 0 (Int32), whose datagrams so far are forgotten."""
        client = self.start(plan, liveliness, agent)
        name = (
            f"{plan.entities.nodes.declared[0].name} {plan.entities.nodes.declared[0].namespace}"
            if plan.entities.declared
            else "talker -"
        )
        for call in ("init", f"node 0 {name}", f"publisher 0 0 Int32 {topic} {qos}"):
            client.ok(call)
        client.sent.clear()
        return client
