# SPDX-License-Identifier: Apache-2.0
"""Ping, time and the search for agents, in every state of the session, on every transport, with and without a lock.

The one line of a board is closed for all when anybody closes it (c/port_fake_lines.c). A program that opens it twice,
or uses it without the lock, ends.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import POOL, changed
from tests.support.runtime.discovery import info, locator
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import build, components, quick, quick_with_constructors, render
from tests.support.runtime.time_sync import EPOCH_NS, TimedAgent, answer, moment
from tests.support.runtime.wires import Datagrams, Frames, Lengths, Wire

BASE = changed(POOL, session__has_time_sync=True)
PLANS = {
    "udp": changed(BASE, transport__has_discovery=True),
    "tcp": changed(BASE, transport__kind="tcp", transport__has_discovery=True),
    "serial": changed(BASE, transport__kind="serial"),
    "custom-framed": changed(BASE, transport__kind="custom", transport__framing="on"),
    "custom-packets": changed(BASE, transport__kind="custom", transport__framing="off"),
}
WIRES: dict[str, type[Wire]] = {
    "udp": Datagrams,
    "tcp": Lengths,
    "serial": Frames,
    "custom-framed": Frames,
    "custom-packets": Datagrams,
}
PERIOD = POOL.times.liveliness_period_ms
LOST_MS = PERIOD * (POOL.times.liveliness_attempts + 1)
FIXTURES = ("port_fake.c", "port_fake_lines.c", "client.c", "client_ping.c", "client_time.c", "types.c")
NONE = ("client_no_read.c", "client_no_serve.c", "client_no_extra.c")


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory):  # type: ignore[no-untyped-def]
    @cache
    def compiled(plan: RuntimePlan) -> Path:
        names = [name for name in components(plan) if name != "port_posix"]
        tree = render(tmp_path_factory.mktemp("states"), plan, names)
        # Functions of an application are chosen before main().
        by = quick_with_constructors() if plan.transport.kind == "custom" else quick()
        return build(tree, [*FIXTURES, *NONE], "states", *by)

    return compiled


@pytest.fixture(
    params=[
        pytest.param((name, lock), marks=[pytest.mark.variant] if lock and name != "udp" else [])
        for name in PLANS
        for lock in (False, True)
    ],
    ids=lambda param: f"{param[0]}{'-locked' if param[1] else ''}",
)
def client(request: pytest.FixtureRequest, program) -> Iterator[Client]:  # type: ignore[no-untyped-def]
    """A client of each transport that has made no call yet."""
    name, multithread = request.param
    plan = changed(PLANS[name], session__multithread=multithread)
    agent = TimedAgent(reply=lambda o: [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)])
    with ExitStack() as stack:
        yield stack.enter_context(Client(program(plan), agent, WIRES[name]()))


def silence(client: Client, silent: bool) -> None:
    client.agent.silent = silent
    assert isinstance(client.agent, TimedAgent)
    client.agent.reply = lambda o: [] if silent else [answer(moment(EPOCH_NS), moment(EPOCH_NS), o)]


def connect(client: Client) -> None:
    for call in ("init", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        client.ok(call)


def works(client: Client, value: int) -> None:
    """Whether what is published now arrives."""
    client.ok(f"publish 0 {value}")
    client.ok("flush 1000")
    assert client.agent.values()[-1] == value


def lose(client: Client) -> None:
    """Let the agent be gone, until the session is looked for."""
    silence(client, True)
    client.spin(LOST_MS // 10 + 2, 10)
    assert client.call("connected").code == 0


def test_before_the_first_session(client: Client) -> None:
    assert client.call("ping 10 2").code == 0
    silence(client, True)
    result = client.call("ping 10 2")
    assert result.code == 1
    assert result.error.startswith("no agent answers")
    assert 20 <= result.slept <= 24
    silence(client, False)
    assert client.call("epoch_sync 100").error == "session: NULL or not initialized"
    connect(client)
    works(client, 1)


def test_within_a_session(client: Client) -> None:
    connect(client)
    assert client.call("ping 10 1").code == 0
    assert client.call("ping_options 10 1 127.0.0.1 8888").code == 0
    client.ok("epoch_sync 100")
    works(client, 1)
    silence(client, True)
    result = client.call("ping 10 2")
    assert result.code == 1
    assert result.error.startswith("no agent answers"), "in a session too"
    silence(client, False)
    works(client, 2)
    assert client.statistics()["reconnects"] == 0


def test_while_the_session_is_looked_for(client: Client) -> None:
    connect(client)
    works(client, 1)
    lose(client)
    for call in ("ping 10 2", "ping_options 10 2 127.0.0.1 8888", "epoch_sync 20"):
        result = client.call(call)
        assert result.code == 1, call
        assert result.error.startswith("no agent answers")
        assert 20 <= result.slept <= 24, call
    client.spin(50, 50)
    client.sent.clear()
    silence(client, False)
    assert client.call("ping 10 5").code == 0
    client.spin(20, 10)
    assert client.statistics()["reconnects"] == 1
    works(client, 2)


def test_a_ping_that_is_answered_brings_the_session_back_soon(client: Client) -> None:
    connect(client)
    lose(client)
    client.spin(100, 100)  # by now it asks seldom
    silence(client, False)
    assert client.call("ping 20 1").code == 0
    client.spin(POOL.times.retry_first_ms // 10 + 4, 10)
    works(client, 1)


def test_the_time_is_asked_for_when_the_session_is_back(client: Client) -> None:
    connect(client)
    lose(client)
    waited = 0

    def back() -> None:
        nonlocal waited
        waited += 1
        if waited == 30:
            silence(client, False)

    client.on_sleep = back
    assert client.ok("epoch_sync 400").slept >= 30


def test_between_two_sessions(client: Client) -> None:
    connect(client)
    client.ok("fini")
    for _ in range(3):
        assert client.call("ping 10 1").code == 0
        assert client.call("ping_options 10 1 127.0.0.1 8888").code == 0
    assert client.call("epoch_sync 100").error == "session: NULL or not initialized"
    connect(client)
    works(client, 1)


def test_the_usual_loop(client: Client) -> None:
    """As every reconnection example has it: ping, create, spin, destroy; the agent goes and comes."""
    state, values = "waiting", 0
    for step in range(160):
        away = 40 <= step < 90
        if away != client.agent.silent:
            silence(client, away)
        if state == "waiting":
            state = "found" if client.call("ping 20 1").code == 0 else "waiting"
            client.wait(30)
        elif state == "found":
            connect(client)
            state = "connected"
        else:
            client.wait(10)
            client.call("spin")
            values += client.call(f"publish 0 {step}").code == 0
            if step % 10 == 0 and client.call("ping 20 3").code != 0:
                client.call("publisher_fini 0 0")
                client.call("node_fini 0")
                client.ok("fini")
                state = "waiting"
    assert state == "connected"
    assert client.agent.values()[-1] == 159
    assert values >= 90


def test_the_loop_that_keeps_the_session(client: Client) -> None:
    """`if (!connected) ping` and nothing else."""
    connect(client)
    for step in range(120):
        silence(client, 20 <= step < 60)
        client.wait(20)
        client.call("spin")
        client.call(f"publish 0 {step}")
        if client.call("connected").code == 0:
            client.call("ping 20 1")
    assert client.call("connected").code == 1
    assert client.statistics()["reconnects"] == 1
    client.ok("flush 1000")
    assert client.agent.values()[-1] == 119


def test_discovery_in_every_state(client: Client) -> None:
    client.group = lambda question: info(locator("127.0.0.1", 8888))
    if client.call("ping_discover").code == -1:
        pytest.skip("no sockets")
    connect(client)
    client.ok("ping_discover")
    works(client, 1)
    lose(client)
    assert client.call("ping_discover").code == 2
    silence(client, False)
    client.ok("ping_discover")
    client.spin(40, 10)
    works(client, 2)
    client.ok("fini")
    client.ok("ping_discover")
