# SPDX-License-Identifier: Apache-2.0
"""`nodes:` of profiles: whose nodes an application has that says nothing of entities."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.application.action_decl import ActionDecl
from microros_gen.application.model import NodeDecl
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.documents.named import Named
from microros_gen.selection.find_profiles import load_builtin_profiles, load_profiles
from microros_gen.selection.profile_file import parse_profile
from microros_gen.selection.profile_nodes import joined_nodes
from microros_gen.selection.profiles import resolve_profiles
from tests.support.ids import without_id
from tests.support.paths import PACKAGE

ARM = """\
profile: arm
components: [+node, +publish, +services, +timers, +executor]
nodes:
  - name: arm
    publishers: [{topic: angle, type: std_msgs/msg/Float32}]
    services: [{name: grip, type: std_srvs/srv/Trigger}]
    timers: [{name: control, period: 10 ms}]
    executors: [{name: fast, handles: [control]}, {name: slow, handles: [control, grip]}]
"""
HAND = """\
profile: hand
components: [+node, +publish]
nodes:
  - name: arm
    publishers: [{topic: force, type: std_msgs/msg/Float32}, {topic: angle, type: std_msgs/msg/Int32}]
  - name: hand
    publishers: [{topic: touch, type: std_msgs/msg/Bool}]
"""


def write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


def nodes_of(folder: Path, *names: str) -> dict[str, list[str]]:
    """Return the names of the folded profile's nodes, and of all that each of them has."""
    found = Diagnostics()
    (resolved,) = resolve_profiles(load_profiles([Named(n) for n in names], folder, found), found)
    assert [d.headline() for d in found] == []
    return {node.name: [*parts(node)] for node in resolved.nodes}


def parts(node: NodeDecl) -> Iterator[str]:
    yield from (endpoint.topic for endpoint in node.endpoints)
    yield from (timer.name for timer in node.timers)
    yield from (f"{e.name}({' '.join(h.name for h in e.handles)})" for e in node.executors)


def declared(folder: Path, text: str) -> tuple[NodeDecl, ...]:
    """Return the nodes of an application file."""
    write(folder, microros=text)
    options = compiler.Options(config=folder / "microros.yaml")
    return compiler.resolve(compiler.read(options)).request.application.nodes


def planned(folder: Path, text: str) -> list[str]:
    """Return what the application itself has, as `node kind name`."""
    nodes = declared(folder, text)
    return [f"{n.name} {e.kind} {e.topic}" for n in nodes for e in n.endpoints if not e.of_the_library]


def test_the_own_nodes_replace_those_of_what_is_extended(tmp_path: Path) -> None:
    write(tmp_path, arm=ARM, own=f"{HAND.replace('profile: hand', 'profile: own')}extends: [arm]\n")
    assert nodes_of(tmp_path, "own") == {"arm": ["force", "angle"], "hand": ["touch"]}
    write(tmp_path, none="profile: none\nextends: [arm]\nnodes: []\n")
    assert nodes_of(tmp_path, "none") == {}


def test_nodes_of_one_name_are_one(tmp_path: Path) -> None:
    write(tmp_path, arm=ARM, hand=HAND, both="profile: both\nextends: [arm, hand]\n")
    assert nodes_of(tmp_path, "both") == {
        "arm": ["angle", "grip", "force", "control", "fast(control)", "slow(control grip)"],
        "hand": ["touch"],
    }
    found = Diagnostics()
    both = resolve_profiles(load_profiles([Named("both")], tmp_path, found), found)[0]
    assert both.nodes[0].endpoints[0].type == "std_msgs/msg/Float32", "the first one wins"


def test_what_a_profile_drops_is_not_in_the_nodes_that_it_inherits(tmp_path: Path) -> None:
    write(tmp_path, arm=ARM, still="profile: still\nextends: [arm]\ncomponents: [-timers]\n")
    assert nodes_of(tmp_path, "still") == {"arm": ["angle", "grip", "slow(grip)"]}


