# SPDX-License-Identifier: Apache-2.0
"""The manager as a process, with life cycle nodes of rclpy in processes."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from microros_gen.mode_manager.diagnosis import TOPIC, TYPE
from tests.support.mode_manager.arm import ARM, GRIPPER, JOINT, start
from tests.support.mode_manager.device import Device, alive
from tests.support.mode_manager.processes import manager, node
from tests.support.modes.models import MODELS
from tests.support.patience import seconds
from tests.support.ros.running import Running, running

pytestmark = pytest.mark.ros


def test_a_system_of_two_nodes(stack: ExitStack, domain: int) -> None:
    asking, managing = start(stack, domain, ARM, gripper=GRIPPER, joint=JOINT)
    events: list[dict[str, Any]] = []
    asking.peer.subscribe("/arm/mode_event", "system_modes_msgs/msg/ModeEvent", events.append)
    requests: list[dict[str, Any]] = []
    asking.peer.subscribe("/joint/mode_request_info", "system_modes_msgs/msg/ModeEvent", requests.append)
    modes = asking.call("/arm/get_available_modes", "system_modes_msgs/srv/GetAvailableModes")
    assert modes == {"available_modes": ["__DEFAULT__", "GENTLE", "QUICK"]}
    states = asking.call("/arm/get_available_states", "lifecycle_msgs/srv/GetAvailableStates")
    assert [state["label"] for state in states["available_states"]] == ["inactive", "active"]
    assert asking.state("arm") == "unconfigured"
    assert not asking.change_mode("arm", "FAST")
    assert asking.change_state("arm", 1)
    asking.until_row("arm", "inactive")
    asking.until(lambda: asking.rows["joint"].actual == "inactive")
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    assert (asking.state("arm"), asking.mode("arm")) == ("active", "QUICK")
    assert (asking.state("joint"), asking.mode("joint")) == ("active", "RUSH")
    (transition,) = asking.call(
        "/arm/get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions"
    )["available_transitions"]
    assert transition["transition"] == {"id": 4, "label": "deactivate"}
    asking.until(lambda: [e["goal_mode"]["label"] for e in events] == ["QUICK"])
    asking.until(lambda: [e["goal_mode"]["label"] for e in requests] == ["RUSH"])
    assert asking.change_mode("joint", "CRAWL")
    asking.until_row("joint", "active.CRAWL")
    assert asking.change_state("arm", 4)
    asking.until_row("arm", "inactive")
    assert asking.state("gripper") == "inactive"
    managing.process.send_signal(signal.SIGTERM)
    assert managing.process.wait(seconds(10)) == 0


def test_a_node_that_cannot_be_activated_degrades_the_arm(stack: ExitStack, domain: int) -> None:
    faulty = {**GRIPPER, "refuse_activation": True}
    asking, managing = start(stack, domain, ARM, gripper=faulty, joint=JOINT)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.__DEFAULT__", 60)
    assert asking.rows["arm"].rule == "without_gripper_quick"
    assert managing.says("gripper: it refuses change_state activate")
    assert asking.state("gripper") == "inactive"


@pytest.mark.system
def test_a_node_that_answers_late(stack: ExitStack, domain: int) -> None:
    """Its response takes longer than the manager waits: it is found in its target afterwards."""
    slow = {**GRIPPER, "late_s": 4.0}
    asking, managing = start(stack, domain, ARM, "--timeout", "2", gripper=slow, joint=JOINT)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK", 60)
    assert asking.rows["gripper"].retries > 0
    assert not managing.says("rule")


@pytest.mark.system
def test_changes_by_others_are_noticed(stack: ExitStack, domain: int) -> None:
    asking, managing = start(stack, domain, ARM, gripper=GRIPPER, joint=JOINT)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    asking.set("joint", speed=0.7)
    managing.wait_for("joint: others changed it from active.RUSH to active")
    asking.until_row("arm", "active.QUICK")
    assert asking.change_state("gripper", 4)
    managing.wait_for("rule without_gripper_quick")
    asking.until_row("arm", "active.__DEFAULT__")


def manages(process: Running) -> bool:
    """Return whether a manager says last that it manages."""
    process.says("")
    output = [x for x in process.lines if "mode manager ready" in x or "is managed by another" in x]
    return bool(output) and "mode manager ready" in output[-1]


def test_a_manager_that_is_killed_and_one_that_takes_over(stack: ExitStack, domain: int) -> None:
    """Of two with one scope one manages; it is killed, and the other one takes over the mode of the arm."""
    asking, first = start(stack, domain, ARM, gripper=GRIPPER, joint=JOINT)
    second = stack.enter_context(manager(domain, ARM))
    both = [first, second]
    asking.until(lambda: any(each.says("is managed by another node (/mode_manager_") for each in both))
    asking.until(lambda: sum(map(manages, both)) == 1)
    managing, waiting = sorted(both, key=manages, reverse=True)
    assert asking.change_mode("arm", "GENTLE")
    asking.until_row("arm", "active.GENTLE")
    assert not manages(waiting)
    managing.process.kill()
    managing.process.wait()
    asking.until(lambda: manages(waiting), 60)
    waiting.wait_for("arm: it is active.GENTLE, and stays so")
    asking.rows.clear()
    asking.until_row("arm", "active.GENTLE")
    assert asking.rows["arm"].target == "active.GENTLE"


@pytest.mark.variant
@pytest.mark.system
def test_two_managers_of_one_hierarchy(stack: ExitStack, domain: int) -> None:
    """The lower one manages the base with its nodes in a namespace; the upper one uses it by its services."""
    robot = str(MODELS / "robot.yaml")
    wheels = {f"wheels/{side}": {"speed": 0.0} for side in ("left", "right")}
    for name, values in wheels.items():
        extra = {"pid.p": 1.0, "pid.i": 0.1} if "left" in name else {}
        stack.enter_context(node(domain, name, **values, **extra))
    lower = stack.enter_context(manager(domain, robot, "--scope", "base"))
    lower.wait_for("mode manager ready: base")
    camera = {"rate": 10, "topics": ["front", "rear"]}
    asking, upper = start(stack, domain, robot, "--without", "base", camera=camera)
    asking.until(lambda: "base" in asking.rows and "wheels/left" in asking.rows)
    asking.until(lambda: asking.rows["wheels/left"].actual != "unknown")
    assert asking.change_mode("robot", "FAST")
    asking.until_row("robot", "active.FAST", 60)
    assert asking.mode("base") == "DRIVE"
    assert asking.state("wheels/left") == "active"
    assert asking.change_state("robot", 4)
    asking.until_row("robot", "inactive", 60)
    assert asking.state("wheels/right") == "inactive"
    assert not upper.says("waits")
    assert not lower.says("waits")


def test_a_device_with_mode_services_and_its_agent(stack: ExitStack, domain: int) -> None:
    """Its own services are used and not served twice; when the agent says that it is silent, it is unknown at once."""
    device = Device("joint", ("__DEFAULT__", "CRAWL", "RUSH"))
    stack.enter_context(alive(device))
    asking, managing = start(stack, domain, ARM, gripper=GRIPPER)
    asking.until(lambda: asking.rows["joint"].actual == "unconfigured")
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    assert device.requests == ["configure", "RUSH", "activate"]
    graph = asking.peer.graph()
    asking.until(lambda: graph.count_servers("/joint/change_mode") > 0)
    assert graph.count_servers("/joint/change_mode") == 1
    device.agent_says.append(1)
    managing.wait_for("joint: it has left")
    asking.until_row("joint", "unknown")
    assert asking.rows["joint"].message == "it is not there"
    device.state, device.mode = "unconfigured", "__DEFAULT__"
    device.agent_says.append(0)
    asking.until_row("arm", "active.QUICK")
    assert device.mode == "RUSH"


def test_a_device_that_is_a_part_by_its_application_file(
    stack: ExitStack, domain: int, tmp_path: Path
) -> None:
    model, application = tmp_path / "cell.yaml", tmp_path / "device.yaml"
    modes = "{__DEFAULT__: {device: inactive}, SLOW: {device: active.SLOW}}"
    model.write_text(
        f"cell: {{ros__parameters: {{type: system, parts: [device], modes: {modes}}}}}\n", encoding="utf-8"
    )
    application.write_text(
        "version: 1\nprofiles: [managed_service]\nnodes:\n  - name: device\n    parameters:\n"
        "      - {name: speed, type: double, default: 0.5}\n    modes:\n      SLOW: {speed: 0.2}\n",
        encoding="utf-8",
    )
    device = Device("device", ("__DEFAULT__", "SLOW"))
    stack.enter_context(alive(device))
    asking, _ = start(stack, domain, str(model), "--application", str(application))
    asking.until(lambda: "device" in asking.rows and asking.rows["device"].actual == "unconfigured")
    assert asking.change_mode("cell", "SLOW")
    asking.until_row("cell", "active.SLOW")
    assert device.requests == ["configure", "SLOW", "activate"]


@pytest.mark.system
def test_errors_on_diagnostics_reach_the_system(stack: ExitStack, domain: int) -> None:
    asking, _ = start(stack, domain, ARM, gripper=GRIPPER, joint=JOINT)
    assert asking.change_mode("arm", "GENTLE")
    asking.until_row("arm", "active.GENTLE")
    publisher = asking.peer.publisher(TOPIC, TYPE)
    asking.until(lambda: publisher.subscriptions() == 2)
    status = {"name": "gripper: motor", "level": 2, "message": "too hot"}
    publisher.publish({"status": [status]})
    asking.until_row("arm", "errorprocessing")
    assert asking.rows["gripper"].message == "gripper: motor: too hot"
    publisher.publish({"status": [{**status, "level": 0}]})
    asking.until_row("arm", "active.GENTLE")


@pytest.mark.system
def test_a_manager_that_is_killed_in_the_middle(stack: ExitStack, domain: int) -> None:
    """The gripper activates slowly, and the manager dies meanwhile: the next one commands nothing by itself."""
    slow = {**GRIPPER, "late_s": 3.0}
    asking, managing = start(stack, domain, ARM, gripper=slow, joint=JOINT)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("joint", "active.RUSH")
    asking.until(lambda: asking.rows["gripper"].actual == "inactive")
    managing.process.kill()
    managing.process.wait()
    asking.set("joint", speed=0.3)
    asking.rows.clear()
    second = stack.enter_context(manager(domain, ARM))
    second.wait_for("mode manager ready", 60)
    asking.until_row("joint", "active", 60)
    asking.until_row("gripper", "active.FIRM", 60)
    assert (asking.rows["arm"].target, asking.rows["arm"].actual) == ("", "active")
    assert asking.change_mode("arm", "GENTLE")
    asking.until_row("arm", "active.GENTLE")


@pytest.mark.system
def test_the_monitor_without_and_with_a_manager(stack: ExitStack, domain: int) -> None:
    command = [sys.executable, "-m", "microros_gen", "modes", "monitor", ARM, "--once", "--format", "json"]
    run = subprocess.run([*command, "--wait", "1"], capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert {part["message"] for part in json.loads(run.stdout)["parts"]} == {"no manager reports it"}
    start(stack, domain, ARM, gripper=GRIPPER, joint=JOINT)
    run = subprocess.run([*command, "--wait", "60"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout
    live = stack.enter_context(running(domain, "microros_gen", "modes", "monitor", ARM))
    live.wait_for("  joint")
    live.wait_for("unconfigured")
    live.process.send_signal(signal.SIGINT)
    assert live.process.wait(seconds(10)) == 0
