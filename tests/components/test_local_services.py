# SPDX-License-Identifier: Apache-2.0
"""Services inside one image: which ends agree, and how requests and replies find each other without an agent."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen.components.local_delivery.plan import LocalPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import SANITIZE, UNITS, planned, rendered, run
from tests.support.ids import without_id
from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, link

HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services, +executor]
limits: {"*": {string: 20, sequence: 2}}
"""
SUM = "type: example_interfaces/srv/AddTwoInts"
ALONE = f"""\
nodes:
  - name: device
    services:
      - {{name: sum, {SUM}, local: only, queue: 2}}
      - {{name: trigger, type: std_srvs/srv/Trigger, local: only}}
    clients: [{{name: trigger, type: std_srvs/srv/Trigger, local: only}}]
  - name: other
    clients: [{{name: /sum, {SUM}, local: only}}]
"""
NODES = f"""\
nodes:
  - name: sensor
    publishers: [{{topic: /count, type: std_msgs/msg/Int32, local: only}}]
    clients: [{{name: /sum, {SUM}, local: only}}]
  - name: filter
    subscriptions: [{{topic: /count, type: std_msgs/msg/Int32, local: only}}]
    services: [{{name: /sum, {SUM}, local: only}}]
"""
THREAD_SANITIZER = ("-std=gnu99", "-g", "-O0", "-fsanitize=thread", f"-I{UNITS}")


def local(folder: Path, text: str) -> LocalPlan:
    part = planned(folder, text).project.runtime.features.of("local_delivery")
    assert isinstance(part, LocalPlan)
    return part


def program(out: Path, units: list[str], flags: tuple[str, ...]) -> Path:
    sources = sorted((out / "src").rglob("*.c"))
    if "port_agent.c" in units:
        sources = [path for path in sources if not path.parent.name.startswith("port_posix")]
    objects = compile_merged(Tree(out, ()), sources, [UNITS / unit for unit in units], SANITIZER, flags)
    return link(objects, SANITIZER, flags, out / "unit")


def test_its_queues_and_servers(tmp_path: Path) -> None:
    part = local(tmp_path, HEAD + ALONE)
    assert [(q.kind, q.topic, q.slots, str(q.type)) for q in part.queues] == [
        ("service", "/sum", 2, "example_interfaces/srv/AddTwoInts_Request"),
        ("service", "/trigger", 4, "std_srvs/srv/Trigger_Request"),
        ("client", "/trigger", 4, "std_srvs/srv/Trigger_Response"),
        ("client", "/sum", 4, "example_interfaces/srv/AddTwoInts_Response"),
    ]
    assert part.server_of == ("1", "0", "RMW_LOCAL_NONE")
    assert part.services
    assert part.shown == "/sum (only), /trigger (only); no agent is needed"


@pytest.mark.parametrize(
    ("server", "client", "words"),
    [
        (
            "local: only",
            "queue: 2",
            "microros.yaml:8:16: error: the client of '/a' is not local, the service in",
        ),
        ("queue: 2", "local: only", "the service of '/a' is not local, the client in line 8 is"),
        ("local: also", "local: also", "a client calls one server: '/a' is served in the image"),
        ("local: only, limits: {message: 4}", "local: only", "the limits of '/a' differ"),
    ],
)
def test_ends_that_do_not_agree(tmp_path: Path, server: str, client: str, words: str) -> None:
    text = f"""\
{HEAD}nodes:
  - name: device
    services: [ {{name: a, type: std_srvs/srv/Trigger, {server}}}]
    clients: [ {{name: a, type: std_srvs/srv/Trigger, {client}}}]
"""
    with pytest.raises(UserError) as caught:
        planned(tmp_path, text)
    assert words in without_id(str(caught.value))


@pytest.mark.parametrize(("kind", "missing"), [("services", "calls"), ("clients", "serves")])
def test_one_end_alone(tmp_path: Path, kind: str, missing: str) -> None:
    text = f"{HEAD}nodes: [{{name: device, {kind}: [{{name: a, {SUM}, local: only}}]}}]\n"
    with pytest.raises(UserError, match=f"nothing in the image {missing} '/a'"):
        planned(tmp_path, text)


def test_two_servers(tmp_path: Path) -> None:
    text = HEAD + ALONE.replace(
        "clients: [{name: /sum", f"services: [{{name: /sum, {SUM}, local: only}}]\n    clients: [{{name: /sum"
    )
    with pytest.raises(UserError, match="a local service has one server: '/sum' has another one"):
        planned(tmp_path, text)


def test_preconfigured_entities_exist_at_the_agent(tmp_path: Path) -> None:
    text = f"{HEAD}entities: preconfigured\nsession: {{key: 7}}\n{ALONE}"
    with pytest.raises(UserError, match="'entities: preconfigured' creates the service of '/sum'"):
        planned(tmp_path, text)


def test_its_behavior(tmp_path: Path) -> None:
    run(program(rendered(tmp_path, HEAD + ALONE), ["unit_local_services.c"], SANITIZE))


@pytest.mark.system
def test_whether_a_server_is_available(tmp_path: Path) -> None:
    """Local matching knows it without the graph."""
    nodes = "nodes:\n  - name: device\n    services: [SUM]\n    clients: [SUM]\n"
    text = HEAD.replace("+executor", "+executor, +graph") + nodes.replace(
        "SUM", f"{{name: sum, {SUM}, local: only}}"
    )
    run(program(rendered(tmp_path, text), ["unit_local_server.c", "port_agent.c"], SANITIZE))


def test_two_nodes_on_two_executors_in_two_tasks(tmp_path: Path) -> None:
    """Each node has an executor in a task: messages go one way, requests back, and nothing races."""
    text = HEAD.replace("+executor", "+executor, +multithread") + "pools: {executors: 2}\n" + NODES
    done = subprocess.run(
        [program(rendered(tmp_path, text), ["local_nodes.c"], THREAD_SANITIZER)],
        capture_output=True,
        text=True,
        timeout=seconds(60),
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
