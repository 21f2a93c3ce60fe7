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
from tests.support.changed_limits import CHANGES
from tests.support.slices import only

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
OF_THE_HISTORY = {"src/publish/error_text_full.c", "src/stream_reliable/xrce_stream_reliable.c"}
"""What says that the stream is full names its slots."""

MOST = {
    "string": 6,
    "history": 5,
    "slot_size": 8,
    "mtu": 4,
    "arena": 4,
    "publishers": 32,
    "string of a receiver": 21,
    "queue": 12,
}
"""Objects that a change may reach. What changes the size of tables of entities changes the client itself, which about
half of the sources see."""


def test_a_changed_limit_leaves_most_objects_as_they_are(tmp_path: Path) -> None:
    changed = of_a_change(LIMITED.format(limit=24), LIMITED.format(limit=32), tmp_path)
    assert changed == OF_THE_PLAN_ID | OF_THE_STREAMS | OF_THE_TYPES


def test_a_changed_history_reaches_the_stream_alone(tmp_path: Path) -> None:
    change = CHANGES["history"]
    changed = of_a_change(change.before, change.after, tmp_path)
    assert changed == OF_THE_PLAN_ID | OF_THE_HISTORY


@pytest.mark.parametrize("what", only({"string of a receiver", "publishers"}, CHANGES))
def test_no_change_reaches_more_objects_than_before(what: str, tmp_path: Path) -> None:
    change = CHANGES[what]
    changed = of_a_change(change.before, change.after, tmp_path)
    assert changed, "the change has to have an effect"
    assert len(changed) <= MOST[what], sorted(changed)


def of_a_change(before: str, after: str, folder: Path) -> set[str]:
    """Return the sources whose objects a build has to make again."""
    old, new = digests(folder / "before", before), digests(folder / "after", after)
    assert len(new) > 50
    assert old.keys() == new.keys()
    return {source for source, digest in new.items() if digest != old[source]}


def digests(folder: Path, application: str) -> Mapping[str, str]:
    """Return source → digest of what its object is made from, as a build decides whether it is up to date."""
    folder.mkdir()
    config = folder / "microros.yaml"
    config.write_text(application, encoding="utf-8")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    out = compiler.generate(options, folder / "out").out
    sources = (out / "sources.txt").read_text(encoding="utf-8").split()
    command = ["gcc", "-std=c99", "-Iinclude", "-MM", *sources]
    rules = subprocess.run(command, cwd=out, capture_output=True, text=True, check=True).stdout
    contents = Contents(out)
    lists = [rule.split(": ", 1)[1].split() for rule in rules.replace("\\\n", "").splitlines()]
    return {files[0]: contents.of_files(files) for files in lists}
