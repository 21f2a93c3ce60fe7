# SPDX-License-Identifier: Apache-2.0
"""The files of a system of two boards, `sensor` and `motor`, and the plan of one of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.peer.plan import PeerPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.ids import without_id

SYSTEM = """\
version: 1
boards:
  sensor: {application: sensor/microros.yaml}
  motor: {application: motor/microros.yaml}
links:
  - {type: udp, ends: {sensor: "10.0.0.1:7500", motor: "10.0.0.2:7500"}}
"""
HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
limits: {"*": {string: 20, sequence: 2}}
"""


def application(board: str, ends: str, more: str = "") -> str:
    return f"{HEAD}{more}system: {{file: ../system.yaml, board: {board}}}\nnodes:\n  - name: {board}\n{ends}"


def ends(kind: str, *declared: str) -> str:
    lines = "".join(f"      - {{type: std_msgs/msg/String, {each}}}\n" for each in declared)
    return f"    {kind}:\n{lines}"


SENSOR = application("sensor", ends("publishers", "topic: /a, peer: only"))
MOTOR = application("motor", ends("subscriptions", "topic: /a, peer: only"))


def written(folder: Path, system: str = SYSTEM, sensor: str = SENSOR, motor: str = MOTOR) -> Path:
    (folder / "system.yaml").write_text(system)
    for board, text in (("sensor", sensor), ("motor", motor)):
        (folder / board).mkdir(exist_ok=True)
        (folder / board / "microros.yaml").write_text(text)
    return folder


def planned(folder: Path, board: str = "sensor", target: str | None = None) -> compiler.Planned:
    options = compiler.Options(
        config=folder / board / "microros.yaml", interface_paths=(shipped_folder(),), target=target
    )
    return compiler.plan(compiler.resolve(compiler.read(options)))


def peers(folder: Path, board: str) -> PeerPlan:
    part = planned(folder, board).project.runtime.features.of("peer")
    assert isinstance(part, PeerPlan)
    return part


def refused(folder: Path, board: str = "sensor", target: str | None = None) -> str:
    with pytest.raises(UserError) as caught:
        planned(folder, board, target)
    return without_id(str(caught.value)).replace(f"{folder}/", "")
