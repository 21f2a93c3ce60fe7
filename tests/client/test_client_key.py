# SPDX-License-Identifier: Apache-2.0
"""The client key: by default one that no other board or program has, fixed where something needs that."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder

NODES = """\
version: 1
profiles: [pure_sender]
nodes: [{name: imu, publishers: [{topic: data, type: std_msgs/msg/Int32}]}]
"""


def warnings(plan: compiler.Planned) -> str:
    return "\n".join(warning.render() for warning in plan.warnings)


def planned(folder: Path, text: str) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(NODES + text, encoding="utf-8")
    return compiler.plan(
        compiler.resolve(compiler.read(compiler.Options(config=config, interface_paths=(shipped_folder(),))))
    )


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
    config = compiler.render(planned(tmp_path, text))["include/microros_config.h"].decode()
    (key,) = re.findall(r"#define MICROROS_CLIENT_KEY (.*)", config)
    assert (key == "port_unique_id()") == device
    assert device or re.fullmatch("0x[0-9a-f]{8}u", key)


def test_a_target_without_a_unique_id_is_reported_with_the_key_to_write(tmp_path: Path) -> None:
    board = "target: {name: cortex-m4}\ntransport: {type: serial}\n"
    found_warnings = warnings(planned(tmp_path, board))
    assert "the target cortex-m4 has no unique id" in found_warnings
    (key,) = re.findall(r"`(session: \{key: 0x[0-9A-F]{8}\})`", found_warnings)
    assert "unique id" not in warnings(planned(tmp_path, f"{board}{key}\n"))
    assert "unique id" not in warnings(planned(tmp_path, board + "entities: preconfigured\n"))
    assert "unique id" not in warnings(planned(tmp_path, ""))
