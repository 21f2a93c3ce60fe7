# SPDX-License-Identifier: Apache-2.0
"""The plan of clients of parameters: endpoints, limits together with those of a server, and what is not selected."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.parameter_client.plan import ParameterClientPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.types import TypeName
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.ids import without_id

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
    others = ("set", "atomic", "outcome", "list", "watch")
    assert not files & {f"rclc_parameter_client_{part}.c" for part in others}
    assert plan.project.runtime.entities.subscriptions.declared == ()
