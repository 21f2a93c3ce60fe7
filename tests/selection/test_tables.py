# SPDX-License-Identifier: Apache-2.0
"""The two tables of D1.4, 4.10.3, mark by mark, and what they lead to."""

from __future__ import annotations

import ast
from collections.abc import Callable
from itertools import combinations, product
from pathlib import Path

import pytest

import microros_gen
from microros_gen.selection.component import Catalogue, Middleware
from microros_gen.selection.find_components import load_catalogue
from microros_gen.selection.find_profiles import load_builtin_profiles
from microros_gen.selection.model import Selection
from microros_gen.selection.xrce import MICRO_ROS_COMPONENTS, SUBMESSAGES, XRCE_PROFILES
from tests.support.selection.profiles import ALL_PROFILES, BUILTIN_PROFILES
from tests.support.selection.small_catalogue import Outcome
from tests.support.slices import spread

# Columns: BUILTIN_PROFILES in its order.
COMPONENTS_OF_PROFILES = """
node       x x x x x x x
lifecycle  . . . . . x .
publish    x . x x x . .
subscribe  . x . . . . .
services   . . . . . x .
timers     . . . . . . .
clock      . . . . . . .
logging    . . x . . . .
parameters . . x . . . .
executor   . . . . . . .
discovery  . . . x . . .
"""
# Columns: XRCE_PROFILES in its order.
XRCE_OF_COMPONENTS = """
node       . . . . . . . . . .
lifecycle  x x . . . . . . . .
publish    . x . . . . . . . .
subscribe  x . . . . . . . . .
services   x x . . . . . . . .
timers     . . . . . . . . . .
clock      . . . . . . . . . .
logging    . . . . . . . . . .
parameters x x . . . . . . . .
executor   . . . . . . . . . .
discovery  . . . . . x . . . .
"""
ROW_COUNTS = {"node": 7, "lifecycle": 1, "publish": 4, "subscribe": 1, "services": 1, "logging": 1}
ROW_COUNTS |= {"parameters": 1, "discovery": 1}


def marks(table: str) -> dict[str, list[bool]]:
    rows = (line.split() for line in table.strip().splitlines())
    return {name: [mark == "x" for mark in cells] for name, *cells in rows}


@pytest.mark.parametrize("component", MICRO_ROS_COMPONENTS)
def test_profiles_have_the_components_of_the_table(component: str) -> None:
    profiles = load_builtin_profiles()
    row = marks(COMPONENTS_OF_PROFILES)[component]
    have = [any(c.name == component for c in profiles[name].components) for name in BUILTIN_PROFILES]
    assert have == row
    assert sum(have) == ROW_COUNTS.get(component, 0)


def test_there_are_seventeen_and_nine_marks(middleware: Middleware) -> None:
    profiles = load_builtin_profiles()
    assert sum(len(profiles[name].components) for name in BUILTIN_PROFILES) == 17
    assert sum(len(names) for names in middleware.components.values()) == 9


@pytest.mark.parametrize("component", MICRO_ROS_COMPONENTS)
def test_components_need_the_xrce_profiles_of_the_table(component: str, middleware: Middleware) -> None:
    wanted = middleware.components.get(component, ())
    assert [name in wanted for name in XRCE_PROFILES] == marks(XRCE_OF_COMPONENTS)[component]


def test_there_are_seven_profiles_and_nothing_else_changes_their_components() -> None:
    profiles = load_builtin_profiles()
    assert tuple(profiles) == ALL_PROFILES
    assert all(c.add for p in profiles.values() for c in p.components)
    assert not any(p.extends for p in profiles.values())
    assert all(p.summary for p in profiles.values())


def test_no_module_names_a_profile() -> None:
    """A profile is known by its file alone: another one is added without a change in Python."""
    names = set(load_builtin_profiles())
    found = [
        f"{path.name}:{node.lineno}"
        for path in sorted(Path(microros_gen.__file__).parent.rglob("*.py"))
        if any(name in (text := path.read_text(encoding="utf-8")) for name in names)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Constant) and node.value in names
    ]
    assert found == []


def test_the_real_components_agree_with_the_table(real_catalogue: Catalogue, middleware: Middleware) -> None:
    for name in MICRO_ROS_COMPONENTS:
        assert real_catalogue[name].layer == "micro-ROS"
        assert set(real_catalogue[name].xrce) == set(middleware.components.get(name, ())), name
    others = [c for c in real_catalogue.values() if c.name not in MICRO_ROS_COMPONENTS]
    assert all(c.layer != "micro-ROS" for c in others)


def test_what_xrce_profiles_allow_is_what_the_standard_says(middleware: Middleware) -> None:
    everything = set(SUBMESSAGES)
    assert len(everything) == 16
    allowed = {name: set(profile.allows) for name, profile in middleware.xrce_profiles.items()}
    assert everything - allowed["read"] == {"CREATE", "INFO", "WRITE_DATA", "DELETE"}
    assert everything - allowed["write"] == {"CREATE", "INFO", "READ_DATA", "DATA", "DELETE"}
    assert allowed["configure_entities"] == {"CREATE_CLIENT", "STATUS_AGENT", "CREATE", "DELETE", "STATUS"}
    assert allowed["configure_qos"] == allowed["configure_types"] == {"CREATE"}
    assert allowed["discovery"] == {"GET_INFO", "INFO"}
    assert allowed["udp"] == allowed["tcp"] == allowed["file_configuration"] == set()
    assert allowed["complete"] == everything


def allowed_submessages(selection: Selection, middleware: Middleware) -> set[str]:
    allowed = {s for x in selection.xrce_profiles for s in middleware.xrce_profiles[x.name].allows}
    chosen = {"entities": selection.entities, "transport": selection.transport}
    chosen["liveliness"] = selection.liveliness
    return allowed | {s for axis, value in chosen.items() for s in middleware.axes[axis].values[value].allows}


