# SPDX-License-Identifier: Apache-2.0
"""Services under an executor: rclpy calls and is called, through this project's agent, images with sanitizers."""

from __future__ import annotations

import json
import subprocess
import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, QUICK, SANITIZE, Images, started, tool
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line, await_replies
from tests.support.patience import seconds
from tests.support.slices import first

pytestmark = pytest.mark.ros

TYPE = "rcl_interfaces/srv/GetParameterTypes"
SERVER = """\
version: 1
profiles: [pure_reader]
components: [-subscribe, +services, +executor]
nodes:
  - name: server
    namespace: /arm
    services:
      - {name: lengths, type: rcl_interfaces/srv/GetParameterTypes, limits: {names: {sequence: 3, string: 8}}}
limits: {"*": {string: 8, sequence: 8}}
"""
ASKER = """\
version: 1
profiles: [pure_sender]
components: [-publish, +services, +executor]
nodes:
  - name: asker
    clients:
      - {name: /peer/lengths, type: rcl_interfaces/srv/GetParameterTypes}
limits: {"*": {string: 8, sequence: 4}}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")


def call(program: Path, observer: Observer) -> None:
    """Six requests at once, with a queue of four; then one above the limits, which is refused in words."""
    with started(program, "7") as process:
        await_line(process, "ready /arm/lengths")
        names = [["a" * (i + 1), "b"][: 1 + i % 2] for i in range(6)]
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=names)
        assert await_replies(observer) == [[len(name) for name in requested] for requested in names]
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=[["much too long"]])
        refused = await_line(process, "refused")
        assert "set limits: {rcl_interfaces/srv/GetParameterTypes_Request: {names: {string: 13}}}" in refused
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=[["short"]])
        assert await_replies(observer) == [[5]]
        out, errors = process.communicate(timeout=seconds(15))
    assert (process.returncode, errors) == (0, ""), out


def answer(program: Path, observer: Observer) -> None:
    """Three requests under way; the server answers the last one first."""
    observer.ask(do="serve", service="/peer/lengths", type=TYPE, hold=3)
    pipe = subprocess.PIPE
    with subprocess.Popen([program, "3"], text=True, stdin=pipe, stdout=pipe, stderr=pipe) as process:
        try:
            await_line(process, "ready")
            time.sleep(1)  # services are not among the topics of the graph: discovery has had a second
            out, errors = process.communicate("\n", timeout=seconds(20))
        finally:
            process.kill()
            observer.ask(do="stop_serving")
    assert (process.returncode, errors) == (0, ""), out
    lines = out.splitlines()
    assert lines[:3] == ["request 1", "request 2", "request 3"]
    assert lines[3:] == ["reply 3: 1 2 3", "reply 2: 1 2", "reply 1: 1"]


@pytest.mark.parametrize("entities", ["binary", pytest.param("xml", marks=pytest.mark.variant)])
def test_rclpy_calls_a_service(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, tmp_path: Path, entities: str
) -> None:
    flags = ("-m32", *SANITIZE) if entities == "xml" else ()
    image = images.build(image_port.port, f"{SERVER}entities: {entities}\n", flags=flags)
    call(image.application(C_FILES / "serve.c", tmp_path / "serve", *STRICT), observer)


@pytest.mark.parametrize("entities", ["binary", pytest.param("xml", marks=pytest.mark.variant)])
def test_a_client_calls_rclpy(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, tmp_path: Path, entities: str
) -> None:
    flags = ("-m32", *SANITIZE) if entities == "xml" else ()
    image = images.build(image_port.port, f"{ASKER}entities: {entities}\n", flags=flags)
    answer(image.application(C_FILES / "ask.c", tmp_path / "ask", *STRICT), observer)


@pytest.mark.system
@pytest.mark.parametrize(
    "ways", first([("reference", "preconfigured"), ("preconfigured", "reference")]), ids="-".join
)
def test_the_agent_holds_them(
    images: Images, relay: Relay, observer: Observer, domain: int, tmp_path: Path, ways: tuple[str, str]
) -> None:
    """Server and client by what OUT/agent has: nothing of them is described on the wire."""
    sources = {SERVER: ("serve.c", call), ASKER: ("ask.c", answer)}
    options, programs = [], []
    for (application, (source, act)), way in zip(sources.items(), ways, strict=True):
        image = images.build(relay.port, f"{application}entities: {way}\n", flags=QUICK)
        (file,) = (image.out / "agent").iterdir()
        options += ["--references" if way == "reference" else "--entities", str(file)]
        programs.append((image.application(C_FILES / source, tmp_path / source[:-2], *STRICT), act))
    with running_agent(domain, "--domain", str(domain), *options) as agent:
        relay.connect(agent.port)
        for program, act in programs:
            act(program, observer)


EXAMPLE = """\
version: 1
profiles: [pure_sender]
components: [+services]
nodes:
  - name: arm
    namespace: /left
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    services:
      - {name: grip, type: std_srvs/srv/SetBool}
      - {name: empty, type: std_srvs/srv/Empty}
    clients: [{name: grip, type: std_srvs/srv/SetBool, queue: 2, limits: {message: 9}}]
limits: {"*": {string: 16}}
"""


@pytest.mark.system
def test_the_example_asks_itself(images: Images, image_port: Relay, agent: AgentProcess) -> None:
    """Its server and its client are two DDS endpoints; `size` and `explain` know both, with their queues."""
    image = images.build(image_port.port, EXAMPLE, flags=QUICK)
    with started(image.program) as process:
        assert process.stdout is not None
        lines: set[str] = set()
        wanted = {"request of grip: 0", "request of grip: 1", "reply"}
        for _ in range(100):
            line = process.stdout.readline().rstrip()
            lines.add("reply" if line.startswith("reply of grip: ") else line)
            if lines == wanted:
                break
    assert lines == wanted
    tool("build", "-c", image.out.parent / "microros.yaml", "-o", image.out)
    found = tool("size", image.out, "--format", "json")
    entities = {(e["kind"], e["name"]): e for e in json.loads(found)["entities"]}
    queues = {
        ("service", "/left/grip"): 4 * 28,
        ("service", "/left/empty"): 4 * 28,
        ("client", "/left/grip"): 2 * 24,
    }
    for entity, queue in queues.items():
        assert queue < entities[entity]["ram"] < queue + 250
        assert entities[entity]["type_flash"] > 0
    output = tool("explain", image.out, "std_srvs/srv/SetBool_Response")
    assert "service /left/grip (std_srvs/srv/SetBool)" in output
    assert "client /left/grip (std_srvs/srv/SetBool)" in output
    assert "/left/empty" not in output
