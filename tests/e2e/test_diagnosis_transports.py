# SPDX-License-Identifier: Apache-2.0
"""Reports of a device that reaches its agent over TCP, by functions of the application, or between two sleeps."""

from __future__ import annotations

import shutil
import socket
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.images import C_FILES, QUICK, Images, run, started
from tests.support.e2e.relay import Relay
from tests.support.free_ports import free_port
from tests.support.paths import TESTS
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+diagnosis]
transport: {{type: {transport}}}
session: {{key: {key}, connect_timeout: 20 s, create_timeout: 20 s}}
diagnosis: {{period: 200 ms}}
nodes:
  - name: {node}
    publishers: [{{topic: {node}_out, type: std_msgs/msg/Int32}}]
on_full: block 2 s
"""
SLEEPER = """\
version: 1
profiles: [pure_sender]
components: [+subscribe, +sleep_cycles, +diagnosis]
diagnosis: {period: 100 ms}
nodes:
  - name: sleeper
    publishers: [{topic: sleep_out, type: std_msgs/msg/Int32, qos: {depth: 1000}}]
    subscriptions: [{topic: sleep_in, type: std_msgs/msg/Int32, queue: 8, qos: {depth: 1000}}]
on_full: block 2 s
"""
TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"


def wait_for_session(observer: Observer, node: str, again: Callable[[], object] = bool) -> dict[str, int]:
    """Return the counters of the next report of a node's session; `again` is called until it has arrived."""
    end = deadline(60)
    while True:
        again()
        for topic, array in observer.ask(do="samples"):
            for status in array["status"] if topic == TOPIC else ():
                if status["name"] == f"{node}: session" and status["level"] == 0:
                    return {pair["key"]: int(pair["value"]) for pair in status["values"]}
        assert time.monotonic() < end
        time.sleep(0.05)


def test_over_tcp(images: Images, observer: Observer, domain: int) -> None:
    port = free_port(socket.SOCK_STREAM)
    text = APPLICATION.format(transport=f'tcp, agent: "127.0.0.1:{port}"', key=21, node="over_tcp")
    image = images.build(0, text, flags=(*QUICK, "-DEXAMPLE_SAMPLES=100000", "-DEXAMPLE_PERIOD_MS=15"))
    observer.subscribe(TOPIC, TYPE)
    where = ("tcp4", "--port", str(port))
    with running_agent(domain, "--domain", str(domain), transport=where), started(image.program) as running:
        first = wait_for_session(observer, "over_tcp")
        later = wait_for_session(observer, "over_tcp")
        running.terminate()
    assert later["sent"] > first["sent"] > 0
    assert later["malformed"] == 0
    shutil.rmtree(image.out.parent)  # its port is this test's


@pytest.mark.system
def test_by_functions_of_an_application(
    images: Images, observer: Observer, domain: int, tmp_path: Path
) -> None:
    image = images.build(0, APPLICATION.format(transport="custom", key=22, node="talker"), flags=QUICK)
    text = (TESTS / "runtime" / "c" / "custom.c").read_text(encoding="utf-8")
    text = text.replace("VALUES = 100", "VALUES = 2000").replace("sleep_ms(2)", "sleep_ms(15)")
    (tmp_path / "custom.c").write_text(text.replace('"chatter"', '"talker_out"'), encoding="utf-8")
    (tmp_path / "types.h").write_text("#include <std_msgs/msg/int32.h>\n", encoding="utf-8")
    program = image.application(tmp_path / "custom.c", tmp_path / "custom", "-std=c99")
    observer.subscribe(TOPIC, TYPE)
    with (
        running_agent(domain, "--domain", str(domain), transport=("udp4", "--port", "0")) as agent,
        started(program, "udp", str(agent.port)) as running,
    ):
        first = wait_for_session(observer, "talker")
        later = wait_for_session(observer, "talker")
        running.terminate()
    assert later["sent"] > first["sent"] > 0


@pytest.mark.system
def test_between_two_sleeps(
    images: Images, relay: Relay, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """Each time awake is a process: the session goes on, and so do its counters and the reports.

    A report is due before the node is opened again.
    """
    image = images.build(relay.port, SLEEPER)
    program = image.application(C_FILES / "sleep.c", tmp_path / "sleep", "-std=c99", "-Wall", "-Werror")
    words: list[str] = []

    def awake() -> None:
        done = run([str(program), str(tmp_path / "memory"), "0", "3", "0", "150"])
        assert done.returncode == 0, done.stderr
        words.append(done.stdout.split()[0])

    observer.subscribe(TOPIC, TYPE)
    with running_agent(domain, "--domain", str(domain)) as agent:
        relay.connect(agent.port)
        first = wait_for_session(observer, "sleeper", awake)
        later = wait_for_session(observer, "sleeper", awake)
    assert words[0] == "cold"
    assert set(words[1:]) == {"woken"}
    assert later["sent"] > 0 < first["sent"]
