# SPDX-License-Identifier: Apache-2.0
"""Agents that are not there, refuse, stop, and come back; a rough network; several clients."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import Image, Images, run
from tests.support.e2e.live import Live, Sample
from tests.support.e2e.relay import Relay, rough
from tests.support.e2e.udp_agent import serving
from tests.support.free_ports import free_port
from tests.support.patience import deadline, seconds
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import first

# What a publish that waits for nothing takes, microseconds: nearly always, and when the machine is busy.
AT_ONCE_US = 5_000
HICCUP_US = 150_000


@pytest.fixture
def live(images: Images, pool_image: Image) -> Iterator[Live]:
    with Live(images.live(pool_image)) as running:
        yield running


def at_once(samples: list[Sample]) -> None:
    """Check that calls do not wait; one may have lost the processor."""
    times = sorted(sample.took_us for sample in samples)
    assert times[len(times) // 2] < AT_ONCE_US
    assert times[-1] < HICCUP_US


def accepted(samples: list[Sample]) -> list[int]:
    """Return the values that a stream took: it may be full while the machine is busy."""
    assert {sample.code for sample in samples} <= {0, 1}
    return [sample.value for sample in samples if sample.code == 0]


# No agent


@pytest.mark.parametrize("listens", [False, True], ids=["no socket", "silent socket"])
def test_no_agent(live: Live, listens: bool) -> None:
    with serving(FakeAgent(silent=True)) as silent:
        port = silent if listens else free_port()
        answer = live.call(f"open 1 {port}")
        assert (answer.code, answer.text) == (2, f"no agent answers at 127.0.0.1:{port} within 1000 ms")
        assert 998_000 <= answer.took_us < 1_000_000 + HICCUP_US
        assert live.call("node 0 talker -").code != 0
        assert live.call("statistics").code != 0


def test_the_example_says_that_there_is_no_agent(profile_image: Image, relay: Relay) -> None:
    done = run([str(profile_image.program)])
    expected = f"start: no agent answers at 127.0.0.1:{relay.port} within 1000 ms\n"
    assert (done.returncode, done.stderr) == (1, expected)


def test_a_session_after_all(live: Live) -> None:
    """A failed start leaves nothing behind: the next one works."""
    agent = FakeAgent(silent=True)
    with serving(agent) as port:
        assert live.call(f"open 1 {port}").code == 2
        agent.silent = False
        live.start(port)
        taken = accepted(live.burst(0, 20, 2))
        live.ok("flush 2000")
        assert len(taken) >= 4
        assert agent.values() == taken
        live.ok("close")
        assert not agent.connected


# An agent that refuses


@pytest.mark.parametrize(("status", "name"), [(0x83, "DENIED"), (0x87, "RESOURCES"), (0x86, "INCOMPATIBLE")])
def test_a_refused_session(live: Live, status: int, name: str) -> None:
    with serving(FakeAgent(session_status=status)) as port:
        answer = live.call(f"open 1 {port}")
    assert (answer.code, answer.text) == (1, f"the agent at 127.0.0.1:{port} refuses the session: {name}")
    assert answer.took_us < HICCUP_US


@pytest.mark.parametrize(
    ("kind", "shown", "status", "name"),
    [
        ("participant", "node talker", 0x80, "DDS_ERROR"),
        ("topic", "topic /chatter", 0x81, "MISMATCH"),
        ("publisher", "publisher /chatter", 0x83, "DENIED"),
        ("datawriter", "datawriter /chatter", 0x87, "RESOURCES"),
    ],
)
def test_a_refused_entity(live: Live, kind: str, shown: str, status: int, name: str) -> None:
    agent = FakeAgent(refuse={kind: status})
    with serving(agent) as port:
        live.ok(f"open 1 {port}")
        answer = live.call("node 0 talker -")
        if answer.code == 0:
            answer = live.call("publisher 0 0 Int32 chatter reliable")
        assert (answer.code, answer.text) == (
            1,
            f"{shown}: the agent refuses it: {name} (entities in microros.yaml)",
        )
        assert answer.took_us < HICCUP_US
        agent.refuse.clear()
        live.ok("node 1 talker -")
        live.ok("publisher 1 1 Int32 chatter reliable")
        live.ok("close")


@pytest.mark.ros
def test_an_agent_without_room(images: Images, pool_image: Image, domain: int) -> None:
    with (
        running_agent(domain, "--domain", str(domain), "--max-clients", "1") as agent,
        Live(images.live(pool_image)) as first,
        Live(images.live(pool_image)) as second,
    ):
        first.start(agent.port)
        first.ok("publisher 1 0 Int32 kept reliable")  # a client without an object gives its place away
        answer = second.call(f"open 2 {agent.port}")
        assert (answer.code, answer.text) == (
            1,
            f"the agent at 127.0.0.1:{agent.port} refuses the session: RESOURCES",
        )
        first.ok("close")
        end = deadline(10)  # what a client had is taken down in turns, and its place with it
        while (answer := second.call(f"open 2 {agent.port}")).code != 0 and time.monotonic() < end:
            assert "RESOURCES" in answer.text
        assert answer.code == 0, answer.text
        second.ok("close")


# An agent that stops in the middle


def test_on_full_error(live: Live) -> None:
    """A full stream is an error at once, with a counter; the silent agent's return heals it."""
    agent = FakeAgent()
    with serving(agent) as port:
        live.start(port)
        live.ok("publisher 1 0 Int32 fast best_effort")
        taken = accepted(live.burst(0, 10, 2))
        live.ok("flush 2000")
        dropped = live.statistics()["dropped"]
        agent.silent = True
        samples = live.burst(10, 150, 2)
        at_once(samples)
        assert [s.code for s in samples] == [0] * 4 + [1] * 146
        assert live.call("publish 0 0").text == (
            "publisher /chatter: stream full, 4 unacknowledged: the agent is away,"
            " or raise pools: {history: 5} in microros.yaml"
        )
        quick = live.burst(0, 100, 1, publisher=1)
        at_once(quick)
        assert {s.code for s in quick} == {0}
        assert live.statistics()["dropped"] == dropped + 147
        agent.silent = False
        live.ok("flush 3000")
        live.ok("publish 0 500")
        live.ok("flush 2000")
        assert agent.values() == [*taken, *range(10, 14), 500]
        assert live.statistics()["reconnects"] == 0
        live.ok("close")


