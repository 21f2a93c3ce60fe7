# SPDX-License-Identifier: Apache-2.0
"""Devices, an agent with a policy, and rclpy: what devices are told, and what ROS 2 sees."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from microros_gen.agent.wire.constants import Status
from tests.support.agent.client import BEST_EFFORT, XrceClient, int32_body, service_blob
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.agent.serial_link import SerialLink
from tests.support.e2e.images import Image, Images
from tests.support.e2e.live import Live
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

RULES = """\
version: 1
clients:
  - name: talker
    keys: [0x77]
    addresses: [127.0.0.0/8]
    domain: {domain}
    publish: [/chatter, {{name: /kept, durability: volatile}}, {{name: /few, depth: 3}}]
  - name: far
    keys: [0x78]
    addresses: [10.0.0.0/8]
    publish: [/chatter]
  - name: flood
    keys: [0x79]
    domain: {domain}
    publish: [/flood]
    limits: {{messages_per_second: 200}}
  - name: elsewhere
    keys: [0x7A]
    domain: {other}
    publish: [/other]
"""


class Guarded:
    """An agent with RULES in a file that a test can change."""

    def __init__(self, agent: AgentProcess, file: Path, domain: int) -> None:
        self.agent = agent
        self.file = file
        self.domain = domain

    def apply(self, text: str) -> str:
        """Write another policy and let the agent read it; return the line of its log about it."""
        self.file.write_text(text)
        self.agent.process.send_signal(signal.SIGHUP)
        return self.agent.wait_for("policy")


def rules(domain: int) -> str:
    return RULES.format(domain=domain, other=domain + 101)


def wait_until_it_arrives(live: Live, observer: Observer) -> None:
    """Publish on /chatter until a sample arrives: from then on all do."""
    end = deadline(20)
    observer.see(lambda graph: "/chatter" in graph["publishers"])
    while not [name for name, _ in observer.ask(do="samples") if name == "/chatter"]:
        assert time.monotonic() < end, "no sample arrives"
        live.call("publish 0 -1")
        live.ok("flush 2000")
        time.sleep(0.05)


def check_that_all_arrive(live: Live, observer: Observer) -> None:
    """Publish ten values on /chatter, each after the agent has the one before."""
    for value in range(10):
        live.ok(f"publish 0 {value}")
        live.ok("flush 2000")
    found: list[int] = []
    while len(found) < 10:
        found += [v["data"] for _, v in observer.got(1, topic="/chatter") if v["data"] >= 0]
    assert found == list(range(10))


@pytest.fixture
def guarded(domain: int, tmp_path: Path) -> Iterator[Guarded]:
    file = tmp_path / "policy.yaml"
    file.write_text(rules(domain))
    with running_agent(domain, "--policy", str(file)) as agent:
        yield Guarded(agent, file, domain)


@pytest.fixture
def live(images: Images, pool_image: Image) -> Iterator[Live]:
    with Live(images.live(pool_image)) as running:
        yield running


@pytest.mark.parametrize("key", ["1", "120"], ids=["key", "address"])
def test_a_refused_device_gets_the_reason(guarded: Guarded, live: Live, key: str) -> None:
    port = guarded.agent.port
    answer = live.call(f"open {key} {port}")
    assert (answer.code, answer.text) == (1, f"the agent at 127.0.0.1:{port} refuses the session: DENIED")
    line = guarded.agent.wait_for("was refused")
    assert "no rule of the policy is for it" in line
    live.ok(f"open 119 {port}")
    live.ok("close")


def test_a_refused_entity_leaves_the_others_alone(guarded: Guarded, live: Live, observer: Observer) -> None:
    """In the domain of the rule, which is not that of the device."""
    observer.subscribe("/chatter", INT32)
    live.start(guarded.agent.port)
    for place, (topic, qos) in enumerate(
        (("secret", "reliable"), ("kept", "latched"), ("few", "reliable")), 1
    ):
        answer = live.call(f"publisher {place} 0 Int32 {topic} {qos}")
        assert (answer.code, answer.text) == (
            1,
            f"datawriter /{topic}: the agent refuses it: DENIED (entities in microros.yaml)",
        )
    assert "does not let it publish on /secret" in guarded.agent.wait_for("/secret")
    assert "publish on /kept with transient_local" in guarded.agent.wait_for("/kept")
    assert "publish on /few with depth" in guarded.agent.wait_for("/few")
    wait_until_it_arrives(live, observer)
    check_that_all_arrive(live, observer)
    assert int(live.ok("statistics").lines[0].split("refused=")[1]) >= 3
    live.ok("close")


def test_services_are_refused_as_topics_are(guarded: Guarded) -> None:
    with XrceClient(guarded.agent.port, 0x77) as client:
        assert client.connect() == 0
        client.publisher("server", "chatter", INT32, 0)
        for kind in (7, 8):
            blob = service_blob("/reset", "std_srvs/srv/SetBool")
            assert client.create(0x20 | kind, 3, blob, 0x11) == Status.DENIED
        assert client.leave() == 0


def test_each_is_in_the_domain_of_its_rule(guarded: Guarded, observer: Observer) -> None:
    with ExitStack() as stack:
        elsewhere = stack.enter_context(observing(guarded.domain + 101))
        first = stack.enter_context(XrceClient(guarded.agent.port, 0x77))
        second = stack.enter_context(XrceClient(guarded.agent.port, 0x7A))
        for client, topic in ((first, "chatter"), (second, "other")):
            assert client.connect() == 0
            client.publisher(f"node_{topic}", topic, INT32, 5)
        own_graph = observer.see(lambda graph: "/chatter" in graph["publishers"])
        other_graph = elsewhere.see(lambda graph: "/other" in graph["publishers"])
        assert "/other" not in own_graph["publishers"]
        assert "/chatter" not in other_graph["publishers"]
        first.leave()
        second.leave()


def test_a_client_that_floods_does_not_delay_a_device(
    guarded: Guarded, live: Live, observer: Observer
) -> None:
    observer.subscribe("/chatter", INT32)
    live.start(guarded.agent.port)
    wait_until_it_arrives(live, observer)
    with XrceClient(guarded.agent.port, 0x79) as flood:
        assert flood.connect() == 0
        writer = flood.publisher("flood", "flood", INT32, 0)
        for _ in range(2000):
            flood.write(writer, int32_body(1), BEST_EFFORT)
        check_that_all_arrive(live, observer)
    assert "more than 200 in a second" in guarded.agent.wait_for("more than 200")
    live.ok("close")


def test_another_policy_keeps_those_that_stay_allowed(
    guarded: Guarded, live: Live, observer: Observer
) -> None:
    observer.subscribe("/chatter", INT32)
    live.start(guarded.agent.port)
    wait_until_it_arrives(live, observer)
    with XrceClient(guarded.agent.port, 0x7A) as other:
        assert other.connect() == 0
        other.publisher("other", "other", INT32, 0)
        text = rules(guarded.domain)
        assert "MG-1005" in guarded.apply(text.replace("[0x7A]", "[]"))
        assert "the one before stays in force" in guarded.agent.wait_for("stays in force")
        assert other.ping() == 1
        assert "3 rules" in guarded.apply(text[: text.index("  - name: elsewhere")])
        guarded.agent.wait_for("client 0000007A disconnected by the new policy")
        assert other.connect() == Status.DENIED
    check_that_all_arrive(live, observer)
    assert "reconnects=0" in live.ok("statistics").lines[0]
    guarded.apply("version: 1\nclients: []\n")
    end = deadline(20)
    while "was refused" not in guarded.agent.wait_for("00000077"):
        assert time.monotonic() < end, "the device notices, comes again, and is refused"
    assert live.call("connected").code == 0


def test_lines_by_their_paths(domain: int, tmp_path: Path) -> None:
    policy, link = tmp_path / "policy.yaml", tmp_path / "board"
    for pattern, status in ((f"{tmp_path}/b*", 0), ("/dev/serial/by-id/*", Status.DENIED)):
        policy.write_text(f"version: 1\nclients:\n  - {{name: a, devices: ['{pattern}'], publish: [/x]}}\n")
        with (
            running_agent(domain, "--policy", str(policy), transport=("pty", "--link", str(link))),
            XrceClient(SerialLink(str(link))) as client,
        ):
            assert client.connect() == status
