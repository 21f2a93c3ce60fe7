# SPDX-License-Identifier: Apache-2.0
"""A component states the endpoints that it opens by itself; they are planned as those that a node declares."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

import pytest

from microros_gen import compiler
from microros_gen.compiler import pipeline
from microros_gen.components.action_client.plan import ActionClientPlan
from microros_gen.components.action_server.plan import ActionServerPlan
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.selection.component_file import parse_component
from microros_gen.selection.find_components import load_catalogue
from tests.support.ids import without_id

COMPONENT = """\
component: beat
summary: "Made up: a service in every node, and a topic once"
layer: middleware
status: ready
needs: [publish, services]
implies:
  - {publisher: /beats, type: std_msgs/msg/Int32, qos: {durability: transient_local, depth: 1}}
  - {service: "~/still_there", type: std_srvs/srv/Trigger, every_node: true, queue: 2}
"""
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+beat]
limits: {"*": {string: 20}}
"""
NODES = """\
nodes:
  - {name: one, publishers: [{topic: out, type: std_msgs/msg/String}]}
  - {name: two, namespace: /arm, services: [{name: set, type: std_srvs/srv/SetBool}]}
"""


@pytest.fixture
def made_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Add a component to those that ship."""
    return _ships(COMPONENT, tmp_path, monkeypatch)


def _ships(text: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Add the component beat to those that ship; return `folder`."""
    diagnostics = Diagnostics()
    beat = parse_component(Source("beat/component.yaml", text), diagnostics)
    diagnostics.check()
    assert beat is not None
    catalogue = MappingProxyType({**load_catalogue(), "beat": beat})
    monkeypatch.setattr(pipeline, "load_catalogue", lambda: catalogue)
    return folder


def planned(folder: Path, text: str) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(text)
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def test_they_are_planned_in_front_of_the_declared_ones(made_up: Path) -> None:
    entities = planned(made_up, APPLICATION + NODES).project.runtime.entities
    assert [p.topic for p in entities.publishers.declared] == ["/beats", "/out"]
    names = [(s.node, s.name, str(s.type)) for s in entities.services.declared]
    assert names == [
        (0, "/one/still_there", "std_srvs/srv/Trigger"),
        (1, "/arm/two/still_there", "std_srvs/srv/Trigger"),
        (1, "/arm/set", "std_srvs/srv/SetBool"),
    ]
    assert (entities.publishers.max, entities.publishers.implied) == (2, 1)
    assert (entities.services.max, entities.services.implied) == (3, 2)


def test_they_are_planned_in_front_of_what_components_plan_from_other_keys(tmp_path: Path) -> None:
    """The subscription to /clock is searched for in the first place of all subscriptions."""
    text = """\
version: 1
components: [+action_client, +clock_ros]
clock: ros
nodes:
  - name: one
    action_clients: [{name: walk, type: example_interfaces/action/Fibonacci}]
limits: {"*": {sequence: 4}}
"""
    entities = planned(tmp_path, text).project.runtime.entities
    assert [s.topic for s in entities.subscriptions.declared] == ["/clock", "/walk/_action/feedback"]


@pytest.mark.parametrize("component", ["", "+subscribe, +graph"])
def test_actions_know_their_places_in_the_table_of_endpoints(tmp_path: Path, component: str) -> None:
    """Also where a kind has a place without a declaration."""
    text = f"""\
version: 1
components: [+action_client, +action_server, {component}]
nodes:
  - {{name: one, actions: [{{name: walk, type: example_interfaces/action/Fibonacci}}]}}
  - {{name: two, action_clients: [{{name: walk, type: example_interfaces/action/Fibonacci, goals: 3}}]}}
limits: {{"*": {{sequence: 4}}}}
"""
    runtime = planned(tmp_path, text).project.runtime
    entities = runtime.entities
    kinds = (entities.publishers, entities.subscriptions, entities.services, entities.clients)
    names = []
    for places in kinds:
        found = [getattr(plan, "topic", getattr(plan, "name", "")) for plan in places.declared]
        names += [*found, *[""] * (places.max - len(found))]
    server_part, client_part = (runtime.features.of(f"action_{side}") for side in ("server", "client"))
    assert isinstance(server_part, ActionServerPlan)
    assert isinstance(client_part, ActionClientPlan)
    (server,), (client,) = server_part.servers, client_part.clients
    services = ("send_goal", "cancel_goal", "get_result")
    assert [names[at] for at in server.places] == [
        f"/walk/_action/{part}" for part in (*services, "feedback", "status")
    ]
    assert [names[at] for at in client.places] == [
        f"/walk/_action/{part}" for part in (*services, "feedback")
    ]
    assert len(set(server.places) | set(client.places)) == 9


@pytest.mark.system
@pytest.mark.builds
def test_what_is_built_has_them_and_the_example_leaves_them_to_the_library(made_up: Path) -> None:
    result = planned(made_up, APPLICATION + NODES)
    files = compiler.render(result)
    tables = files["src/support/microros_plan.c"].decode()
    for name in ("/beats", "/one/still_there", "/arm/two/still_there", "/arm/set"):
        assert f'"{name}"' in tables
    example = files[result.project.example].decode()
    assert '"out"' in example
    assert '"set"' in example
    assert "beats" not in example
    assert "still_there" not in example
    out = made_up / "out"
    compiler.write(files, out)
    built = compiler.compile(result, out)
    assert (out / built.report.library).is_file()


