# SPDX-License-Identifier: Apache-2.0
"""Lines of a device on /rosout, as rclpy receives them; a node of rclpy logs the same text for comparison."""

from __future__ import annotations

import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
logging: [{to: rosout, level: info, size: 24 KiB}]
nodes: [{name: device, namespace: /arm}]
"""
LOG = "rcl_interfaces/msg/Log"
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
INFO, WARN, ERROR = 20, 30, 40


def program_of(images: Images, port: int, folder: Path) -> Path:
    image = images.build(port, APPLICATION)
    return image.application(C_FILES / "logs.c", folder / "logs", *STRICT)


def logged(observer: Observer, last: str, others: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Wait for a text of the device; return its lines."""
    end, found = deadline(30), others
    while not any(line["msg"] == last for line in found):
        found += [
            line
            for topic, line in observer.ask(do="samples")
            if topic == "/rosout" and line["file"].endswith("logs.c")
        ]
        assert time.monotonic() < end, found
        time.sleep(0.02)
    return found


def test_lines_as_those_of_an_rclpy_node(
    images: Images, image_port: Relay, agent: object, observer: Observer, tmp_path: Path
) -> None:
    program = program_of(images, image_port.port, tmp_path)
    began = time.time()
    with started(program, "20") as process:
        await_line(process, "ready")
        observer.subscribe("/rosout", LOG, transient_local=True)  # a late one: the agent has the first lines
        found = logged(observer, "line 19", [])
        writers = [e for e in observer.named_endpoints("/rosout", 2) if e["kind"] == "PUBLISHER"]
        model = next(e for e in writers if e["node"] == "/observer")
        own = next(e for e in writers if e["node"] == "/arm/device")
        ends_well(process, 30)
    assert {key: own[key] for key in own if key not in ("node", "lifespan_ns")} == {
        key: model[key] for key in model if key not in ("node", "lifespan_ns")
    }
    assert [(line["level"], line["name"], line["msg"]) for line in found] == [
        (INFO, "arm.device", "before the session"),
        (ERROR, "arm.device", '42 µm of "glass"'),
        *((WARN, "", f"line {number}") for number in range(20)),
    ]
    source = (C_FILES / "logs.c").read_text().splitlines()
    assert {line["function"] for line in found} == {"main"}
    assert all("RCUTILS_LOG" in source[line["line"] - 1] for line in found)
    assert all(began - 1 <= line["stamp"]["sec"] <= time.time() for line in found)


@pytest.mark.system
def test_nothing_is_lost_with_the_agent(
    images: Images, relay: Relay, domain: int, observer: Observer, tmp_path: Path
) -> None:
    """Lines that are logged while no agent is there come to the next one, in their order."""
    program = program_of(images, relay.port, tmp_path)
    options = ("--domain", str(domain))
    observer.subscribe("/rosout", LOG, transient_local=True)
    with ExitStack() as stack:
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            process = stack.enter_context(started(program, "200", "100000"))
            await_line(process, "ready")
            found = logged(observer, "line 2", [])
            relay.connect(0)
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            logged(observer, "line 199", found)
    numbers = [int(line["msg"].split()[1]) for line in found if line["msg"].startswith("line ")]
    assert sorted(set(numbers)) == list(range(200))
