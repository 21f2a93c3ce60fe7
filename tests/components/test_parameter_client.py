# SPDX-License-Identifier: Apache-2.0
"""The plan of clients of parameters: endpoints, limits together with those of a server, and what is not selected."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import pytest

from microros_gen import compiler
from microros_gen.components.parameter_client.plan import ParameterClientPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.types import TypeName
from microros_gen.ros.codec import ENCAPSULATION_BYTES
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.ids import without_id
from tests.support.runtime.parameter_agent import parameter_codec

HEAD = "version: 1\nprofiles: [pure_sender]\ncomponents: [+parameter_client, +subscribe, +parameters]\n"
NODES = """\
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameters: [{name: label, type: string, size: 80}]
    parameter_clients: [{node: /motor, operations: [get, watch], parameters: 9, string: 20}]
  - name: second
    publishers: [{topic: more, type: std_msgs/msg/Int32}]
    parameter_clients: [{node: /motor, operations: [set]}]
"""


def planned(folder: Path, text: str) -> compiler.Planned:
    (folder / "microros.yaml").write_text(text)
    options = compiler.Options(config=folder / "microros.yaml", interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def type_of(plan: compiler.Planned, kind: str, name: str) -> TypePlan:
    wanted = TypeName("rcl_interfaces", kind, name)
    return next(entry for entry in plan.project.types if entry.name == wanted)


def test_endpoints_and_one_handle_for_each_client(tmp_path: Path) -> None:
    runtime = planned(tmp_path, HEAD + NODES).project.runtime
    clients = [(client.node, client.name) for client in runtime.entities.clients.declared]
    assert clients == [(0, "/motor/get_parameters"), (1, "/motor/set_parameters")]
    assert [s.topic for s in runtime.entities.subscriptions.declared] == ["/parameter_events"]
    servers = 2 * 6
    assert runtime.executor.handles_max == servers + len(clients)


def test_limits_are_the_larger_of_client_and_server(tmp_path: Path) -> None:
    planned_ = planned(tmp_path, HEAD + NODES)
    part = planned_.project.runtime.features.of("parameter_client")
    assert isinstance(part, ParameterClientPlan)
    assert (part.parameters, part.string_size) == (9, 50)
    value = type_of(planned_, "msg", "ParameterValue")
    assert value.limits is not None
    strings = [f.string for f in value.limits.fields if f is not None and f.string]
    assert max(strings) == 80, "the server's"
    assert part.message_size >= type_of(planned_, "srv", "GetParameters_Response").max_encoded_size


SIZED = """\
version: 1
profiles: [pure_sender]
components: [+parameter_client]
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameter_clients: [{node: /motor, operations: [get], parameters: 3, CLIENT}]
"""
FULL: dict[str, tuple[int, dict[str, Any]]] = {
    "string": (4, {"string_value": "x" * 20}),
    "byte[]": (5, {"byte_array_value": bytes(7)}),
    "bool[]": (6, {"bool_array_value": [True] * 7}),
    "integer[]": (7, {"integer_array_value": [1] * 7}),
    "double[]": (8, {"double_array_value": [0.5] * 7}),
    "string[]": (9, {"string_array_value": ["x" * 20] * 7}),
}
"""By type: a value that is as large as the application allows."""


def message_size(folder: Path, client: str) -> int:
    part = planned(folder, SIZED.replace("CLIENT", client)).project.runtime.features.of("parameter_client")
    assert isinstance(part, ParameterClientPlan)
    return part.message_size


def response_size(*kinds: str) -> int:
    """Return the bytes of a response with values of these types, as the codec of the ROS side writes it."""
    values = [{"type": FULL[kind][0], **FULL[kind][1]} for kind in kinds]
    body = parameter_codec().encode("rcl_interfaces/srv/GetParameters_Response", {"values": values})
    return len(body) - ENCAPSULATION_BYTES


@pytest.mark.parametrize("kind", [kind for kind in FULL if kind != "string"])
def test_memory_is_that_of_the_types_that_are_declared(kind: str, tmp_path: Path) -> None:
    """Of the members of a value one has content: no response with the declared types is larger, one is as large."""
    types = {"string", kind} if kind == "string[]" else {"string", "byte[]", kind}
    size = message_size(
        tmp_path, f"string: 20, types: [{', '.join(repr(t) for t in sorted(types))}], elements: 7"
    )
    responses = [response_size(*chosen) for chosen in product(types, repeat=3)]
    assert max(responses) == size
    every = message_size(tmp_path, "string: 20, elements: 7")
    assert (size < every) == (kind != "string[]")
    assert every == response_size(*["string[]"] * 3)


def test_own_limits_win(tmp_path: Path) -> None:
    own = "limits: {rcl_interfaces/srv/GetParameters_Response: {values: 2}}\n"
    larger, smaller = (planned(tmp_path, text + NODES) for text in (HEAD, HEAD + own))
    sizes = [type_of(p, "srv", "GetParameters_Response").max_encoded_size for p in (larger, smaller)]
    assert sizes[1] < sizes[0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("+parameter_client, ", ""), "a client of parameters needs the component 'parameter_client'"),
        (("+subscribe, ", ""), "a client that watches parameters needs the component 'subscribe'"),
        (("parameter_clients:", "# "), "no client: no node declares another one"),
    ],
)
def test_what_is_missing_is_reported(change: tuple[str, str], message: str, tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, (HEAD + NODES).replace(*change))
    found = [without_id(d.headline()) for d in caught.value.diagnostics]
    assert any(message in text for text in found), found
    assert all(d.span is not None for d in caught.value.diagnostics)


def test_only_what_is_declared_is_there(tmp_path: Path) -> None:
    """A client that gets alone has no file of the other operations, and opens no subscription."""
    text = "version: 1\nprofiles: [pure_sender]\ncomponents: [+parameter_client]\nnodes:\n  - name: device\n"
    text += "    publishers: [{topic: count, type: std_msgs/msg/Int32}]\n"
    plan = planned(tmp_path, f"{text}    parameter_clients: [{{node: /motor, operations: [get]}}]\n")
    files = {Path(name).name for name in compiler.render(plan)}
    assert "rclc_parameter_client_get.c" in files
    others = ("set", "atomic", "outcome", "list", "describe", "get_types", "watch")
    assert not files & {f"rclc_parameter_client_{part}.c" for part in others}
    assert plan.project.runtime.entities.subscriptions.declared == ()


def test_descriptors_have_their_own_size(tmp_path: Path) -> None:
    text = "version: 1\nprofiles: [pure_sender]\ncomponents: [+parameter_client]\nnodes:\n  - name: device\n"
    text += "    parameter_clients: [{node: /motor, operations: [describe, get_types], description: 30}]\n"
    plan = planned(tmp_path, f"{text}    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]\n")
    files = {Path(name).name for name in compiler.render(plan)}
    parts = ("describe", "get_types", "named")
    assert files >= {f"rclc_parameter_client_{part}.c" for part in parts}
    assert "rclc_parameter_client_get.c" not in files
    full: dict[str, Any] = {"name": "n" * 49, "description": "d" * 30, "additional_constraints": "c" * 30}
    full |= {
        f"{kind}_range": [{"from_value": 0, "to_value": 1, "step": 1}]
        for kind in ("integer", "floating_point")
    }
    body = parameter_codec().encode(
        "rcl_interfaces/srv/DescribeParameters_Response", {"descriptors": [full] * 4}
    )
    part = plan.project.runtime.features.of("parameter_client")
    assert isinstance(part, ParameterClientPlan)
    assert part.message_size == len(body) - ENCAPSULATION_BYTES
