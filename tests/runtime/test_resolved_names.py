# SPDX-License-Identifier: Apache-2.0
"""Names of a node that the application file remaps, as the C library resolves them, against rclpy's node."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.support.runtime.harness import FIXTURES, compile_merged, link
from tests.support.runtime.returns import FLAGS, FOLDER, results_of
from tests.support.runtime.surface import write_application

pytestmark = pytest.mark.ros
RULES = {"__ns": "/left", "__node": "imu2", "data": "/robot/imu", "~/state": "state", "reset": "/set"}
APPLICATION = f"""\
version: 1
profiles: [pure_sender]
components: [+services, +executor, +name_substitutions]
nodes:
  - name: imu
    namespace: /arm
    remap: {{{", ".join(f"{a}: {b}" for a, b in RULES.items())}}}
    publishers:
      - {{topic: data, type: std_msgs/msg/Bool}}
      - {{topic: ~/state, type: std_msgs/msg/Bool}}
      - {{topic: imu2/free, type: std_msgs/msg/Bool}}
    services: [{{name: reset, type: std_srvs/srv/Trigger, limits: {{message: 8}}}}]
"""
NAMES = (
    "data",
    "/left/data",
    "/arm/data",
    "~/state",
    "{node}/state",
    "{ns}/data",
    "reset",
    "other",
    "~",
    "{node}/x",
)


@contextmanager
def ros_node() -> Iterator[Any]:
    rclpy = pytest.importorskip("rclpy")
    context = rclpy.Context()
    rclpy.init(context=context)
    rules = [word for a, b in RULES.items() for word in ("-r", f"{a}:={b}")]
    node = rclpy.create_node("imu", namespace="/arm", context=context, cli_args=["--ros-args", *rules])
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)


def test_a_remapped_node_resolves_as_ros(tmp_path: Path) -> None:
    tree = write_application(tmp_path / "ours", APPLICATION)
    sources = [s for s in tree.sources if not s.parent.name.startswith("port_posix")]
    objects = compile_merged(tree, sources, [FOLDER / "resolve.c", FIXTURES / "port_agent.c"], "gcc", FLAGS)
    ours = results_of(tmp_path, link(objects, "gcc", (), tmp_path / "mine"), *NAMES)
    with ros_node() as node:
        expected = [
            (resolve(name, only_expand=bool(only)), index)
            for name in NAMES
            for index, (resolve, only) in enumerate(
                (f, only) for f in (node.resolve_topic_name, node.resolve_service_name) for only in (0, 1)
            )
        ]
        from std_msgs.msg import Bool

        for name in ("data", "~/state", "imu2/free"):
            expected.append((node.create_publisher(Bool, name, 1).topic_name, 0))
    assert ours == [*expected, ("none", 1), ("none", 1)]