def test_on_full_drop_oldest(images: Images, acknack_image: Image) -> None:
    """Three were sent in the session, which goes on; the fourth slot has the newest one."""
    agent = FakeAgent()
    with Live(images.live(acknack_image)) as live, serving(agent) as port:
        live.start(port)
        live.burst(0, 10, 2)
        live.ok("flush 2000")
        before = agent.values()
        dropped = live.statistics()["dropped"]
        agent.silent = True
        samples = live.burst(10, 150, 2)
        at_once(samples)
        assert {s.code for s in samples} == {0}
        assert live.statistics()["dropped"] == dropped + 146
        agent.silent = False
        live.ok("flush 3000")
        assert agent.values() == [*before, 10, 11, 12, 159]
        live.ok("close")


def test_on_full_block(images: Images, none_image: Image) -> None:
    """A full stream waits for room as long as the application file says, and no longer."""
    agent = FakeAgent()
    with Live(images.live(none_image)) as live, serving(agent) as port:
        live.start(port)
        agent.silent = True
        samples = live.burst(0, 24, 0)
        at_once(samples[:4])
        assert [s.code for s in samples] == [0] * 4 + [1] * 20
        waited = sorted(s.took_us for s in samples[4:])
        assert waited[0] >= 19_000
        assert waited[10] < 40_000
        assert waited[-1] < 20_000 + HICCUP_US
        agent.silent = False
        live.ok("flush 2000")
        taken = accepted(live.burst(100, 50, 0))
        live.ok("flush 2000")
        assert len(taken) >= 4
        assert agent.values() == [*range(4), *taken]
        live.ok("close")


def test_closing_without_an_agent_is_bounded(live: Live) -> None:
    agent = FakeAgent()
    with serving(agent) as port:
        live.start(port)
        agent.silent = True
        for command in ("publisher_fini 0 0", "close"):
            answer = live.call(command)
            assert answer.took_us < 300_000 + HICCUP_US
        assert answer.code == 0


# A rough network


@pytest.mark.ros
@pytest.mark.parametrize("seed", first([1, 2]))
def test_a_rough_network(
    live: Live, agent: AgentProcess, relay: Relay, observer: Observer, seed: int
) -> None:
    """Reliable samples arrive once each and in order, best effort ones without a wait."""
    reliable, fast = f"/rough_{seed}", f"/rough_fast_{seed}"
    observer.subscribe(reliable, "std_msgs/msg/Int32")
    observer.subscribe(fast, "std_msgs/msg/Int32", reliable=False)
    live.start(relay.port, key=0x500 + seed, topic=reliable)
    live.ok(f"publisher 1 0 Int32 {fast} best_effort")
    live_until_heard(live, observer, reliable)
    relay.fault = rough(seed)
    sent = []
    for start in range(0, 120, 4):
        quick = live.burst(start, 4, 0, publisher=1)
        at_once(quick)
        sent += publish_all(live, range(start, start + 4))
    live.ok("flush 5000")
    assert live.statistics()["resent"] > 0
    arrived = collect(observer, reliable, 119)
    assert arrived[reliable] == sent == list(range(120))
    assert set(arrived[fast]) <= set(range(120))
    relay.connect(agent.port)
    live.ok("close")


def live_until_heard(live: Live, observer: Observer, topic: str) -> None:
    """Publish -1 until the subscription is there, and take away what came."""
    end = deadline(15)
    while not any(name == topic for name, _ in observer.ask(do="samples")):
        assert time.monotonic() < end, f"the subscription on {topic} gets nothing"
        live.call("publish 0 -1")  # the stream may be full while the agent is busy
        time.sleep(0.05)
    live.ok("flush 2000")
    time.sleep(0.1)
    observer.ask(do="samples")


