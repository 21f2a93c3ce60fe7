# SPDX-License-Identifier: Apache-2.0
"""Decoding without a copy, as a C unit under sanitizers; which subscriptions the plan allows it for."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZE, SANITIZER, Tree, build
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+loaned_messages{more}]
nodes:
  - name: screen
    subscriptions:
      - {{topic: image, type: sensor_msgs/msg/Image, qos: {{reliability: best_effort}}, {queue}}}
      - {{topic: scan, type: sensor_msgs/msg/LaserScan}}
      - {{topic: number, type: std_msgs/msg/Int32}}
      - {{topic: joints, type: sensor_msgs/msg/JointState}}
      - {{topic: cloud, type: sensor_msgs/msg/PointCloud2}}
limits: {{"*": {{string: 12, sequence: 300}}, sensor_msgs/msg/PointCloud2: {{fields: 4}}}}
"""


def write(folder: Path, more: str = "", queue: str = "queue: 1") -> Tree:
    return write_application(folder / "tree", APPLICATION.format(more=more, queue=queue))


def loans(tree: Tree) -> list[int]:
    """Return the subscriptions whose samples can be used in place."""
    (source,) = (path for path in tree.sources if path.name == "rmw_loans.c")
    return [int(number) for number in re.findall(r"\{&loan_(\d+),", source.read_text(encoding="utf-8"))]


def test_unit(tmp_path: Path) -> None:
    program = build(write(tmp_path), ["unit_loan.c"], "unit", SANITIZER, SANITIZE)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("more", "queue", "expected"),
    [
        ("", "queue: 1", [0, 1]),
        (", +sleep_cycles", "queue: 1", []),
        ("", "queue: 8, queue_bytes: 900", []),
    ],
    ids=["slots", "sleep", "queue_bytes"],
)
def test_what_the_plan_allows(more: str, queue: str, expected: list[int], tmp_path: Path) -> None:
    """Strings and numbers stay in the queue; texts or messages in sequences need memory, fixed messages save none."""
    assert loans(write(tmp_path, more, queue)) == expected


@pytest.mark.parametrize("component", ["+loaned_messages", ""], ids=["loans", "none"])
def test_no_loan_is_in_the_input_buffer(component: str, tmp_path: Path) -> None:
    """The next message would overwrite it. Without the component a sample may wait there, and nothing is declared."""
    alone = APPLICATION.format(more="", queue="queue: 1").replace("+loaned_messages", component)
    lines = [line for line in alone.splitlines() if "LaserScan" not in line and "joints" not in line]
    text = "\n".join(line for line in lines if "cloud" not in line and "limits" not in line)
    tree = write_application(tmp_path / "tree", text + '\nlimits: {"*": {string: 12, sequence: 900}}\n')
    config = (tree.include / "microros_config.h").read_text(encoding="utf-8")
    assert ("MICROROS_INPUT_READER" in config) == (not component)
    header = (tree.include / "rcl" / "subscription.h").read_text(encoding="utf-8")
    assert ("subscription_loan.h" in header) == bool(component)
