# SPDX-License-Identifier: Apache-2.0
"""A changed limit reaches few objects: the sizes that follow from it are seen by the sources that use them."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.toolchain.contents import Contents

pytestmark = pytest.mark.builds

LIMITED = """\
version: 1
profiles: [pure_sender]
interfaces: [sensor_msgs/msg/Imu]
limits: {{'*': {{string: {limit}}}}}
"""
OF_THE_PLAN_ID = {"src/node/rclc_node.c", "src/support/rcl_init.c", "src/support/rclc_init.c"}
"""They contain or see a function whose name has the plan id."""
OF_THE_STREAMS = {
    "src/session/xrce_routes.c",
    "src/stream_best_effort/xrce_stream_best_effort.c",
    "src/stream_reliable/xrce_stream_reliable.c",
}
OF_THE_TYPES = {
    "src/memory/message_pools.c",
    "src/sensor_msgs/imu__storage.c",
    "src/sensor_msgs/imu__type_support.c",
    "src/std_msgs/header__storage.c",
}


def test_a_changed_limit_leaves_most_objects_as_they_are(tmp_path: Path) -> None:
    before, after = (digests(tmp_path / str(limit), limit) for limit in (24, 32))
    assert len(after) > 70
    assert before.keys() == after.keys()
    changed = {source for source, digest in after.items() if digest != before[source]}
    assert changed == OF_THE_PLAN_ID | OF_THE_STREAMS | OF_THE_TYPES


def digests(folder: Path, limit: int) -> Mapping[str, str]:
    """Return source → digest of what its object is made from, as a build decides whether it is up to date."""
    folder.mkdir()
    config = folder / "microros.yaml"
    config.write_text(LIMITED.format(limit=limit), encoding="utf-8")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    out = compiler.generate(options, folder / "out").out
    sources = (out / "sources.txt").read_text(encoding="utf-8").split()
    command = ["gcc", "-std=c99", "-Iinclude", "-MM", *sources]
    rules = subprocess.run(command, cwd=out, capture_output=True, text=True, check=True).stdout
    contents = Contents(out)
    lists = [rule.split(": ", 1)[1].split() for rule in rules.replace("\\\n", "").splitlines()]
    return {files[0]: contents.of_files(files) for files in lists}
