# SPDX-License-Identifier: Apache-2.0
"""The clock of every component runs through 2^31 and 2^32 ms in steps of days, and everything goes on working.

A component whose C code has to do with time has to be in `STEPPED`, under the scenarios that have it, or in `TIMELESS`;
so a new one cannot be forgotten.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.client.plan.slices import DISCOVERY_GROUP
from microros_gen.selection.find_components import load_catalogue
from tests.support.plans import POOL, READER, SERVER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import components
from tests.support.runtime.serving_agent import ServingAgent, identity

FIRST = POOL.entities.publishers.max
"""The first subscription's index among the endpoints."""
STEP_MS = 5 * 86_400_000
STEPS = 12
"""60 days: 2^31 ms are 24.9, 2^32 ms 49.7."""
CREATE, TIMESTAMP = 0x01, 0x0E
PERIOD_MS = POOL.times.liveliness_period_ms
EPOCH_S = 1_790_000_000
REPLIER = bytes.fromhex("0018")


@dataclass
class Agent(ServingAgent):
    """Answers TIMESTAMP, too, with a time that moves on by a step at each."""

    step: int = 0
    seconds: list[int] = field(default_factory=list)

    def receive(self, datagram: bytes) -> list[bytes]:
        if datagram[4] != TIMESTAMP or self.silent:
            return super().receive(datagram)
        self.seconds.append(EPOCH_S + self.step * STEP_MS // 1000)
        wire_time = struct.pack("<II", self.seconds[-1], 0)
        return [bytes.fromhex("81000000 0f011800") + wire_time + wire_time + datagram[8:16]]


class Days:
    """A client over the days; `step` says how many steps are over."""

    def __init__(self, bench: Bench, plan: RuntimePlan, liveliness: str) -> None:
        self.bench, self.plan, self.liveliness = bench, plan, liveliness
        self.agent = Agent()
        self.client: Client = bench.start(plan, liveliness, self.agent)
        self.step = 0
        self.sent: list[int] = []
        self.taken: list[int] = []

    def ok(self, *calls: str) -> None:
        for call in calls:
            self.client.ok(call)

    def spin(self, times: int = 3, step: int = 1) -> list[str]:
        lines: list[str] = []
        for _ in range(times):
            self.client.wait(step)
            lines += self.client.ok("spin").lines
        return lines

    def exchange(self, count: int = 3) -> None:
        """Send and take `count` numbers, which have to arrive at once."""
        for _ in range(count):
            value = len(self.sent)
            self.client.queued += self.agent.numbers(FIRST, value)
            self.spin(4)
            result = self.client.call("read_take 0")
            self.taken += [int(line.split()[1]) for line in result.lines]
            self.ok(f"publish 0 {value}")
            self.sent.append(value)
            self.spin(2)
        assert self.taken == self.sent, f"day {self.step * 5}"
        assert self.agent.values() == self.sent, f"day {self.step * 5}"

    def lose(self) -> None:
        """Let the agent be away until the session is lost, and come back."""
        before = self.client.statistics()["reconnects"]
        self.agent.silent = True
        for _ in range(12):
            if self.liveliness == "acknack":
                self.client.call("publish 1 7")
            self.spin(1, PERIOD_MS // 2)
        assert self.client.call("connected").code == 0, f"day {self.step * 5}: its silence was not noticed"
        self.agent.silent = False
        self.spin(30, 50)
        assert self.client.call("connected").code == 1, f"day {self.step * 5}"
        assert self.client.statistics()["reconnects"] == before + 1


@dataclass(frozen=True)
class Scenario:
    """What is done first, and after each step."""

    plan: RuntimePlan
    begin: Callable[[Days], None]
    step: Callable[[Days], None]
    liveliness: str = "ping"


def _begin(qos: str) -> Callable[[Days], None]:
    def begin(days: Days) -> None:
        days.ok("init", "node 0 n -", f"publisher 0 0 Int32 out {qos}", f"publisher 1 0 Int32 other {qos}")
        days.ok(f"read_init 0 0 Int32 go {qos}")
        days.spin()

    return begin


def _begin_to_send(days: Days) -> None:
    days.ok("init", "node 0 n -", "publisher 0 0 Int32 out reliable")
    days.spin()


def _begin_services(days: Days) -> None:
    days.ok("init", "node 0 n -", "serve_init 0 0 set", "serve_client 0 0 /far/ask")
    days.spin()


def _samples(days: Days) -> None:
    days.spin()  # what is due after so long is over
    days.exchange()
    assert days.client.statistics()["reconnects"] == 0


def _losses(days: Days) -> None:
    days.spin()
    days.lose()
    days.spin(5, 50)
    days.exchange()


def _watched(days: Days) -> None:
    before = days.client.statistics()["reconnects"]
    days.agent.restart()
    lines = days.spin(30, 50)
    states = [int(line.split()[1]) for line in lines if line.startswith("event")]
    assert (states[0], states[-1]) == (3, 2), "lost, then connected"
    assert days.client.statistics()["reconnects"] == before + 1


def _begin_watched(days: Days) -> None:
    days.ok("extra_watch")
    _begin("reliable")(days)


def _hard(days: Days) -> None:
    days.spin(1)
    days.client.sent.clear()
    days.spin(15, 50)
    assert days.client.sent, "it has to be heard each 2,000 ms"
    assert days.client.statistics()["reconnects"] == 0


def _services(days: Days) -> None:
    days.spin()
    (number,) = (int(line.split()[1]) for line in days.client.ok(f"serve_ask 0 {days.step}").lines)
    days.spin(2)
    days.client.queued += days.agent.reply(len(days.agent.calls) - 1, 3 * days.step)
    days.spin(2)
    assert days.client.ok("serve_reply 0").lines == (f"reply {3 * days.step} {number}",)
    days.client.queued += days.agent.give(REPLIER, identity(days.step + 1) + struct.pack("<i", days.step))
    days.spin(2)
    assert days.client.ok("serve_take 0 0").lines[0].startswith(f"request {days.step} {days.step + 1} ")
    days.ok(f"serve_answer 0 0 {5 * days.step}")
    days.spin(2)
    assert days.agent.answered[-1][24:] == struct.pack("<i", 5 * days.step)


def _refusals(days: Days) -> None:
    """READ_DATA and CREATE are refused, and asked for again after their pauses."""
    days.spin()
    days.ok("read_fini 0 0")
    days.agent.read_status = 0x87
    days.ok("read_init 0 0 Int32 go reliable")
    days.spin(3, 20)
    days.agent.read_status = 0
    requests = len(days.agent.reads)
    days.spin(4, 100)
    assert len(days.agent.reads) == requests + 1
    days.agent.refuse = {"datawriter": 0x87}
    days.ok("publisher_fini 0 0")
    assert days.client.call("publisher 0 0 Int32 out reliable").code != 0
    days.agent.refuse = {}
    days.ok("publisher 0 0 Int32 out reliable")
    days.client.call("read_take 0")
    days.exchange(1)


def _full(days: Days) -> None:
    """A publish waits for room as long as the plan says."""
    days.spin()
    days.ok("flush 100")
    days.agent.silent = True
    for value in range(4):
        days.ok(f"publish 0 {value}")
    result = days.client.call("publish 0 9")
    assert (result.code != 0, result.slept) == (True, 20)
    days.agent.silent = False
    days.ok("flush 400")


def _pings(days: Days) -> None:
    days.ok("ping 300 1", "epoch_sync 1000")
    assert int(days.client.call("epoch_now").lines[-1].split()[1]) // 1000 == days.agent.seconds[-1]
    days.agent.silent = True
    result = days.client.call("ping 60 2")
    assert (result.code != 0, 100 <= result.slept <= 130) == (True, True)
    days.agent.silent = False
    days.ok("ping 300 1")


def _large(days: Days) -> None:
    """Fragments in both directions; one of each is lost."""
    days.spin()
    lost = [True]
    days.agent.drop_answer = lambda answer: answer[4] == 0x0D and bool(lost) and lost.pop()
    text = struct.pack("<I", 301) + b"z" * 300 + b"\0"
    days.client.queued += days.agent.offer(FIRST, text)
    days.spin(3)
    days.client.queued += days.agent.tick()
    days.spin(3)
    assert days.client.ok("read_text 0 1000").lines == ("text " + "z" * 300,)
    dropped = [True]
    days.agent.drop = lambda datagram: datagram[4] == 0x0D and bool(dropped) and dropped.pop()
    days.ok(f"large 0 600 {days.step}", "flush 1000")
    assert days.agent.written[-1][1][:1] == bytes([days.step * 31 & 0xFF])


def _begin_large(days: Days) -> None:
    days.ok("init", "node 0 n -", "publisher 0 0 Int32 out reliable", "read_init 0 0 String go reliable")
    days.spin()


def _searches(days: Days) -> None:
    """The agent is away, and found again where it says that it is."""
    questions: list[bytes] = []
    days.spin()
    days.agent.silent = True

    def keep_silent(question: bytes) -> bytes:
        questions.append(question)
        return b""

    days.client.group = keep_silent
    days.spin(30, PERIOD_MS // 2)
    assert len(questions) > 2, f"day {days.step * 5}: nobody was searched for"
    days.agent.silent = False
    days.client.group = lambda question: _found()
    days.spin(40, PERIOD_MS // 2)
    assert days.client.call("connected").code == 1, f"day {days.step * 5}"


def _found() -> bytes:
    payload = bytes.fromhex("0009fffd 0000 010d 58524345 0100010f 00 010d 00 0100 0000 01000000")
    payload += b"\x01" + bytes([127, 0, 0, 1]) + b"\0" + struct.pack("<H", 8888)
    return b"\x80\0\0\0\x06\x01" + struct.pack("<H", len(payload)) + payload


def _begin_search(days: Days) -> None:
    days.client.group = lambda question: _found()
    _begin_to_send(days)


WATCHED = changed(READER, session__has_state=True, session__has_sleep=True)
LARGE = changed(
    READER,
    streams__fragments=True,
    streams__reliable_slot_size=1024,
    input__queues=(QueuePlan(1, 400), QueuePlan(1, 16)),
    input__arrives_in_fragments=True,
)
SCENARIOS = {
    "samples, reliable": Scenario(READER, _begin("reliable"), _samples),
    "samples, best effort": Scenario(READER, _begin("best_effort"), _samples),
    "losses, ping": Scenario(READER, _begin("reliable"), _losses),
    "losses, acknack": Scenario(
        changed(READER, streams__on_full="drop_oldest"), _begin("reliable"), _losses, "acknack"
    ),
    "session state": Scenario(WATCHED, _begin_watched, _watched),
    "hard liveliness": Scenario(
        changed(POOL, session__hard_liveliness_ms=2000), _begin_to_send, _hard, "acknack"
    ),
    "services": Scenario(SERVER, _begin_services, _services),
    "refusals": Scenario(READER, _begin("reliable"), _refusals),
    "full": Scenario(
        changed(POOL, streams__on_full="block", streams__on_full_block_ms=20), _begin_to_send, _full
    ),
    "ping and time": Scenario(changed(POOL, session__has_time_sync=True), _begin_to_send, _pings),
    "fragments": Scenario(LARGE, _begin_large, _large),
    "discovery": Scenario(
        changed(POOL, transport__agent_host=DISCOVERY_GROUP, transport__has_discovery=True),
        _begin_search,
        _searches,
    ),
}


@pytest.mark.parametrize("name", SCENARIOS)
def test_sixty_days(bench: Bench, name: str) -> None:
    scenario = SCENARIOS[name]
    days = Days(bench, scenario.plan, scenario.liveliness)
    scenario.begin(days)
    for step in range(STEPS):
        days.step = days.agent.step = step
        scenario.step(days)
        days.client.wait(STEP_MS)


def test_sleeping_for_days(bench: Bench, tmp_path: Path) -> None:
    """Each process begins with a clock that is days away from that of the one before."""
    days = Days(bench, WATCHED, "ping")
    _begin("reliable")(days)
    objects = dict(days.agent.objects)
    for step in range(STEPS):
        days.step = step
        days.exchange()
        days.ok(f"extra_sleep {tmp_path / 'memory'} 300")
        days.client = bench.start(WATCHED, "ping", days.agent)
        days.client.wait(step * STEP_MS)
        assert days.client.call(f"extra_wake {tmp_path / 'memory'}").code == 1
        _begin("reliable")(days)
        assert CREATE not in {datagram[4] for datagram in days.client.sent}
    days.exchange()
    assert days.agent.objects == objects


STEPPED = {
    "discovery": ["discovery"],
    "entities": ["samples, reliable", "refusals"],
    "liveliness_acknack": ["losses, acknack"],
    "liveliness_hard": ["hard liveliness"],
    "node": ["samples, reliable"],
    "ping": ["losses, ping", "ping and time"],
    "publish": ["samples, reliable", "full"],
    "read": ["samples, reliable", "refusals"],
    "services": ["services"],
    "session": list(SCENARIOS),
    "session_close": ["samples, reliable"],
    "session_state": ["session state"],
    "sleep_cycles": ["session state"],  # and test_sleeping_for_days
    "stream_reliable": ["samples, reliable", "fragments"],
    "subscribe": ["samples, reliable"],
    "support": list(SCENARIOS),
    "time_sync": ["ping and time"],
    "write": ["full"],
}
ELSEWHERE = {
    "action_client": "test_action_client.py: time-outs over the wrap",
    "action_server": "test_action_server.py: results and goals over the wrap",
    "agents": "unit_agents.c: searches over the wrap and days apart",
    "clock": "unit_days.c",
    "clock_stamp": "unit_stamp.c: the end of the seconds of a stamp; the time has 64 bits",
    "continuous_serialization": "test_continuous.py: fragments, time-outs and sessions over the wrap",
    "diagnosis": "tests/components/test_diagnosis.py: checks and shares over the wraps of ms and us",
    "executor": "unit_days.c",
    "graph_events": "test_graph_events.py: a server that is asked again, over the wrap",
    "lifecycle": "test_lifecycle.py: parts and timers over the wrap",
    "local_delivery": "tests/components/test_local_delivery.py: times over the wrap of ms",
    "long_time": "tests/firmware/test_long_time.py: several wraps, nobody reads the time",
    "node_modes": "test_modes.py: services over the wrap; times of events have 64 bits",
    "on_silence": "unit_silence.c: silences over the wrap and days apart",
    "parameter_client": "test_parameter_client.py: a call over the wrap",
    "parameters_held": "test_parameters_held.py: notices over the wrap; ages have 64 bits",
    "peer": "test_peer.py: both streams over the wrap",
    "port_bare": "tests/firmware/c/unit_bare.c, unit_bare_timers.c and unit_console.c",
    "seal": "tests/runtime/test_seal.py: repetitions of a handshake, and a new one, over the wrap",
    "qos_events": "unit_qos_events.c: deadlines over the wrap",
    "service_call": "unit_service_call.c: a call over the wrap",
    "time_source": "unit_time_source.c: questions over the wrap; the time has 64 bits",
    "tasks": "tests/components/test_tasks.py: releases over the wrap of us",
    "timers": "unit_days.c",
}
TIMELESS = {
    "actions": "declares members of goals; the action server and client read the clock",
    "base": "constants, and a lock that sleeps a millisecond; no state",
    "graph": "its waits are those of wait sets; the period is a time-out",
    "graph_topic": "its waits are those of wait sets; the period is a time-out",
    "entities_binary": "the deadline of a QoS is a number for the agent",
    "entities_preconfigured": "hands a time-out on to the session",
    "logging": "stamps messages with the time of day, which has 64 bits; its period is an unsigned difference",
    "logging_console": "stamps messages with the time of day, which has 64 bits",
    "logging_ring": "stamps its announcement with the time of day, which has 64 bits",
    "logging_rosout": "stamps messages with the time of day, which has 64 bits",
    "multithread": "sleeps a millisecond",
    "parameter_messages": "hands the time of arrival on",
    "parameters": "stamps events with the time of day, which has 64 bits",
    "port_avr": "waits for the watchdog to reset; counts one tick an interrupt",
    "port_cortex_m": "waits for one byte of a UART",
    "port_esp_idf": "the chip's timer and the system's time of day have 64 bits",
    "port_freertos": "the kernel's count of ticks, with its wraps, has 64 bits",
    "port_posix": "the system's clocks have 64 bits",
    "port_zephyr": "the kernel's clock has 64 bits; its milliseconds wrap with it",
    "port_zephyr_sockets": "hands a time-out on to the kernel's function",
    "port_riscv": "waits for one byte of a UART; its counter has 64 bits",
    "qos": "the deadline of a QoS is a number for the agent",
    "transport_custom": "hands a time-out on to the application's function",
    "transport_canfd": "keeps no time",
    "transport_serial": "keeps no time",
    "transport_tcp": "keeps no time",
    "transport_udp": "keeps no time",
}
TIME = re.compile(r"\b(port_time_\w+|port_sleep_ms|xrce_is_due|\w+_(ms|ns))\b")


def test_every_component_that_has_to_do_with_time_is_stepped() -> None:
    timed = {
        component.name
        for component in load_catalogue().values()
        for pattern in ("*.c", "*.h", "*.j2")
        for path in component.folder.rglob(pattern)
        if TIME.search(path.read_text())
    }
    known = STEPPED.keys() | ELSEWHERE.keys() | TIMELESS.keys()
    assert timed - known == set(), "add a scenario in which its clock is stepped through 60 days"
    for component, names in STEPPED.items():
        for name in names:
            assert component in components(SCENARIOS[name].plan, SCENARIOS[name].liveliness), (
                component,
                name,
            )
