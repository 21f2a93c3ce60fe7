# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock in an image with services, actions, parameters and timers: each has a bound."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import pytest

from microros_gen.image.elf import Elf
from microros_gen.image.folder import read_folder
from microros_gen.image.lock_holds import TaskHold, task_holds
from microros_gen.image.report import measure_folder
from tests.support.firmware.board import C_FILES
from tests.support.firmware.tasks import built_tasks

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +services, +parameters, +timers, +action_server, +action_client]
errors: code
transport: {type: udp}
limits: {"*": {string: 40, sequence: 8}}
session: {key: 1, connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    subscriptions: [{topic: heard, type: std_msgs/msg/String}]
    services: [{name: on, type: std_srvs/srv/SetBool}]
    clients: [{name: off, type: std_srvs/srv/SetBool}]
    actions: [{name: move, type: example_interfaces/action/Fibonacci, goals: 2}]
    action_clients: [{name: turn, type: example_interfaces/action/Fibonacci, goals: 2}]
    parameters: {declare: [{name: gain, type: double, default: 1.0}]}
    timers: [{name: tick, period: 100 ms}]
    executors: [{name: fast, handles: [tick]}, {name: slow, handles: [heard, on]}]
tasks:
  - {name: control, executor: fast, rate: 100 Hz}
  - {name: worker, executor: slow, interval: 10 ms}
  - {name: session, session: true, interval: 10 ms}
"""
HOLDING = {
    "rcl_timer_call_with_info",
    "rmw_replier_take",
    "rmw_replier_end",
    "rclc_action_client_take",
    "rclc_action_send_result",
}


def of_control(rows: Sequence[TaskHold]) -> Mapping[str, int]:
    """Return the instructions of each hold of the task `control`, of several of a function the longest."""
    (control,) = (row for row in rows if row.name == "control")
    return {hold.function: hold.length.count for hold in reversed(control.holds)}


@pytest.mark.system
def test_services_actions_parameters_and_timers_have_a_bound(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    home = tmp_path_factory.mktemp("services")
    built = built_tasks(home, application=APPLICATION)
    (example,) = (built.out / "examples").glob("*/main.c")
    image = built.link(C_FILES / "linked_tasks.c", home / "services.elf", "-include", str(example))
    elf = Elf(image)
    report = measure_folder(read_folder(built.out, image), elf)
    rows = task_holds(report, elf, port=0)
    assert all(row.open == () and (row.instructions or 0) > 1000 for row in rows), rows
    first = of_control(rows)
    assert set(first) >= HOLDING, sorted(first)
    header = built.out / "include" / "microros_config.h"
    text, changed = re.subn(r"(#define MICROROS_REQUESTS_MAX) \d+u", r"\1 400u", header.read_text())
    assert changed == 1, "the outstanding requests of all clients"
    header.write_text(text)
    more = of_control(task_holds(report, elf, port=0))
    assert more["rclc_action_client_take"] > 10 * first["rclc_action_client_take"], "the comments are read"
    assert more["rcl_timer_call_with_info"] == first["rcl_timer_call_with_info"]
