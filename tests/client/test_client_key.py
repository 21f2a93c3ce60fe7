# SPDX-License-Identifier: Apache-2.0
"""The client key: by default one that no other board or program has, fixed where something needs that."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen.cli.generate import plan
from microros_gen.compiler.options import SelectionOptions
from microros_gen.compiler.pipeline import Planned, render_request
from microros_gen.interfaces.find import shipped_folder

NODES = """\
version: 1
profiles: [pure_sender]
nodes: [{name: imu, publishers: [{topic: data, type: std_msgs/msg/Int32}]}]
"""


def planned(folder: Path, text: str) -> Planned:
    config = folder / "microros.yaml"
    config.write_text(NODES + text, encoding="utf-8")
    result, _ = plan(SelectionOptions(config, (), (), (shipped_folder(),), None, None), folder / "out")
    return result


@pytest.mark.parametrize(
    ("text", "device"),
    [
        ("", True),
        ("target: {name: qemu-microbit}\ntransport: {type: serial}\n", True),
        ("session: {key: device}\n", True),
        ("session: {key: 0xA1B2C3D4}\n", False),
        ("entities: preconfigured\n", False),
        ("target: {name: cortex-m4}\ntransport: {type: serial}\n", False),
    ],
    ids=["host", "unique id", "device", "named", "preconfigured", "no unique id"],
)
def test_who_supplies_the_key(tmp_path: Path, text: str, device: bool) -> None:
    config = render_request(planned(tmp_path, text))["include/microros_config.h"].decode()
    (key,) = re.findall(r"#define MICROROS_CLIENT_KEY (.*)", config)
    assert (key == "port_unique_id()") == device
    assert device or re.fullmatch("0x[0-9a-f]{8}u", key)


def test_a_target_without_a_unique_id_is_told_with_the_key_to_write(tmp_path: Path) -> None:
    board = "target: {name: cortex-m4}\ntransport: {type: serial}\n"
    said = planned(tmp_path, board).warnings
    assert "the target cortex-m4 names no unique id" in said
    (key,) = re.findall(r"`(session: \{key: 0x[0-9A-F]{8}\})`", said)
    assert "unique id" not in planned(tmp_path, f"{board}{key}\n").warnings
    assert "unique id" not in planned(tmp_path, board + "entities: preconfigured\n").warnings
    assert "unique id" not in planned(tmp_path, "").warnings
