# SPDX-License-Identifier: Apache-2.0
"""Client programs, each compiled once for one plan and one way of liveliness."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.runtime.bench import Bench, ProgramFactory
from tests.support.runtime.harness import build, components, render


@pytest.fixture(scope="session")
def programs(tmp_path_factory: pytest.TempPathFactory) -> ProgramFactory:
    """Return a function that compiles the client for a plan."""

    @cache
    def compiled(plan: RuntimePlan, liveliness: str) -> Path:
        names = [name for name in components(plan, liveliness) if name != "port_posix"]
        tree = render(tmp_path_factory.mktemp("client"), plan, names)
        ping = "client_ping.c" if liveliness == "ping" else "client_no_ping.c"
        read = ["types_read.c" if plan.input.receives else "types.c"]
        read += ["client_read.c" if plan.entities.subscriptions.any else "client_no_read.c"]
        read += ["client_serve.c" if plan.entities.serves else "client_no_serve.c"]
        epoch = "client_time.c" if plan.session.has_time_sync else "client_no_time.c"
        extra = "client_extra.c" if plan.session.has_state and plan.session.has_sleep else "client_no_extra.c"
        port = ["port_fake.c", *(["port_fake_lines.c"] if plan.transport.has_discovery else [])]
        return build(tree, [*port, "client.c", ping, epoch, extra, *read], "client")

    return compiled


@pytest.fixture
def bench(programs: ProgramFactory) -> Iterator[Bench]:
    with ExitStack() as stack:
        yield Bench(programs, stack)