def test_what_an_application_drops_is_not_in_the_nodes(tmp_path: Path) -> None:
    alone = "version: 1\nprofiles: [configurable_sender_with_diagnostics]\n"
    assert planned(tmp_path, alone) == ["device publisher /diagnostics"]
    assert [p.name for p in declared(tmp_path, alone)[0].parameters] == ["gain"]
    (device,) = declared(tmp_path, f"{alone}components: [-parameters]\n")
    assert device.parameters == ()


def test_without_a_life_cycle_nothing_is_managed(tmp_path: Path) -> None:
    write(tmp_path, less="profile: less\nextends: [managed_service]\ncomponents: [-lifecycle, +publish]\n")
    found = Diagnostics()
    (less,) = resolve_profiles(load_profiles([Named("less")], tmp_path, found), found)
    assert {e.topic: e.managed for e in less.nodes[0].endpoints} == {"count": False, "set_bool": False}
    own = planned(tmp_path, "version: 1\nprofiles: [less.yaml]\n")
    assert own == ["device publisher count", "device service set_bool"]


@pytest.mark.parametrize(
    "entities", ["nodes: [{name: own}]", "interfaces: [std_msgs/msg/Bool]", "pools: {publishers: 2}"]
)
def test_an_application_that_says_something_of_entities_has_its_own(tmp_path: Path, entities: str) -> None:
    write(tmp_path, hand=HAND)
    found = planned(tmp_path, f"version: 1\nprofiles: [hand.yaml]\n{entities}\n")
    assert found == []


def test_the_profile_of_a_folder_of_extensions_brings_its_nodes(tmp_path: Path) -> None:
    (tmp_path / "kit" / "profiles").mkdir(parents=True)
    write(tmp_path / "kit" / "profiles", arm=ARM)
    text = "version: 1\nprofiles: [arm]\ncomponents: [./kit]\n"
    assert planned(tmp_path, text) == ["arm publisher angle", "arm service grip"]


def test_nodes_need_their_components(tmp_path: Path) -> None:
    write(tmp_path, own=HAND.replace("+node, +publish", "+node").replace("profile: hand", "profile: own"))
    with pytest.raises(UserError) as caught:
        planned(tmp_path, "version: 1\nprofiles: [own.yaml]\n")
    first = without_id(caught.value.diagnostics[0].headline())
    assert "own.yaml:5:18: error: a publisher needs the component 'publish', which nothing selects" in first


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        (
            "parameters: {file: gains.yaml}",
            "x:3:34: error: a node of a profile reads no parameter file. Write the parameters below `declare`",
        ),
        (
            "modes: {SLOW: {speed: 0.2}}",
            "x:3:30: error: the node 'n' has no parameter 'speed'. Declare it below `parameters:`",
        ),
        (
            "namespace: 1",
            "x:3:26: error: 'nodes[0].namespace' must be a namespace such as /robot; it is 1. Put it into "
            'quotes: "1"',
        ),
    ],
)
def test_faulty_nodes_are_reported_at_their_places(node: str, expected: str) -> None:
    found = Diagnostics()
    assert parse_profile(Source("x", f"profile: x\nnodes:\n  - {{name: n, {node}}}\n"), found) is None
    assert [without_id(d.headline()) for d in found] == [expected]


def test_no_module_names_a_profile() -> None:
    """A profile is described by its file alone. `init` proposes some by their names, and D1.4 gives their order."""
    names = [f'"{name}"' for name in load_builtin_profiles()]
    own = [p for p in sorted(PACKAGE.rglob("*.py")) if p.parent.name != "migrate" and p.name != "xrce.py"]
    naming = [path.name for path in own if any(name in path.read_text(encoding="utf-8") for name in names)]
    assert len(names) == 8
    assert naming == []


def test_one_node_of_two_profiles_has_the_actions_of_both() -> None:
    walk, turn = ActionDecl("/walk", "acme_msgs/action/Walk"), ActionDecl("/turn", "acme_msgs/action/Turn")
    (node,) = joined_nodes([NodeDecl("robot", actions=(walk,)), NodeDecl("robot", actions=(walk, turn))])
    assert node.actions == (walk, turn)
