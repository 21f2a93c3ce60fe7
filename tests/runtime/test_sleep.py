# SPDX-License-Identifier: Apache-2.0
"""Sleep cycles: the process ends, and all that the next one has of it is a file with the retained memory."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan, SubscriptionPlan
from tests.support.plans import DECLARED, INT32, READER, SERVER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.runtime.serving_agent import ServingAgent, identity

PLAN = changed(READER, session__has_state=True, session__has_sleep=True)
DECLARED_PLAN = changed(
    DECLARED,
    session__has_state=True,
    session__has_sleep=True,
    entities__subscriptions__declared=(SubscriptionPlan(0, 0, "/arm/go", "rt/arm/go", INT32, True),),
    entities__subscriptions__max=1,
    input__queues=(QueuePlan(4, 4),),
    input__reliable_slots=1,
    input__reliable_slot_size=64,
)
CREATE_CLIENT, CREATE, DELETE = 0x00, 0x01, 0x03
REPLIER = bytes.fromhex("0018")


class Device:
    """A device over its sleeps: `wake` starts a new process."""

    def __init__(self, bench: Bench, memory: Path, plan: RuntimePlan = PLAN) -> None:
        self._bench, self._plan, self.memory = bench, plan, memory
        self.agent = ReadingAgent()
        self.index = plan.entities.publisher_places
        self.client: Client = bench.start(plan, agent=self.agent)
        self.begin()

    def begin(self, publisher: str = "reliable") -> None:
        self.client.ok("init")
        self.begin_rest(publisher)

    def begin_rest(self, publisher: str = "reliable") -> None:
        name = "imu /arm" if self._plan.entities.declared else "n -"
        topic = "/arm/chatter" if self._plan.entities.declared else "chatter"
        for call in (
            f"node 0 {name}",
            f"publisher 0 0 Int32 {topic} {publisher}",
            "read_init 0 0 Int32 /arm/go reliable",
        ):
            self.client.ok(call)

    def sleep(self) -> None:
        self.client.ok(f"extra_sleep {self.memory} 300")

    def start(self) -> bool:
        """Return whether the new process finds a session in the memory."""
        self.client = self._bench.start(self._plan, agent=self.agent)
        self.client.wait(77_000)
        return self.client.call(f"extra_wake {self.memory}").code == 1

    def wake(self) -> None:
        assert self.start()
        self.begin()

    def cycle(self) -> None:
        self.sleep()
        self.wake()

    def publish(self, *values: int) -> None:
        for value in values:
            self.client.ok(f"publish 0 {value}")

    def take_all(self) -> list[int]:
        found = []
        while (result := self.client.call("read_take 0")).code == 0:
            found.append(int(result.lines[0].split()[1]))
        return found

    def sent(self) -> set[int]:
        return {datagram[4] for datagram in self.client.sent}

    def number(self, *values: int) -> None:
        self.client.queued += self.agent.numbers(self.index, *values)


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    return tmp_path / "memory"


@pytest.mark.parametrize("plan", [PLAN, DECLARED_PLAN], ids=["pool", "declared"])
def test_the_session_goes_on(bench: Bench, memory: Path, plan: RuntimePlan) -> None:
    """Nothing is connected or created in nine cycles, and samples go on in order in both directions."""
    device = Device(bench, memory, plan)
    objects, taken = dict(device.agent.objects), []
    for cycle in range(9):
        device.publish(2 * cycle)
        device.number(2 * cycle)
        device.client.spin(2)
        taken += device.take_all()
        device.cycle()
        device.publish(2 * cycle + 1)
        device.number(2 * cycle + 1)
        device.client.spin(2)
        taken += device.take_all()
        assert not device.sent() & {CREATE_CLIENT, CREATE, DELETE}
    device.client.ok("flush 100")
    assert device.agent.values() == list(range(18)) == taken
    assert device.agent.objects == objects
    assert device.client.statistics()["reconnects"] == 0
    device.client.ok("fini")


def test_what_is_under_way_is_not_lost(bench: Bench, memory: Path) -> None:
    """What the agent has not acknowledged, and what the application has not taken."""
    device = Device(bench, memory)
    device.client.spin(2)
    device.number(1, 2)
    device.client.spin(2)
    device.agent.silent = True
    device.publish(1, 2, 3)
    device.sleep()
    device.agent.silent = False
    device.wake()
    assert device.take_all() == [1, 2]
    device.number(3, 4)
    device.client.spin(20, 20)
    assert device.take_all() == [3, 4]
    assert device.agent.values() == [1, 2, 3]


def test_samples_before_the_application_has_restarted(bench: Bench, memory: Path) -> None:
    device = Device(bench, memory)
    device.client.spin(2)
    device.sleep()
    assert device.start()
    device.client.ok("init")
    device.number(1, 2)
    device.client.spin(2)
    device.begin_rest()
    assert device.take_all() == [1, 2]


def test_another_entity_in_the_place(bench: Bench, memory: Path) -> None:
    """The publisher comes back with other QoS: what the agent has is deleted and created; the others are kept."""
    device = Device(bench, memory)
    device.sleep()
    assert device.start()
    device.begin("best_effort")
    device.client.spin(10, 40)
    changed = {d[10:12].hex() for d in device.client.sent if d[4] == CREATE}
    assert changed == {"0002", "0003", "0005"}
    device.publish(7)
    assert device.agent.values() == [7]


@pytest.mark.parametrize("forgetful", [True, False], ids=["restarted", "gone"])
def test_an_agent_that_forgot_meanwhile(bench: Bench, memory: Path, forgetful: bool) -> None:
    """The agent has restarted, or is gone: a new session by itself, in which both directions go on."""
    device = Device(bench, memory)
    device.sleep()
    if forgetful:
        device.agent.restart()
    device.agent.silent = not forgetful
    device.wake()
    assert CREATE_CLIENT not in device.sent()
    if not forgetful:
        device.publish(0)
    device.client.spin(20, 30)
    device.agent.silent = False
    device.client.spin(20, 30)
    assert device.client.statistics()["reconnects"] == 1
    device.publish(1)
    assert device.agent.values() == ([1] if forgetful else [0, 1])
    device.number(5)
    device.client.spin(2)
    assert device.take_all() == [5]


def test_a_session_that_is_lost_before_the_entities_are_opened(bench: Bench, memory: Path) -> None:
    """Nothing of the old session's tables is used: their names are not there yet."""
    device = Device(bench, memory)
    device.sleep()
    device.agent.restart()
    assert device.start()
    device.client.ok("init")
    device.client.spin(5, 20)
    assert CREATE not in device.sent()
    device.begin_rest()
    device.publish(3)
    assert device.agent.values() == [3]


