# SPDX-License-Identifier: Apache-2.0
"""What hints of diagnostics on parameters, logging, graph and limits say, done as it stands: no diagnostic is left."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned

BARE = "version: 1\nprofiles: [pure_sender]\n"
NODE = f"{BARE}nodes: [{{name: device}}]\n"
PARAMETERS = (
    "components: [+parameters]\n"
    "nodes: [{name: device, parameters: [{name: a, type: bool}, {name: b, type: bool}]}]\n"
)
TEXT = "components: [+parameters]\nnodes: [{name: device, parameters: [{name: a, type: string, default: long}]}]\n"
SENDER = f"{BARE}nodes: [{{name: device, publishers: [{{topic: t, type: sensor_msgs/msg/JointState}}]}}]\n"
JOINTS = "limits: {sensor_msgs/msg/JointState: {name: {sequence: 2, string: 8}, %s: %s}}\n"
VALUE = "limits: {rcl_interfaces/msg/ParameterValue: {string_value: {string: %d}}}\n"

# Id → the application file, what its hint says, and the file in which that is done; files of targets are next to it.
CASES: dict[str, tuple[str, str, str]] = {
    "MG-3098": (BARE + TEXT + VALUE % 2, "`" + VALUE.strip() % 4 + "`", BARE + TEXT + VALUE % 4),
    "MG-5003": (
        SENDER + JOINTS % ("position", "{x: 3}"),
        "Remove it",
        SENDER + JOINTS % ("position", "3"),
    ),
    "MG-5004": (SENDER + JOINTS % ("velocities", "3"), "'velocity'", SENDER + JOINTS % ("velocity", "3")),
    "MG-5006": (
        SENDER + "limits: {sensor_msgs/msg/JointState: {name: 3}}\n",
        "`{sequence: 3}`",
        SENDER + "limits: {sensor_msgs/msg/JointState: {name: {sequence: 3}}}\n",
    ),
    "MG-5007": (
        SENDER + JOINTS % ("position", "{sequence: 2, string: 3}"),
        "Remove 'string'",
        SENDER + JOINTS % ("position", "{sequence: 2}"),
    ),
    "MG-5009": (
        SENDER + "limits: {sensor_msgs/msg/JointState: {header: {stamp: 3}}}\n",
        "Remove it",
        SENDER,
    ),
    "MG-7033": (
        NODE + "logging: rosout\nendpoints: {/rosout: {limits: {msg: 9, string: 8}}}\n",
        "`limits: {rcl_interfaces/msg/Log: {string: 8, msg: 9}}`",
        NODE + "logging: rosout\nlimits: {rcl_interfaces/msg/Log: {string: 8, msg: 9}}\n",
    ),
    "MG-7040": (
        BARE + "logging: console\ntarget: ./none.yaml\n",
        "`logging: callback`",
        BARE + "logging: callback\ntarget: ./none.yaml\n",
    ),
    "MG-7041": (
        NODE + "logging: [{to: rosout, size: 100}]\n",
        "`size: 290`",
        NODE + "logging: [{to: rosout, size: 290}]\n",
    ),
    "MG-7042": (
        NODE + "logging: [{to: ring, size: 100}]\n",
        "`size: 1024`",
        NODE + "logging: [{to: ring, size: 1024}]\n",
    ),
    "MG-7045": (
        BARE + "logging: [{to: console, size: 512}]\ntarget: ./mine.yaml\n",
        "Remove it",
        BARE + "logging: [{to: console}]\ntarget: ./mine.yaml\n",
    ),
    "MG-7046": (
        BARE + "logging: [{to: console, size: 100}]\ntarget: ./sends.yaml\n",
        "`size: 192`",
        BARE + "logging: [{to: console, size: 192}]\ntarget: ./sends.yaml\n",
    ),
    "MG-7047": (
        BARE + "components: [+graph_topic]\n",
        "`nodes: [{name: device}]`",
        NODE + "components: [+graph_topic]\n",
    ),
    "MG-7048": (
        NODE + "components: [+graph_topic]\nentities: preconfigured\n",
        "`entities: binary`",
        NODE + "components: [+graph_topic]\nentities: binary\n",
    ),
    "MG-7049": (
        BARE + PARAMETERS + "pools: {parameters: 1}\n",
        "parameters: 2",
        BARE + PARAMETERS + "pools: {parameters: 2}\n",
    ),
    "MG-7050": (
        BARE + PARAMETERS + "pools: {handles: 1}\n",
        "handles: 6",
        BARE + PARAMETERS + "pools: {handles: 6}\n",
    ),
    "MG-7090": (
        NODE + "components: [+parameter_client]\n",
        "`parameter_clients: [{node: /motor}]`",
        BARE
        + "nodes: [{name: device, parameter_clients: [{node: /motor}]}]\ncomponents: [+parameter_client]\n",
    ),
    "MG-7161": (
        NODE + "components: [+graph_topic, +graph_events]\n",
        "Remove 'graph_topic'",
        NODE + "components: [+graph_events]\n",
    ),
}
TARGETS = {
    "none": "stdio: {to: none}\n",
    "mine": "stdio: {to: application}\n",
    "sends": "provides: [console_send]\n",
}


def reported(folder: Path, text: str) -> dict[str, str]:
    """Return the hints of an application file by the ids of its diagnostics."""
    for name, keys in TARGETS.items():
        (folder / f"{name}.yaml").write_text(f"target: {name}\nextends: qemu-mps2-an386\n{keys}")
    try:
        found = planned(folder, text).warnings
    except UserError as refused:
        found = tuple(refused.diagnostics)
    return {diagnostic.id or "": diagnostic.hint or "" for diagnostic in found}


@pytest.mark.parametrize("number", CASES)
def test_the_diagnostic_is_gone_when_the_hint_is_followed(tmp_path: Path, number: str) -> None:
    text, words, followed = CASES[number]
    before = reported(tmp_path, text)
    assert words in before.get(number, ""), before
    after = reported(tmp_path, followed)
    assert number not in after
    assert {*after} <= {*before}, "the hint makes no other mistake"
