# SPDX-License-Identifier: Apache-2.0
"""The largest samples of types, from the queues of an output."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import cast

from microros_gen.image.folder import Folder
from microros_gen.image.samples import Samples

ROWS = [
    {"type": "tf2_msgs/msg/TFMessage", "slot_size": 968},
    {"type": "tf2_msgs/msg/TFMessage", "slot_size": 300},
    {"type": "std_msgs/msg/Int32", "slot_size": 4},
]
QUEUES = """\
const xrce_queue_t xrce_queues[XRCE_RECEIVERS] = {
  {0, 968, 0, 4},
  {3872, 300, 4, 4},
  {5072, 4, 8, 1},
};
"""


def samples(path: Path, queues: str) -> Samples:
    plan = path / "src" / "read" / "xrce_read_plan.c"
    plan.parent.mkdir(parents=True)
    plan.write_text(queues)
    services = [{"type": "std_srvs/srv/SetBool", "slot_size": 40}] if "{6000" in queues else []
    manifest = {
        "entities": {"subscriptions": ROWS, "services": services, "publishers": [{"type": "a/msg/B"}]}
    }
    return Samples(cast(Folder, SimpleNamespace(path=path, manifest=manifest)))


def test_a_decoder_gets_the_largest_sample_of_its_type(tmp_path: Path) -> None:
    found = samples(tmp_path, QUEUES.replace("};", "  {6000, 40, 9, 2},\n};"))
    assert found.size("tf2_msgs__msg__TFMessage__decode") == 968
    assert found.size("std_msgs__msg__Int32__decode") == 4
    assert found.size("std_srvs__srv__SetBool_Request__decode") == 40
    assert found.size("geometry_msgs__msg__TransformStamped__decode") == 968, "of the types with an endpoint"
    assert found.size("rclc_action_decode") is None


def test_a_place_for_any_type_leaves_the_sizes_unknown(tmp_path: Path) -> None:
    found = samples(tmp_path, QUEUES.replace("};", "  {5100, 40, 9, 2},\n};"))
    assert found.size("std_msgs__msg__Int32__decode") is None
