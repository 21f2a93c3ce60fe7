# SPDX-License-Identifier: Apache-2.0
"""Tasks on a Cortex-M4 that run one after the other in a program (c/measured_tasks.c) that has the agent, too."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from tests.support.firmware.board import C_FILES, Built, build, need
from tests.support.firmware.footprint import AGENT_FUNCTIONS, INTERRUPTS
from tests.support.firmware.instructions import counted_regions

BOARD = "qemu-mps2-an386"
TARGET = f"""\
target: tasked
summary: The tasks run one after the other, in the program
extends: {BOARD}
provides: [tasks, lock, wait, wake, udp]
"""
INSTRUCTIONS = {"control": 770, "worker": 790, "session": 1560}
"""Bounds of the jobs, as a user would write them: measured here, and rounded up."""
HOLDS = {"control_lock": 380, "worker_lock": 80, "session_lock": 490}
"""For how many instructions each holds the library's lock at most."""
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {{type: udp}}
session: {{key: 1, connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32, local: also}}]
    subscriptions: [{{topic: count, type: std_msgs/msg/Int32, local: only, queue: 8, qos: {{depth: 8}}}}]
    executors: [{{name: fast}}, {{name: slow, handles: [count]}}]
tasks:
  - {{name: control, executor: fast, rate: 100 Hz, stack: auto,
     instructions: {control}, lock_instructions: {control_lock}}}
  - {{name: worker, executor: slow, interval: 10 ms, stack: auto,
     instructions: {worker}, lock_instructions: {worker_lock}}}
  - {{name: session, session: true, interval: 10 ms, stack: auto,
     instructions: {session}, lock_instructions: {session_lock}}}
"""


TEXTS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {type: udp}
limits: {"*": {string: 40, sequence: 8}}
pools: {history: 8}
session: {key: 1, connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    publishers:
      - {topic: words, type: std_msgs/msg/String, local: also}
      - {topic: joints, type: sensor_msgs/msg/JointState}
      - {topic: scan, type: sensor_msgs/msg/LaserScan}
    subscriptions: [{topic: words, type: std_msgs/msg/String, local: only, queue: 8, qos: {depth: 8}}]
    executors: [{name: fast}, {name: slow, handles: [words]}]
tasks:
  - {name: control, executor: fast, rate: 100 Hz}
  - {name: worker, executor: slow, interval: 10 ms}
  - {name: session, session: true, interval: 10 ms}
"""
"""Messages with texts and sequences (c/measured_texts.h)."""


REPORTED = """\
version: 1
profiles: [pure_sender]
components: [+executor, +diagnosis]
errors: code
pools: {guard_conditions: 2}
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
diagnosis: {period: 500 ms, hardware_id: board-7}
nodes: [{name: device, namespace: /arm, executors: [{name: fast}, {name: slow}]}]
tasks:
  - {name: control, executor: fast, period: 20 ms, deadline: 19 ms, stack: 3 KiB}
  - {name: worker, executor: slow, stack: 2 KiB}
  - {name: session, session: true, stack: 4 KiB}
"""
"""Tasks whose statuses are on /diagnostics (c/task_statuses.c)."""


def built_tasks(home: Path, transport: str = "udp", application: str = "") -> Built:
    """Build the library of the tasks in `home`, for `application` if that is not empty; skip without the tools."""
    need(BOARD, emulator=True)
    network = "" if transport == "serial" else f", {transport}"
    (home / "tasked.yaml").write_text(TARGET.replace(", udp]", f"{network}]"))
    text = APPLICATION.format(**INSTRUCTIONS, **HOLDS).replace("{type: udp}", f"{{type: {transport}}}")
    done = build(home, "tasked.yaml", application or text)
    assert done.returncode == 0, done.stderr
    found = read_target("tasked.yaml", home, None, Diagnostics())
    assert found is not None
    return Built(home / "out", found.target)


def counted(built: Built, *flags: str, left_out: Sequence[str] = ()) -> Sequence[int]:
    """Return the instructions from each mark to the next one; those of the functions `left_out` are the agent's."""
    image = built.link(C_FILES / "measured_tasks.c", built.out.parent / "tasks.elf", *flags)
    return counted_regions(built.target, image, (*AGENT_FUNCTIONS, *INTERRUPTS, *left_out))


def locks_of(built: Built, image: Path, *options: str) -> subprocess.CompletedProcess[str]:
    call = [sys.executable, "-m", "microros_gen", "locks", "out", "--image", str(image), *options]
    return subprocess.run(call, cwd=built.out.parent, text=True, capture_output=True, check=False)


def holds_of(built: Built, image: Path) -> Mapping[str, Mapping[str, Any]]:
    """Return what the tool says of each task; the agent in the firmware, which is no part of it, counts as nothing."""
    found = json.loads(locks_of(built, image, "--format", "json", "--port", "0").stdout)["tasks"]
    return {row["task"]: row for row in found}
