# SPDX-License-Identifier: Apache-2.0
"""The two tables of D1.4, 4.10.3, mark by mark, and what they lead to."""

from __future__ import annotations

from itertools import combinations

import pytest

from microros_gen.model.component import Catalogue, Middleware
from microros_gen.model.selection import Selection
from microros_gen.model.xrce import BUILTIN_PROFILES, MICRO_ROS_COMPONENTS, SUBMESSAGES, XRCE_PROFILES
from microros_gen.sources.components import load_catalogue
from microros_gen.sources.profiles import load_builtin_profiles

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
    assert sum(len(p.components) for p in load_builtin_profiles().values()) == 17
    assert sum(len(names) for names in middleware.components.values()) == 9


@pytest.mark.parametrize("component", MICRO_ROS_COMPONENTS)
def test_components_need_the_xrce_profiles_of_the_table(component: str, middleware: Middleware) -> None:
    wanted = middleware.components.get(component, ())
    assert [name in wanted for name in XRCE_PROFILES] == marks(XRCE_OF_COMPONENTS)[component]


def test_there_are_seven_profiles_and_nothing_else_changes_their_components() -> None:
    profiles = load_builtin_profiles()
    assert tuple(profiles) == BUILTIN_PROFILES
    assert all(c.add for p in profiles.values() for c in p.components)
    assert not any(p.extends for p in profiles.values())
    assert all(p.summary for p in profiles.values())


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
    return allowed | {s for axis, value in chosen.items() for s in middleware.axes[axis][value].allows}


AXES = [
    (entities, transport, liveliness)
    for entities in ("preconfigured", "reference", "xml", "binary")
    for transport in ("udp", "tcp", "serial", "custom")
    for liveliness in ("ping", "none")
]


@pytest.mark.parametrize("profiles", [*((p,) for p in BUILTIN_PROFILES), *combinations(BUILTIN_PROFILES, 2)])
def test_submessages_are_allowed_by_the_selected_profiles(
    profiles: tuple[str, ...],
    middleware: Middleware,
    catalogue: Catalogue,
    real_catalogue: Catalogue,
    resolve_with: object,
) -> None:
    assert callable(resolve_with)
    for entities, transport, liveliness in AXES:
        text = f"entities: {entities}\ntransport: {{type: {transport}}}\nliveliness: {liveliness}\n"
        for parts in (catalogue, real_catalogue):
            if "ad_hoc_discoverable_sender" in profiles and transport in ("serial", "custom"):
                continue
            outcome = resolve_with(parts, *profiles, text=text)
            assert outcome.said == ()
            selection = outcome.selection
            allowed = allowed_submessages(selection, middleware)
            used = {c.name for c in (*selection.sends, *selection.receives)}
            assert used <= allowed, (profiles, entities, liveliness, used - allowed)


def test_a_preconfigured_pure_sender_creates_and_deletes_nothing(
    resolve_with: object, real_catalogue: Catalogue
) -> None:
    assert callable(resolve_with)
    outcome = resolve_with(real_catalogue, "pure_sender", text="entities: preconfigured\nliveliness: none\n")
    selection = outcome.selection
    names = {c.name for c in (*selection.sends, *selection.receives)}
    assert not names & {"CREATE", "DELETE", "GET_INFO", "INFO", "READ_DATA", "DATA"}
    assert selection.objects == ()
    assert [x.name for x in selection.agent_profiles] == ["file_configuration"]
    assert [x.name for x in selection.xrce_profiles] == ["write", "udp"]


def test_components_folder_loads_and_is_frozen() -> None:
    catalogue = load_catalogue()
    with pytest.raises(TypeError):
        catalogue["x"] = catalogue["node"]  # type: ignore[index]