ENTITIES = ("reference", "xml", "binary")
TRANSPORTS = ("udp", "tcp", "serial", "canfd", "custom")
SETS = [*((p,) for p in BUILTIN_PROFILES), *combinations(BUILTIN_PROFILES, 2)]
ResolveWith = Callable[..., Outcome]


def forbidden(outcome: Outcome, middleware: Middleware) -> set[str]:
    """Return what a client would send or receive and its XRCE profiles do not allow."""
    selection = outcome.selection
    assert outcome.messages == ()
    used = {c.name for c in (*selection.sends, *selection.receives)}
    return used - allowed_submessages(selection, middleware)


def axes_text(entities: str, transport: str, liveliness: str) -> str:
    return f"entities: {entities}\ntransport: {{type: {transport}}}\nliveliness: {liveliness}\n"


@pytest.mark.parametrize("profiles", spread(SETS), ids="+".join)
def test_submessages_are_allowed_by_the_selected_profiles(
    profiles: tuple[str, ...],
    middleware: Middleware,
    catalogue: Catalogue,
    real_catalogue: Catalogue,
    resolve_with: ResolveWith,
) -> None:
    by_multicast = "ad_hoc_discoverable_sender" in profiles
    for entities, transport, liveliness in product(ENTITIES, TRANSPORTS, ("ping", "none")):
        if not by_multicast or transport in ("udp", "tcp"):
            text = axes_text(entities, transport, liveliness)
            for parts in (catalogue, real_catalogue):
                assert not forbidden(resolve_with(parts, *profiles, text=text), middleware), text


@pytest.mark.parametrize("profiles", SETS, ids="+".join)
def test_a_preconfigured_client_creates_and_deletes_nothing(
    profiles: tuple[str, ...], middleware: Middleware, catalogue: Catalogue, resolve_with: ResolveWith
) -> None:
    for liveliness in ("ping", "none"):
        outcome = resolve_with(catalogue, *profiles, text=axes_text("preconfigured", "udp", liveliness))
        assert not forbidden(outcome, middleware)
        assert not {"CREATE", "DELETE"} & {c.name for c in outcome.selection.sends}
        assert {o.name for o in outcome.selection.objects} <= {"client"}


@pytest.mark.parametrize("profiles", SETS, ids="+".join)
def test_the_runtime_can_leave_delete_out(
    profiles: tuple[str, ...], middleware: Middleware, real_catalogue: Catalogue, resolve_with: ResolveWith
) -> None:
    for liveliness in ("ping", "none"):
        outcome = resolve_with(real_catalogue, *profiles, text=axes_text("preconfigured", "udp", liveliness))
        assert not forbidden(outcome, middleware)
        assert not {"CREATE", "DELETE"} & {c.name for c in outcome.selection.sends}
        reads = {"subscribe", "services", "discovery"} & set(outcome.names())
        assert reads or "STATUS" not in {c.name for c in outcome.selection.receives}
        assert not {"session_close", "entities"} & set(outcome.names())


@pytest.mark.parametrize("entities", ENTITIES)
@pytest.mark.parametrize("creation", ["best_effort", "reliable"])
def test_each_way_to_create_shows_its_xrce_profiles(
    entities: str, creation: str, middleware: Middleware, real_catalogue: Catalogue, resolve_with: ResolveWith
) -> None:
    text = f"entities: {entities}\ncreation: {creation}\nliveliness: none\ninterfaces: []\n"
    outcome = resolve_with(real_catalogue, "pure_sender", text=text)
    assert not forbidden(outcome, middleware) - {"ACKNACK", "HEARTBEAT"}
    selection = outcome.selection
    assert [x.name for x in selection.xrce_profiles] == ["write", "configure_entities", "udp"]
    assert [x.name for x in selection.agent_profiles] == (
        ["file_configuration"] if entities == "reference" else []
    )
    assert [s.name for s in selection.sends][:3] == ["CREATE_CLIENT", "CREATE", "DELETE"]
    ways = {name for name in outcome.names() if name.startswith("entities_")}
    assert ways == {f"entities_{entities}"}
    assert ("stream_reliable_input" in outcome.names()) == (creation == "reliable")


def test_a_stream_for_creation_where_nothing_is_created(
    real_catalogue: Catalogue, resolve_with: ResolveWith
) -> None:
    outcome = resolve_with(
        real_catalogue, "pure_sender", text="entities: preconfigured\ncreation: reliable\n"
    )
    (messages,) = outcome.messages
    assert messages.startswith("microros.yaml:")
    assert ": error: creation: reliable (microros.yaml:" in messages
    assert "contradicts entities: preconfigured (microros.yaml:" in messages
    assert "Remove `creation:`" in messages


def test_a_preconfigured_pure_sender_only_writes(resolve_with: ResolveWith, catalogue: Catalogue) -> None:
    outcome = resolve_with(catalogue, "pure_sender", text=axes_text("preconfigured", "udp", "none"))
    selection = outcome.selection
    assert [s.name for s in selection.sends] == ["CREATE_CLIENT", "WRITE_DATA", "HEARTBEAT"]
    assert [r.name for r in selection.receives] == ["STATUS_AGENT", "ACKNACK"]
    assert [x.name for x in selection.agent_profiles] == ["file_configuration"]
    assert [x.name for x in selection.xrce_profiles] == ["write", "udp"]


def test_components_folder_loads_and_is_frozen() -> None:
    catalogue = load_catalogue()
    with pytest.raises(TypeError):
        catalogue["x"] = catalogue["node"]  # type: ignore[index]