def publish_all(live: Live, values: range) -> list[int]:
    """Publish each value, again while the stream is full; return them."""
    end = deadline(10)
    for value in values:
        while live.call(f"publish 0 {value}").code != 0:
            assert time.monotonic() < end, f"the stream stays full at {value}"
    return list(values)


def collect(observer: Observer, topic: str, last: int, timeout_s: float = 15.0) -> dict[str, list[int]]:
    """Take samples until `last` comes on `topic`, and what comes within a moment after; values by topic."""
    found: dict[str, list[int]] = {topic: []}
    end = deadline(timeout_s)
    while last not in found[topic]:
        assert time.monotonic() < end, f"{last} does not come on {topic}: {found[topic][-3:]}"
        for name, value in observer.ask(do="samples"):
            found.setdefault(name, []).append(value["data"])
    time.sleep(0.1)
    for name, value in observer.ask(do="samples"):
        found.setdefault(name, []).append(value["data"])
    return found


# Several clients


@pytest.mark.system
@pytest.mark.ros
def test_two_images_at_once_and_a_restart_with_the_same_key(
    images: Images, pool_image: Image, agent: AgentProcess, observer: Observer
) -> None:
    program = images.live(pool_image)
    with ExitStack() as stack:
        first, second = (stack.enter_context(Live(program)) for _ in range(2))
        for number, peer in enumerate((first, second)):
            peer.ok(f"open {0x600 + number} {agent.port}")
            peer.ok(f"node 0 pair_{number} -")
            peer.ok(f"publisher 0 0 Int32 pair_{number} reliable")
            observer.subscribe(f"/pair_{number}", "std_msgs/msg/Int32")
        for number, peer in enumerate((first, second)):
            live_until_heard(peer, observer, f"/pair_{number}")
        first.begin("burst 0 0 50 5")
        sent = {"/pair_1": accepted(second.burst(1000, 50, 5)), "/pair_0": accepted(first.samples())}
        values: dict[str, list[int]] = {"/pair_0": [], "/pair_1": []}
        for topic, value in observer.got(sum(map(len, sent.values()))):
            values[topic].append(value["data"])
        assert values == sent
        first.kill()
        start = time.monotonic()
        again = stack.enter_context(Live(program))
        again.ok(f"open 0x600 {agent.port}")
        again.ok("node 0 pair_again -")
        graph = observer.see(lambda g: "/pair_again" in g["nodes"] and "/pair_0" not in g["nodes"])
        assert time.monotonic() - start < 2.5, "the new session ends the old one, not its time-out"
        assert "/pair_1" in graph["nodes"]
        for peer in (again, second):
            peer.ok("close")


# An agent that is killed and started again


@pytest.mark.ros
@pytest.mark.parametrize("liveliness", first(["ping", "acknack", "none"]))
def test_a_killed_agent_restarts(
    images: Images,
    pool_image: Image,
    acknack_image: Image,
    none_image: Image,
    relay: Relay,
    observer: Observer,
    domain: int,
    liveliness: str,
) -> None:
    image = {"ping": pool_image, "acknack": acknack_image, "none": none_image}[liveliness]
    topic = f"/returns_{liveliness}"
    observer.subscribe(topic, "std_msgs/msg/Int32", reliable=False)
    with Live(images.live(image)) as live:
        with running_agent(domain, "--domain", str(domain)) as agent:
            relay.connect(agent.port)
            live.start(relay.port, key=0x700, topic=topic, qos="reliable")
            live.ok(f"publisher 1 0 Int32 {topic} best_effort")
            live_until_heard(live, observer, topic)
            agent.process.send_signal(signal.SIGKILL)
            agent.process.wait(timeout=seconds(10))
        live.begin("burst 1 1000 100 5")  # nobody listens
        with running_agent(domain, "--domain", str(domain)) as agent:
            relay.connect(agent.port)
            live.end()
            if liveliness == "none":
                stays_lost(live)
                live.ok(f"open 0x700 {relay.port}")
                live.ok("node 0 talker -")
                live.ok(f"publisher 0 0 Int32 {topic} reliable")
            reconnects(live, observer, topic)
            if liveliness != "none":
                assert live.statistics()["reconnects"] >= 1
            live.ok("close")


def stays_lost(live: Live) -> None:
    """Without liveliness nothing is asked: best effort goes on into the void, and the stream fills up."""
    quick = live.burst(0, 30, 5, publisher=1)
    assert {s.code for s in quick} == {0}
    assert live.burst(0, 10, 0)[-1].code == 1
    assert live.statistics()["reconnects"] == 0
    assert live.call("close").took_us < 300_000 + HICCUP_US


def reconnects(live: Live, observer: Observer, topic: str, timeout_s: float = 15.0) -> None:
    """Publish until samples arrive again."""
    end = deadline(timeout_s)
    value = 5000
    while not any(v["data"] >= 5000 for name, v in observer.ask(do="samples") if name == topic):
        assert time.monotonic() < end, f"no sample arrives: {live.statistics()}"
        live.call(f"publish 0 {value}")
        value += 1
        time.sleep(0.02)
