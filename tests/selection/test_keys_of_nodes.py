# SPDX-License-Identifier: Apache-2.0
"""Each key of an application file that a component is for selects it, or the diagnostic has the line to be added."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import microros_gen.application
from microros_gen import compiler
from microros_gen.diagnostics import UserError

NEEDING = {
    "publishers": ("publishers: [{topic: t, type: std_msgs/msg/Int32}]", "publish"),
    "subscriptions": ("subscriptions: [{topic: t, type: std_msgs/msg/Int32}]", "subscribe"),
    "services": ("services: [{name: s, type: std_srvs/srv/Empty}]", "services"),
    "clients": ("clients: [{name: c, type: std_srvs/srv/Empty}]", "services"),
    "timers": ("timers: [{name: t, period: 1 s}]", "timers"),
    "parameters": ("parameters: [{name: p, type: integer}]", "parameters"),
    "parameter_clients": ("parameter_clients: [{node: /b, operations: [get]}]", "parameter_client"),
    "actions": ("actions: [{name: a, type: example_interfaces/action/Fibonacci}]", "action_server"),
    "action_clients": (
        "action_clients: [{name: a, type: example_interfaces/action/Fibonacci}]",
        "action_client",
    ),
    "executors": ("executors: [{name: e}]", "executor"),
    "managed": ("timers: [{name: t, period: 1 s, managed: true}]", "lifecycle"),
}
"""Key → a node with it, and the component that it needs."""
SELECTING = {
    "nodes: [{name: a, parameters: [{name: p, type: integer}], modes: {FAST: {p: 3}}}]": "node_modes",
    "nodes: [{name: a, parameters: {at: agent, declare: [{name: p, type: integer}]}}]": "parameters_held",
    "nodes: [{name: a}]\nlogging: rosout": "logging_rosout",
    "clock: ros": "clock_ros",
    "session: {hard_liveliness: 3 s}": "liveliness_hard",
    "transport: {type: tcp}": "transport_tcp",
    "entities: xml": "entities_xml",
}
WITHOUT_COMPONENT = {"name", "namespace", "domain_id", "remap", "modes"}
"""Keys that every node can have, and the one that selects its component."""


def reported(tmp_path: Path, text: str) -> str:
    config = tmp_path / "microros.yaml"
    config.write_text(f"components: [+node]\n{text}\n", encoding="utf-8")
    with pytest.raises(UserError) as raised:
        compiler.generate(compiler.Options(config=config), tmp_path / "out")
    return "\n".join(d.render() for d in raised.value.diagnostics)


def test_no_key_of_a_node_is_forgotten() -> None:
    schema = Path(microros_gen.application.__file__).parent / "application.schema.json"
    node = json.loads(schema.read_text(encoding="utf-8"))["$defs"]["node"]
    assert set(node["properties"]) == (NEEDING.keys() - {"managed"}) | WITHOUT_COMPONENT


@pytest.mark.parametrize("key", sorted(NEEDING))
def test_a_key_without_its_component_says_which_line_to_add(key: str, tmp_path: Path) -> None:
    text, component = NEEDING[key]
    assert f"Add `components: [+{component}]`" in reported(tmp_path, f"nodes: [{{name: a, {text}}}]")


@pytest.mark.parametrize("text", sorted(SELECTING))
def test_a_key_selects_its_component(text: str, tmp_path: Path) -> None:
    config = tmp_path / "microros.yaml"
    config.write_text(f"profiles: [pure_sender]\n{text}\n", encoding="utf-8")
    resolution = compiler.resolve(compiler.read(compiler.Options(config=config)))
    assert SELECTING[text] in {chosen.component.name for chosen in resolution.selection.components}


def test_settings_of_an_endpoint_name_the_component_that_opens_it(tmp_path: Path) -> None:
    assert (
        "no selected component opens an endpoint '/rosout'. Add `components: [+logging_rosout]`"
        in reported(tmp_path, "endpoints: {/rosout: {depth: 3}}")
    )
