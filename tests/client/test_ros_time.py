# SPDX-License-Identifier: Apache-2.0
"""The subscription of /clock that comes with `clock: ros`: its place, its queue, and what does not count it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.ids import without_id

NODES = """\
version: 1
profiles: [pure_reader]
clock: ros
components: [+timers]
nodes:
  - name: first
    timers: [{name: tick, period: 1 s}]
  - name: second
    subscriptions: [{topic: heard, type: std_msgs/msg/Int64, queue: 3}]
"""
CLOCK = "/clock (rosgraph_msgs/msg/Clock, best effort)"


def planned(folder: Path, text: str) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(text, encoding="utf-8")
    return compiler.plan(
        compiler.resolve(compiler.read(compiler.Options(config=config, interface_paths=(shipped_folder(),))))
    )


def test_with_nodes_it_is_the_first_subscription_of_the_first_node(tmp_path: Path) -> None:
    runtime = planned(tmp_path, NODES).project.runtime
    clock, subscription = runtime.entities.subscriptions.declared
    assert (clock.topic, clock.node, clock.reliable, clock.dds_type) == (
        "/clock",
        0,
        False,
        "rosgraph_msgs::msg::dds_::Clock_",
    )
    assert (subscription.topic, subscription.node) == ("/heard", 1)
    assert runtime.input.queues == (QueuePlan(1, 8), QueuePlan(3, 8))
    assert (runtime.entities.subscriptions.max, runtime.entities.subscriptions.application) == (2, 1)
    assert runtime.executor.handles_max == 2, "a timer and a subscription: nobody adds /clock to an executor"
    assert runtime.clock.ros_clocks_max == 2, "one of rclc's support"


def test_without_nodes_it_is_next_to_the_pool(tmp_path: Path) -> None:
    text = (
        "version: 1\nprofiles: [simulation_node, pure_reader]\ninterfaces: [std_msgs/msg/Float64MultiArray]\n"
    )
    found = planned(
        tmp_path, text + "pools: {subscriptions: 2, queue: 3}\nlimits: {'*': {string: 4, sequence: 4}}\n"
    )
    runtime = found.project.runtime
    assert [str(root) for root in found.project.roots] == ["std_msgs/msg/Float64MultiArray"]
    assert runtime.input.queues[0] == QueuePlan(1, 8)
    assert runtime.input.queues[1:] == (QueuePlan(3, runtime.input.queues[1].slot_size),) * 2
    assert runtime.input.queues[1].slot_size > 40
    assert runtime.entities.type_name_size > len("rosgraph_msgs::msg::dds_::Clock_")


def test_a_node_of_a_simulation_alone_has_no_other_subscription(tmp_path: Path) -> None:
    found = planned(tmp_path, "version: 1\nprofiles: [simulation_node]\n")
    runtime = found.project.runtime
    assert (runtime.entities.subscriptions.max, runtime.entities.subscriptions.application) == (1, 0)
    assert runtime.input.queues == (QueuePlan(1, 8),)
    assert runtime.input.reliable_slots == 0
    assert [str(t.name) for t in found.project.types] == [
        "builtin_interfaces/msg/Time",
        "rosgraph_msgs/msg/Clock",
    ]


def test_a_sender_of_a_simulation_decodes_the_clock_alone(tmp_path: Path) -> None:
    files = compiler.render(planned(tmp_path, "version: 1\nprofiles: [simulation_node, pure_sender]\n"))
    assert "src/rosgraph_msgs/clock__decode.c" in files
    assert "src/std_msgs/int32__decode.c" not in files
    assert b"of std_msgs/msg/Int32" in files["README.md"]
    assert b"subscription `/clock`" in files["README.md"]


@pytest.mark.parametrize("entities", ["reference", "preconfigured"])
def test_the_agent_holds_it(tmp_path: Path, entities: str) -> None:
    files = compiler.render(planned(tmp_path, f"{NODES}entities: {entities}\n"))
    if entities == "reference":
        assert b"rt/clock" in files["agent/references.xml"]
    else:
        assert "rt/clock" in json.dumps(json.loads(files["agent/entities.json"]))


def test_one_reference_cannot_be_two(tmp_path: Path) -> None:
    """The application may have its own subscription of /clock, but not with another QoS by reference."""
    declared = "topic: heard, type: std_msgs/msg/Int64, queue: 3"
    own = NODES.replace(declared, "topic: /clock, type: rosgraph_msgs/msg/Clock")
    runtime = planned(tmp_path, own).project.runtime
    assert [(s.topic, s.node, s.reliable) for s in runtime.entities.subscriptions.declared] == [
        ("/clock", 0, False),
        ("/clock", 1, True),
    ]
    with pytest.raises(UserError) as caught:
        planned(tmp_path, own + "entities: reference\n")
    (diagnostic,) = caught.value.diagnostics
    assert "two subscriptions of /clock differ in type or QoS" in without_id(diagnostic.headline())
    assert "microros.yaml:9:" in without_id(diagnostic.headline())
    assert "microros.yaml:3:" in without_id(diagnostic.headline())


def test_a_rule_of_the_first_node_moves_it(tmp_path: Path) -> None:
    """The source says /clock, the wire has another name, as with a remapping rule of ROS 2."""
    text = NODES.replace("name: first", "name: first\n    remap: {/clock: /sim/clock}")
    result = planned(tmp_path, text)
    clock = result.project.runtime.entities.subscriptions.declared[0]
    assert (clock.declared_as, clock.topic, clock.dds_topic) == ("/clock", "/sim/clock", "rt/sim/clock")
    for wrong, expected in (
        (text.replace("clock: ros\n", ""), "first does not subscribe to /clock. Select it with `clock: ros`"),
        (
            NODES.replace("name: second", "name: second\n    remap: {/clock: /sim/clock}"),
            "second does not subscribe to /clock. Give the rule to the first node",
        ),
    ):
        with pytest.raises(UserError, match=expected):
            planned(tmp_path, wrong)
