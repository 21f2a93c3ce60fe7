# SPDX-License-Identifier: Apache-2.0
"""Services under an executor: rclpy calls and is called, through this project's agent, images with sanitizers."""

from __future__ import annotations

import subprocess
import time
from pathlib import Path

import pytest
from agent.observer import Observer
from agent.process import AgentProcess

from e2e.images import C_FILES, SANITIZE, Images, started
from e2e.relay import Relay

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


def await_line(process: subprocess.Popen[str], beginning: str) -> str:
    assert process.stdout is not None
    line = process.stdout.readline()
    assert line.startswith(beginning), line
    return line


def await_replies(observer: Observer) -> list[list[int]]:
    end = time.monotonic() + 15
    while None in (replies := observer.ask(do="replies")):
        assert time.monotonic() < end, replies
        time.sleep(0.02)
    return list(replies)


@pytest.mark.parametrize("entities", ["binary", "xml"])
def test_rclpy_calls_a_service(
    images: Images,
    image_port: Relay,
    agent: AgentProcess,
    observer: Observer,
    tmp_path: Path,
    entities: str,
) -> None:
    """Six requests at once, with a queue of four; then one above the limits, which is refused in words."""
    flags = ("-m32", *SANITIZE) if entities == "xml" else SANITIZE
    image = images.build(image_port.port, f"{SERVER}entities: {entities}\n", "gcc", flags)
    program = image.application(C_FILES / "serve.c", tmp_path / "serve", *STRICT)
    with started(program, "7") as process:
        await_line(process, "ready /arm/lengths")
        names = [["a" * (i + 1), "b"][: 1 + i % 2] for i in range(6)]
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=names)
        assert await_replies(observer) == [[len(name) for name in asked] for asked in names]
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=[["much too long"]])
        refused = await_line(process, "refused")
        assert "names[]: 13, capacity for 8" in refused
        observer.ask(do="call", service="/arm/lengths", type=TYPE, names=[["short"]])
        assert await_replies(observer) == [[5]]
        out, errors = process.communicate(timeout=15)
    assert (process.returncode, errors) == (0, ""), out


@pytest.mark.parametrize("entities", ["binary", "xml"])
def test_a_client_calls_rclpy(
    images: Images,
    image_port: Relay,
    agent: AgentProcess,
    observer: Observer,
    tmp_path: Path,
    entities: str,
) -> None:
    """Three requests under way; the server answers the last one first."""
    flags = ("-m32", *SANITIZE) if entities == "binary" else SANITIZE
    image = images.build(image_port.port, f"{ASKER}entities: {entities}\n", "gcc", flags)
    program = image.application(C_FILES / "ask.c", tmp_path / "ask", *STRICT)
    observer.ask(do="serve", service="/peer/lengths", type=TYPE, hold=3)
    command = [program, "3"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, text=True, stdin=pipe, stdout=pipe, stderr=pipe) as process:
        try:
            await_line(process, "ready")
            end = time.monotonic() + 15
            while not any(e["node"] == "/asker" for e in observer.ask(do="endpoints", topic="/peer/lengths")):
                if time.monotonic() > end - 14:
                    break  # services are not among the topics of the graph: discovery has had a second
                time.sleep(0.05)
            out, errors = process.communicate("\n", timeout=20)
        finally:
            process.kill()
    assert (process.returncode, errors) == (0, ""), out
    lines = out.splitlines()
    assert lines[:3] == ["request 1", "request 2", "request 3"]
    assert lines[3:] == ["reply 3: 1 2 3", "reply 2: 1 2", "reply 1: 1"]
