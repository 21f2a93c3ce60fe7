# SPDX-License-Identifier: Apache-2.0
"""The manifest holds enough of each type to rebuild the description that ROS 2 installs."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from microros_gen.cli.main import cli

pytestmark = pytest.mark.ros
TYPES = (
    "sensor_msgs/msg/JointState",
    "nav_msgs/msg/Odometry",
    "std_srvs/srv/SetBool",
    "rcl_interfaces/msg/Parameter",
)


def described(manifest: dict[str, Any], name: str) -> dict[str, Any]:
    """Return type_description_interfaces/msg/TypeDescription of a type, as its .json has it."""
    types = manifest["types"]

    def one(of: str) -> dict[str, Any]:
        return {"type_name": of, "fields": types[of]["fields"]}

    return {
        "type_description": one(name),
        "referenced_type_descriptions": [one(part) for part in types[name]["parts"]],
    }


def test_descriptions_are_those_that_ros_installs(tmp_path: Path) -> None:
    config = tmp_path / "microros.yaml"
    limits = 'limits: {"*": {string: 8, sequence: 2}}'
    config.write_text(f"version: 1\nprofiles: [pure_sender]\ninterfaces: [{', '.join(TYPES)}]\n{limits}\n")
    command = ["generate", "-c", str(config), "-o", str(tmp_path / "out")]
    result = CliRunner().invoke(cli, command, catch_exceptions=False)
    assert result.exit_code == 0, result.output
    manifest = json.loads((tmp_path / "out" / "manifest.json").read_text(encoding="utf-8"))
    for name in TYPES:
        package, kind, stem = name.split("/")
        installed = json.loads((Path(sys.prefix) / "share" / package / kind / f"{stem}.json").read_text())
        hashes = {entry["type_name"]: entry["hash_string"] for entry in installed["type_hashes"]}
        for of in [n for n in manifest["types"] if n in hashes]:
            assert manifest["types"][of]["hash"] == hashes[of]
        if kind == "msg":
            assert described(manifest, name) == installed["type_description_msg"]
        else:
            found = installed["type_description_msg"]["referenced_type_descriptions"]
            for part in found:
                assert manifest["types"][part["type_name"]]["fields"] == part["fields"]
