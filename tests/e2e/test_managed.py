# SPDX-License-Identifier: Apache-2.0
"""managed_service driven by rclpy: with every way to create entities, and what its state lets through."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import agent_options, running_agent
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, QUICK, Images, ends_well, kill, started
from tests.support.e2e.lifecycle_peer import MODEL, WHATS, LifecyclePeer, lifecycle_peer
from tests.support.e2e.relay import Relay
from tests.support.paths import TESTS
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [managed_service]
session: {{connect_timeout: 20 s, create_timeout: 10 s}}
nodes:
  - name: device
    namespace: /{namespace}
    publishers:
      - {{topic: position, type: std_msgs/msg/Int32, managed: true}}
      - {{topic: battery, type: std_msgs/msg/Int32}}
"""
PATIENT = "session: {connect_timeout: 20 s, create_timeout: 10 s}\n"
SERVES = """\
    services: [{name: set_enabled, type: std_srvs/srv/SetBool}]
limits: {std_srvs/srv/SetBool_Response: {message: 16}}
entities: """
TICKS = "    timers: [{name: control, period: 10 ms, managed: true}]\ncomponents: [+timers, +diagnosis]\n"
PERIOD_S = 0.01
INVALID_ARGUMENT = 11
WAYS = ("binary", "xml", "reference", "preconfigured")
CONFIGURE, ACTIVATE, DEACTIVATE, SHUTDOWN = 1, 3, 4, 6
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")


def until(seen: Callable[[], object], what: str) -> None:
    end = deadline(30)
    while not seen():
        assert time.monotonic() < end, what
        time.sleep(0.02)


class Arrived:
    """Samples of both topics since they were last asked for."""

    def __init__(self, observer: Observer, namespace: str) -> None:
        self._observer = observer
        self._topics = {f"/{namespace}/{name}": name for name in ("position", "battery")}
        for topic in self._topics:
            observer.subscribe(topic, "std_msgs/msg/Int32")

    def matched(self) -> bool:
        """Whether the publishers of both topics are there."""
        seen = self._observer.ask(do="graph")["publishers"]
        return all(topic in seen for topic in self._topics)

    def take(self) -> dict[str, list[int]]:
        found: dict[str, list[int]] = {name: [] for name in self._topics.values()}
        for topic, value in self._observer.ask(do="samples"):
            if topic in self._topics:
                found[self._topics[topic]].append(value["data"])
        return found

    def await_battery(self) -> dict[str, list[int]]:
        """Return what arrives until there are five more samples of the publisher that is not managed."""
        found = self.take()

        def enough() -> bool:
            for name, values in self.take().items():
                found[name] += values
            return len(found["battery"]) >= 5

        until(enough, "nothing arrives")
        return found


def agrees(peer: LifecyclePeer, device: str) -> None:
    """All that is asked for is what the model of rclpy answers in the same state."""
    for what in WHATS:
        assert peer.get(device, what) == peer.get(MODEL, what), what


def both(peer: LifecyclePeer, device: str, identifier: int) -> None:
    assert [peer.change(node, identifier) for node in (device, MODEL)] == [True, True], identifier


@pytest.mark.parametrize(
    "entities", ["binary", *(pytest.param(way, marks=pytest.mark.variant) for way in WAYS[1:])]
)
def test_every_way_to_create(
    entities: str, images: Images, image_port: Relay, relay: Relay, observer: Observer, domain: int
) -> None:
    """The generated example: six entities of the life cycle, a service, a managed publisher and another one."""
    namespace = f"by_{entities}"
    device = f"/{namespace}/device"
    text = f"{APPLICATION.format(namespace=namespace)}{SERVES}{entities}\n"
    image = images.build(image_port.port, text, flags=(*QUICK, "-DEXAMPLE_PERIOD_MS=20"))
    options = agent_options(image.out)
    assert bool(options) == (entities in ("reference", "preconfigured"))
    arrived = Arrived(observer, namespace)
    with running_agent(domain, "--domain", str(domain), *options) as agent, lifecycle_peer(domain) as peer:
        relay.connect(agent.port)
        with started(image.out / "bin" / "managed_service") as process:
            peer.ask(do="reset")
            for node in (device, MODEL):
                peer.await_services(node)
                peer.ask(do="watch", node=node)
            until(lambda: all(peer.ask(do="matched", node=node) for node in (device, MODEL)), "no events")
            time.sleep(1)  # both writers know the reader
            agrees(peer, device)
            assert arrived.await_battery()["position"] == []
            assert peer.ask(do="switch", service=f"/{namespace}/set_enabled", value=True, timeout=seconds(20))
            for identifier in (CONFIGURE, ACTIVATE):
                both(peer, device, identifier)
                agrees(peer, device)
            until(lambda: arrived.take()["position"], "an active node is silent")
            both(peer, device, DEACTIVATE)
            arrived.await_battery()  # what was under way
            assert arrived.await_battery()["position"] == []
            both(peer, device, SHUTDOWN)
            agrees(peer, device)
            events: list[list[object]] = []

            def enough() -> bool:
                events.extend(peer.ask(do="events"))
                return len(events) >= 16

            until(enough, "events are missing")
            of_device, of_model = ([e[1:] for e in events if e[0] == node] for node in (device, MODEL))
            assert of_device == of_model
            kill(process)


