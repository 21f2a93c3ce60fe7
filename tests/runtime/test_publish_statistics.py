# SPDX-License-Identifier: Apache-2.0
"""`publish_statistics`: each publisher counts what it gave up, whatever the reason."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import POOL, changed
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.harness import build, components, render

DROP_OLDEST = changed(POOL, streams__on_full="drop_oldest")
FRAGMENTS = changed(DROP_OLDEST, streams__mtu=64, streams__fragments=True, streams__reliable_slot_size=300)
BLOCK = changed(POOL, streams__on_full="block", streams__on_full_block_ms=5)
FIXTURES = ("port_fake.c", "client.c", "client_ping.c", "client_no_time.c", "client_no_read.c")


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Callable[[RuntimePlan], Path]:
    @cache
    def compiled(plan: RuntimePlan) -> Path:
        names = [name for name in components(plan) if name != "port_posix"] + ["publish_statistics"]
        tree = render(tmp_path_factory.mktemp("client"), plan, names)
        extra = "client_drops_sleep.c" if plan.session.has_sleep else "client_drops.c"
        return build(tree, [*FIXTURES, "client_no_serve.c", extra, "types.c"], "client")

    return compiled


@pytest.fixture
def connect(program: Callable[[RuntimePlan], Path]) -> Iterator[Callable[..., Client]]:
    """Return a function that gives a client of a plan with two publishers, 1 of them with the QoS `second`."""
    with ExitStack() as stack:

        def connected(plan: RuntimePlan, second: str = "reliable") -> Client:
            client = stack.enter_context(Client(program(plan), FakeAgent()))
            for call in ("init", "node 0 talker -", "publisher 0 0 Int32 a reliable"):
                client.ok(call)
            client.ok(f"publisher 1 0 Int32 b {second}")
            return client

        yield connected


def dropped(client: Client) -> list[int]:
    """Return what each of the two has dropped; of all together the session says the same."""
    each = [int(client.ok(f"extra_dropped {i}").lines[-1]) for i in (0, 1)]
    assert sum(each) == client.statistics()["dropped"]
    return each


@pytest.mark.parametrize("plan", [POOL, BLOCK], ids=["error", "block"])
def test_what_is_refused_for_want_of_room(connect: Callable[..., Client], plan: RuntimePlan) -> None:
    client = connect(plan)
    assert dropped(client) == [0, 0]
    client.agent.silent = True
    for value in range(plan.streams.reliable_slots + 3):
        client.call(f"publish 0 {value}")
    assert dropped(client) == [3, 0]
    client.call("publish 1 9")
    assert dropped(client) == [3, 1]
    client.agent.silent = False
    client.ok("flush 1000")
    client.ok("publish 1 9")
    assert dropped(client) == [3, 1]


@pytest.mark.parametrize("plan", [DROP_OLDEST, FRAGMENTS], ids=["whole", "fragments"])
def test_who_makes_room_has_dropped(connect: Callable[..., Client], plan: RuntimePlan) -> None:
    """A full stream gives the oldest message up, whosever it is."""
    client = connect(plan)
    client.agent.restart()
    client.agent.silent = True
    client.spin(plan.times.liveliness_attempts + 3, plan.times.liveliness_period_ms)
    for value in range(3):
        client.ok(f"publish 0 {value}")
    client.ok("publish 1 3")
    client.ok("publish 1 4")
    assert dropped(client) == [1, 0]
    for value in range(5, 8):
        client.ok(f"publish 1 {value}")
    assert dropped(client) == [3, 1]
    client.agent.silent = False
    client.spin(20, 50)
    assert client.agent.values(1) == [4, 5, 6, 7]
    assert dropped(client) == [3, 1], "it goes on over the new session"


def test_no_session_and_a_new_owner(connect: Callable[..., Client]) -> None:
    client = connect(DROP_OLDEST, "best_effort")
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.ok("publish 1 1")
    client.ok("publish 1 2")
    assert dropped(client) == [0, 2]
    client.agent.silent = False
    client.spin(20, 50)
    client.ok("publisher_fini 1 0")
    result = client.call("extra_dropped 1")
    assert (result.code, result.error) == (11, "publisher or statistics: NULL or not initialized")
    client.ok("publisher 1 0 Int32 b best_effort")
    assert client.ok("extra_dropped 1").lines == ("0",)


def test_it_outlives_a_sleep(program: Callable[[RuntimePlan], Path], tmp_path: Path) -> None:
    """A publisher that is opened again as it was goes on counting; one that is another begins at 0."""
    plan = changed(POOL, session__has_sleep=True, session__has_state=True)
    agent = FakeAgent()
    with Client(program(plan), agent) as client:
        for call in (
            "init",
            "node 0 talker -",
            "publisher 0 0 Int32 a reliable",
            "publisher 1 0 Int32 b reliable",
        ):
            client.ok(call)
        agent.silent = True
        for value in range(plan.streams.reliable_slots + 2):
            client.call(f"publish 0 {value}")
        client.call("publish 1 9")
        assert dropped(client) == [2, 1]
        agent.silent = False
        client.ok(f"extra_sleep {tmp_path / 'memory'} 300")
    with Client(program(plan), agent) as client:
        client.wait(5000)
        assert client.call(f"extra_wake {tmp_path / 'memory'}").code == 1
        for call in ("init", "node 0 talker -", "publisher 0 0 Int32 a reliable"):
            client.ok(call)
        assert client.ok("extra_dropped 0").lines == ("2",)
        client.ok("publisher 1 0 Int32 other reliable")
        assert client.ok("extra_dropped 1").lines == ("0",)


def test_without_it_there_is_no_counter(tmp_path: Path) -> None:
    plan = changed(POOL, errors__text_size=0)
    names = components(plan)
    without = render(tmp_path / "without", plan, names)
    with_it = render(tmp_path / "with", plan, [*names, "publish_statistics"])
    size = "#include <microros/xrce_client.h>\nchar size[sizeof(struct xrce_client_t)];\n"
    sizes = []
    for tree in (without, with_it):
        source = tree.folder / "size.c"
        source.write_text(size, encoding="utf-8")
        command = ["gcc", "-c", f"-I{tree.include}", str(source), "-o", str(tree.folder / "size.o")]
        subprocess.run(command, check=True)
        output = subprocess.run(
            ["nm", "-S", str(tree.folder / "size.o")], capture_output=True, text=True, check=True
        )
        sizes.append(int(output.stdout.split()[1], 16))
    assert 4 * plan.entities.publishers.max <= sizes[1] - sizes[0] <= 4 * plan.entities.publishers.max + 4