@pytest.mark.parametrize("place", ["first", "middle", "last", "plan", "all"])
def test_memory_that_is_not_what_was_written(bench: Bench, memory: Path, place: str) -> None:
    device = Device(bench, memory)
    device.sleep()
    content = bytearray(memory.read_bytes())
    assert content[12:28] == PLAN.plan_id.encode()
    at = {"first": 0, "middle": len(content) // 2, "last": len(content) - 8, "plan": 13}.get(place)
    memory.write_bytes(
        bytes(len(content)) if at is None else content[:at] + bytes([content[at] ^ 4]) + content[at + 1 :]
    )
    assert not device.start()
    device.begin()
    assert device.sent() >= {CREATE_CLIENT, CREATE}
    device.publish(1)
    assert device.agent.values() == [1]


def test_another_plan_and_another_key(bench: Bench, memory: Path) -> None:
    device = Device(bench, memory)
    device.sleep()
    other = bench.start(changed(PLAN, plan_id="fedcba9876543210"), agent=ReadingAgent())
    assert other.call(f"extra_wake {memory}").code == 0
    assert device.start()
    device.client.ok("init_options 0 127.0.0.1 8888 00000099")
    assert CREATE_CLIENT in device.sent()


def test_no_sleep_without_a_session(bench: Bench, memory: Path) -> None:
    device = Device(bench, memory)
    device.agent.silent = True
    device.client.spin(8, 100)
    result = device.client.call(f"extra_sleep {memory} 50")
    assert (result.code, memory.exists()) == (2, False)
    assert 50 <= result.slept <= 51
    device.agent.silent = False
    device.client.spin(20, 50)
    device.publish(1)
    assert device.agent.values() == [1]
    device.client.ok("fini")
    assert device.client.call(f"extra_sleep {memory} 50").code == 11


def test_services_go_on(bench: Bench, memory: Path) -> None:
    """A request that waits for its reply gets it after the sleep; one that was not taken is taken then."""
    plan = changed(SERVER, session__has_state=True, session__has_sleep=True)
    agent = ServingAgent()

    def start() -> Client:
        client = bench.start(plan, agent=agent)
        client.wait(5000)
        return client

    def open_all(client: Client) -> None:
        for call in ("init", "node 0 server -", "serve_init 0 0 set", "serve_client 0 0 /far/ask"):
            client.ok(call)

    client = start()
    open_all(client)
    client.spin(3)
    first = client.ok("serve_ask 0 11").lines[0].split()[1]
    client.queued += agent.give(REPLIER, identity(5) + struct.pack("<i", 7))
    client.spin(2)
    client.ok(f"extra_sleep {memory} 300")
    client = start()
    assert client.call(f"extra_wake {memory}").code == 1
    open_all(client)
    assert not {datagram[4] for datagram in client.sent} & {CREATE_CLIENT, CREATE, DELETE}
    assert client.ok("serve_take 0 0").lines[0].split()[1:3] == ["7", "5"]
    client.queued += agent.reply(0, 12)
    client.spin(2)
    _, value, sequence = client.ok("serve_reply 0").lines[0].split()
    assert (value, sequence) == ("12", first)
    assert int(client.ok("serve_ask 0 13").lines[0].split()[1]) == int(first) + 1