@pytest.mark.parametrize(
    "entities", ["binary", *(pytest.param(way, marks=pytest.mark.variant) for way in WAYS[1:])]
)
def test_the_profile_alone(
    entities: str, images: Images, image_port: Relay, relay: Relay, observer: Observer, domain: int
) -> None:
    """The example of the profile itself, without a word about entities: a service, and a publisher with a gate."""
    text = f"version: 1\nprofiles: [managed_service]\nentities: {entities}\n{PATIENT}"
    image = images.build(image_port.port, text, flags=(*QUICK, "-DEXAMPLE_PERIOD_MS=20"))
    options = [
        word
        for path in sorted((image.out / "agent").glob("*"))
        for word in ("--references" if path.suffix == ".xml" else "--entities", str(path))
    ]
    observer.subscribe("/count", "std_msgs/msg/Int32")

    def counts() -> bool:
        return any(topic == "/count" for topic, _ in observer.ask(do="samples"))

    counts()  # those of the entities before
    with running_agent(domain, "--domain", str(domain), *options) as agent, lifecycle_peer(domain) as peer:
        relay.connect(agent.port)
        with started(image.out / "bin" / "managed_service") as process:
            peer.await_services("/device")
            assert peer.ask(do="switch", service="/set_bool", value=True, timeout=seconds(20))
            until(lambda: "/count" in observer.ask(do="graph")["publishers"], "no publisher")
            time.sleep(1)  # the writer knows the reader
            assert not counts(), "an unconfigured node publishes"
            assert peer.change("/device", CONFIGURE)
            assert peer.change("/device", ACTIVATE)
            until(counts, "an active node is silent")
            kill(process)


def test_the_state_is_a_gate(
    images: Images, image_port: Relay, agent: object, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """A managed publisher and a managed timer: nothing while inactive, which is counted; everything while active.

    The diagnosis has the count of the timer, too.
    """
    waits = "on_full: block 5 s\n"  # on a busy machine ten messages are more than a stream has room for
    image = images.build(image_port.port, APPLICATION.format(namespace="gates") + TICKS + waits)
    program = image.application(C_FILES / "managed.c", tmp_path / "managed", *STRICT)
    arrived = Arrived(observer, "gates")
    with lifecycle_peer(domain) as peer, started(program) as process:
        device = CommandedProgram(process)

        def number(command: str) -> int:
            code, error, (line,) = device.call(command)
            assert code == 0, error
            return int(line)

        def grows() -> None:
            """Every period without a call counts while the node is not active."""
            times = [time.monotonic()]
            counts = [number("skipped")]
            times += [time.monotonic()]
            time.sleep(0.3)
            times += [time.monotonic()]
            counts += [number("skipped")]
            times += [time.monotonic()]
            least, most = (times[2] - times[1]) / PERIOD_S - 1, (times[3] - times[0]) / PERIOD_S + 1
            assert least <= counts[1] - counts[0] <= most, (counts, times)

        def publish(first: int) -> dict[str, list[int]]:
            """Publish five values with both publishers, and return what arrives."""
            for value in range(first, first + 5):
                assert device.call(f"publish {value}")[0] == 0
            found = arrived.await_battery()
            assert found["battery"] == [*range(first, first + 5)]
            return found

        peer.await_services("/gates/device")
        until(arrived.matched, "no publishers")
        time.sleep(1)  # the writers know the reader
        assert device.call("skipped nowhere")[:2] == (INVALID_ARGUMENT, "statistics: NULL or not initialized")
        dropped = number("dropped")
        assert publish(0)["position"] == []
        assert (number("dropped") - dropped, number("ticks")) == (5, 0)
        grows()
        assert peer.change("/gates/device", CONFIGURE)
        assert publish(10)["position"] == []
        assert (number("dropped") - dropped, number("ticks")) == (10, 0)
        assert peer.change("/gates/device", ACTIVATE)
        assert publish(20)["position"] == [*range(20, 25)]
        until(lambda: number("ticks") >= 3, "the managed timer stands still")
        assert number("dropped") - dropped == 10
        skipped, ticks = number("skipped"), number("ticks")
        until(lambda: number("ticks") >= ticks + 10, "the managed timer stands still")
        assert number("skipped") == skipped, "an active node skips none"
        assert peer.change("/gates/device", DEACTIVATE)
        ticks = number("ticks")
        assert publish(30)["position"] == []
        time.sleep(0.1)  # ten periods
        assert (number("dropped") - dropped, number("ticks")) == (15, ticks)
        assert number("skipped") >= skipped + 9
        grows()
        observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
        shown: list[int] = []

        def diagnosed() -> bool:
            for topic, value in observer.ask(do="samples"):
                if topic == "/diagnostics":
                    shown.extend(
                        int(entry["value"])
                        for status in value["status"]
                        if status["name"] == "gates/device: lifecycle"
                        for entry in status["values"]
                    )
            return bool(shown)

        least = number("skipped")
        until(lambda: diagnosed() and shown[-1] >= least, "no diagnosis")
        assert shown[-1] <= number("skipped")
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


@pytest.mark.system
def test_a_program_for_rclc(
    images: Images, image_port: Relay, agent: object, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """What `init --from` proposes for it builds, and rclpy drives the program, which is unchanged."""
    source = TESTS / "migrate/c/lifecycle_sensor.c"
    command = [sys.executable, "-m", "microros_gen", "init", "app", "--from", str(source)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    image = images.build(image_port.port, (tmp_path / "app/microros.yaml").read_text(encoding="utf-8"))
    program = image.application(source, tmp_path / "sensor")
    observer.subscribe("/readings", "std_msgs/msg/Int32")
    with lifecycle_peer(domain) as peer, started(program) as process:
        peer.ask(do="reset")
        for node in ("/sensor", MODEL):
            peer.await_services(node)
        for identifier in (CONFIGURE, ACTIVATE):
            both(peer, "/sensor", identifier)
            agrees(peer, "/sensor")
        until(lambda: any(topic == "/readings" for topic, _ in observer.ask(do="samples")), "no reading")
        both(peer, "/sensor", DEACTIVATE)
        both(peer, "/sensor", SHUTDOWN)
        ends_well(process)