def test_without_nodes_the_message_says_what_is_missing(made_up: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(made_up, APPLICATION + "interfaces: [std_msgs/msg/Int32]\n")
    (message,) = (without_id(diagnostic.headline()) for diagnostic in caught.value.diagnostics)
    assert (
        "the publisher '/beats' (and 1 more), which a component opens by itself, needs a declared node"
        in message
    )
    assert caught.value.diagnostics[0].span is not None


def test_ros_time_is_one_of_them() -> None:
    (clock,) = load_catalogue()["clock_ros"].implies
    assert (clock.kind, clock.name, clock.type) == ("subscription", "/clock", "rosgraph_msgs/msg/Clock")
    assert (clock.qos.reliability, clock.qos.depth, clock.queue) == ("best_effort", 1, 1)
    assert [name for name, c in load_catalogue().items() if c.implies] == [
        "clock_ros",
        "diagnosis",
        "graph",
        "graph_events",
        "graph_topic",
        "lifecycle",
        "logger_services",
        "logging_rosout",
        "parameters",
        "parameters_held",
        "tf_broadcaster",
    ]


@pytest.mark.parametrize(
    ("item", "messages"),
    [
        ("{topic: /x, type: a/msg/B}", "'implies' must list endpoints"),
        ("{service: /x}", "type"),
        ("{publisher: /x, type: a/msg/B, rate: 3}", "rate"),
        ("{publisher: /x, type: a/msg/B, qos: {reliability: never}}", "'reliability' must be one of"),
    ],
)
def test_a_faulty_one_is_refused(item: str, messages: str, tmp_path: Path) -> None:
    folder = tmp_path / "x"
    folder.mkdir()
    head = "component: x\nsummary: An example\nlayer: middleware\nstatus: ready\n"
    (folder / "component.yaml").write_text(f"{head}implies: [{item}]\n")
    with pytest.raises(UserError) as caught:
        load_catalogue(tmp_path)
    assert any(messages in without_id(diagnostic.headline()) for diagnostic in caught.value.diagnostics)


LIMITED = """\
component: beat
summary: "Made up: endpoints with limits"
layer: middleware
status: ready
needs: [publish, subscribe, services]
implies:
  - {publisher: /words, type: std_msgs/msg/String, limits: {data: 7}}
  - {subscription: /heard, type: std_msgs/msg/String, qos: {depth: 1}, limits: {string: 5}}
  - {service: "~/ask", type: example_interfaces/srv/SetBool, every_node: true, limits: {message: 9}}
"""
BARE = """\
version: 1
profiles: [pure_sender]
components: [+beat]
nodes: [{name: one}, {name: two}]
"""


@pytest.fixture
def limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    return _ships(LIMITED, tmp_path, monkeypatch)


def sizes(folder: Path, text: str) -> dict[str, int]:
    """Return the largest size of each message that is exchanged: of an entity with lower limits, and of its type."""
    found = {}
    for plan in planned(folder, text).project.types:
        found[str(plan.name)] = plan.max_encoded_size
        found |= {e.topic: own.max_encoded_size for own in plan.limit_sets for e in own.entities}
    return found


def test_their_limits_need_not_be_said(limited: Path) -> None:
    found = sizes(limited, BARE)
    assert found["std_msgs/msg/String"] == 4 + 7 + 1
    assert found["/heard"] == 4 + 5 + 1
    assert found["example_interfaces/srv/SetBool_Response"] == 4 + 4 + 9 + 1


@pytest.mark.parametrize(
    ("more", "words", "values"),
    [
        ("limits: {'*': {string: 99}}\n", 7, 5),
        ("limits: {std_msgs/msg/String: {data: 30}}\n", 30, 30),
        ("endpoints: {/heard: {limits: {data: 3}}}\n", 7, 3),
        ("limits: {std_msgs/msg/String: 30}\nendpoints: {/words: {limits: {string: 40}}}\n", 40, 30),
    ],
)
def test_the_application_changes_them(more: str, words: int, values: int, limited: Path) -> None:
    found = sizes(limited, BARE + more.replace("String: 30", "String: {string: 30}"))
    assert found["std_msgs/msg/String"] == 5 + words
    assert found.get("/heard", found["std_msgs/msg/String"]) == 5 + values


def test_one_of_every_node_is_changed_in_each(limited: Path) -> None:
    changes = 'endpoints: {"~/ask": {depth: 3, queue: 2}, /heard: {depth: 4}}\n'
    project = planned(limited, BARE + changes).project
    matching = [e for node in project.application.nodes for e in node.endpoints if e.topic == "~/ask"]
    assert [(e.qos.depth, e.queue) for e in matching] == [(3, 2), (3, 2)]
    assert [queue.slots for queue in project.runtime.input.queues] == [4, 2, 2]


@pytest.mark.parametrize(
    ("change", "messages"),
    [
        ("/herd: {depth: 1}", "no selected component opens an endpoint '/herd'. Did you mean '/heard'?"),
        ("/words: {queue: 1}", "the publisher '/words' has no queue"),
        ("/words: {limits: {dat: 3}}", "String has no member 'dat'"),
    ],
)
def test_a_faulty_change_is_refused(change: str, messages: str, limited: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(limited, f"{BARE}endpoints: {{{change}}}\n")
    assert any(messages in without_id(d.headline()) for d in caught.value.diagnostics), [
        d.headline() for d in caught.value.diagnostics
    ]


def test_without_nodes_a_subscription_has_its_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = "\n".join(
        line for line in LIMITED.splitlines() if "publisher:" not in line and "~/ask" not in line
    )
    _ships(text, tmp_path, monkeypatch)
    application = (
        "version: 1\nprofiles: [pure_reader]\ncomponents: [+beat]\ninterfaces: [std_msgs/msg/Int32]\n"
    )
    assert sizes(tmp_path, application)["std_msgs/msg/String"] == 4 + 5 + 1
