# SPDX-License-Identifier: Apache-2.0
"""How many Python modules name a component: each is one that a component like it would have to edit."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path, PurePath

import pytest

import microros_gen
from microros_gen.selection.find_components import load_catalogue

PACKAGE = Path(microros_gen.__file__).parent
_ASKS = ("has", "serves_only", "pick", "Demand", "EntityKind")
"""Functions that are asked for a component by its name."""
_OTHER_MEANING = {
    *(
        "agents",
        "cdr",
        "actions",
        "clock",
        "discovery",
        "tasks",
        "entities",
        "executor",
        "framing",
        "graph",
        "lifecycle",
        "logging",
        "memory",
        "node",
    ),
    *(
        "parameters",
        "peer",
        "ping",
        "publish",
        "qos",
        "read",
        "services",
        "session",
        "subscribe",
        "support",
        "timers",
    ),
    "write",
    "base",
}
"""Names that are words of YAML files, too: they count only where a function is asked for the component."""
DESCRIBING = (".py", ".json", ".yaml", ".j2")
"""Endings of code, schemas, descriptions and templates."""
SHARED = (
    "application/application.schema.json",
    "application/model.py",
    "application/nodes.py",
    "application/parser.py",
    "selection/declared.py",
    "selection/xrce.py",
)
"""Files outside its folder that name `parameters`: the keys of the application file, and the list of D1.4."""
LIFECYCLE_SHARED = (
    "application/application.schema.json",
    "application/model.py",
    "application/nodes.py",
    "selection/declared.py",
    "selection/xrce.py",
)
"""The same for `lifecycle`: the key `managed` of publishers and timers, and the list of D1.4."""
NODE_MODES_SHARED = (
    "application/application.schema.json",
    "application/model.py",
    "application/nodes.py",
    "application/parameter_find.py",
    "selection/declared.py",
    "selection/profile_file.py",
)
"""Those of `node_modes`: the key `modes` of a node, and its values once the parameters of the node are known."""
DIAGNOSIS_SHARED = (
    "application/application.schema.json",
    "application/model.py",
    "application/parser.py",
    "migrate/rclc_draft.py",
    "selection/declared.py",
)
"""Those of `diagnosis`: its key, and what `init` proposes for it."""
_ABOUT_OTHERS = ("agent", "cli", "components", "diagnostics", "mode_manager", "modes", "platform")
OWN_FILES = {
    "node_modes": ("application/mode_decl.py", "application/modes.py"),
    "diagnosis": (
        "application/diagnosis.py",
        "application/diagnosis_decl.py",
        "migrate/diagnosis_checks.py",
    ),
}
"""Python files of a component outside its folder, which nothing else is in."""
ASKS_FOR = {"diagnosis": ("node_modes",)}
"""Components whose declarations another one reads: a check requests a mode."""
C_NAMES = {
    "lifecycle": r"\b(?:rcl|rclc|rmw|xrce)_lifecycle\w*|\bxrce_parts\w*",
    "node_modes": r"\b(?:rclc|rmw)_modes\w*",
    "diagnosis": r"\b(?:rcl|rclc|xrce)_diagnosis\w*",
}
"""How functions, types and headers of a component are called. Hooks that it fills are named by those who call them."""
LOGGING_SHARED = (
    "application/application.schema.json",
    "application/model.py",
    "application/parser.py",
    "selection/profile.schema.json",
    "selection/profile_file.py",
    "selection/xrce.py",
)
"""The same for `logging`: the key of applications and profiles, and the list of D1.4."""
OBSERVED = (
    *(
        "parameter_client",
        "parameter_messages",
        "parameter_storage",
        "parameters_held",
        "graph",
        "graph_events",
    ),
    *("graph_topic", "logging_console", "logging_float", "logging_ring", "logging_rosout", "logging_wide"),
    *("logger_services", "diagnosis"),
)
"""The other components of parameters, graph and logging."""
_OTHER_FILES = {
    "application/modes.py",
    "application/parameter_clients.py",
    "cli/main.py",
    "cli/param.py",
    "cli/ros_tools.py",
    "components/parameter_client/plan.py",
    "documents/schema_words.py",
    "migrate/c_program.py",
    "migrate/parameter_clients.py",
    "migrate/parameter_servers.py",
    "mode_manager/messages.py",
    "mode_manager/served_values.py",
    "parameter_server/exchange.py",
    "parameter_server/file.py",
    "parameter_server/served.py",
    "time_server/parameters.py",
}
"""Values in modes; files with a key `parameters` of clients or a proposal; parameters of C functions, or those in
messages and in a file; commands and options of that name."""
MENTIONS = {
    "action_client": 1,
    "action_server": 1,
    "cdr": 1,
    "cdr_decode": 1,
    "clock": 1,
    "clock_ros": 2,
    "diagnosis": 1,
    "discovery": 3,
    "executor": 2,
    "framing": 1,
    "lifecycle": 1,
    "local_delivery": 1,
    "liveliness_acknack": 2,
    "liveliness_hard": 2,
    "micro_ros_utilities": 1,
    "multithread": 3,
    "node": 1,
    "node_modes": 1,
    "on_silence": 1,
    "parameter_client": 1,
    "parameters": 1,
    "parameters_held": 1,
    "publish": 6,
    "read": 1,
    "seal": 2,
    "services": 5,
    "session_state": 1,
    "sleep_cycles": 2,
    "stream_best_effort": 2,
    "stream_best_effort_input": 1,
    "stream_reliable": 3,
    "stream_reliable_input": 1,
    "subscribe": 4,
    "time_source": 1,
    "time_sync": 2,
    "timers": 2,
}
"""The modules that name each component today. A number may fall, then it is lowered here; none may rise."""


def mentions(text: str, names: set[str]) -> Iterator[str]:
    """Yield each component that a module names; only a module with one of the words is parsed."""
    unambiguous = names - _OTHER_MEANING
    if not re.search(rf"\b(?:{'|'.join(unambiguous)})\b|\b(?:{'|'.join(_ASKS)})\s*\(", text):
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and node.value in unambiguous:
            yield node.value
        if isinstance(node, ast.Call) and called(node) in _ASKS:
            values = (*node.args, *(k.value for k in node.keywords if k.arg == "component"))
            yield from (v.value for v in values if isinstance(v, ast.Constant) and v.value in names)


def called(call: ast.Call) -> str:
    """Return the last name of what is called."""
    function = call.func
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ""


def counted(package: Path) -> dict[str, int]:
    """Return how many modules of `package` name each component; without those that none names."""
    names = {c.name for c in load_catalogue().values() if c.layer != "port"}
    found: dict[str, int] = {}
    for path in sorted(package.rglob("*.py")):
        if path.relative_to(package).parts[0] not in (
            "agent",
            "components",
        ):  # it knows nothing of components
            for name in set(mentions(path.read_text(encoding="utf-8"), names)):
                found[name] = found.get(name, 0) + 1
    return dict(sorted(found.items()))


def test_no_component_is_named_by_more_modules() -> None:
    assert counted(PACKAGE) == MENTIONS


def shared_files(name: str, package: Path) -> set[str]:
    """Return the files outside its folder that name a component in code, schema, template or description."""
    word = re.compile(
        rf"""["']{name}["']|^\s*{name}:|\b(?:node|plan|runtime|features)\.{name}\b""", re.MULTILINE
    )
    found = set()
    for shown, text in texts(package).items():
        own = shown.parts[:2] == ("components", name)
        if (
            shown.suffix not in DESCRIBING
            or own
            or shown.parts[0] in ("agent", "idl", "modes", "ros", "ros_tools")
        ):
            continue
        if name in text and word.search(text):
            found.add(shown.as_posix())
    return found - _OTHER_FILES


@cache
def texts(package: Path) -> Mapping[PurePath, str]:
    """Return code, schemas, templates and descriptions of a package by their places in it; each is read once."""
    return {
        path.relative_to(package): path.read_text(encoding="utf-8")
        for path in package.rglob("*.*")
        if path.suffix in (*DESCRIBING, ".c", ".h")
    }


def test_parameters_are_known_to_at_most_six_shared_files() -> None:
    """The measure of the structure: a component that stands on others is added in its own folder."""
    assert len(SHARED) <= 6
    assert shared_files("parameters", PACKAGE) <= set(SHARED)


def test_the_life_cycle_is_known_to_at_most_six_shared_files() -> None:
    """Its name, and the key `managed` of publishers and timers; what it gates are hooks that have no name of it."""
    found = shared_files("lifecycle", PACKAGE) | shared_files("managed", PACKAGE)
    shared = {file for file in found if not file.startswith("components/lifecycle/")}
    assert shared <= set(LIFECYCLE_SHARED)
    assert len(LIFECYCLE_SHARED) <= 6


def knowing(name: str, words: str, package: Path) -> set[str]:
    """Return the existing files that name a component, its key or its declarations, its own ones left out.

    Commands and their modules are about systems with modes; platforms say what they provide for a component.
    """
    word = re.compile(words, re.MULTILINE)
    others = (
        *OWN_FILES.get(name, ()),
        *(f for n, asks in ASKS_FOR.items() if name in asks for f in OWN_FILES[n]),
    )
    found = set()
    for shown, text in texts(package).items():
        if (
            shown.suffix in DESCRIBING
            and shown.parts[0] not in _ABOUT_OTHERS
            and shown.as_posix() not in others
            and word.search(text)
        ):
            found.add(shown.as_posix())
    return found


def test_modes_of_nodes_are_known_to_at_most_six_shared_files() -> None:
    words = (
        r"""["'](?:node_)?modes["']|^\s*modes:|\bnode\.modes\b|\bmodes=|\bmode_decl\b|application\.modes\b"""
    )
    assert knowing("node_modes", words, PACKAGE) == set(NODE_MODES_SHARED)
    assert len(NODE_MODES_SHARED) <= 6


def test_the_diagnosis_is_known_to_at_most_six_shared_files() -> None:
    words = r"""["']diagnosis["']|^\s*diagnosis:|\.diagnosis\b|\bdiagnosis=|\bdiagnosis(?:_decl|_checks)\b"""
    assert knowing("diagnosis", words, PACKAGE) == set(DIAGNOSIS_SHARED)
    assert len(DIAGNOSIS_SHARED) <= 6


def naming_in_c(name: str, package: Path) -> set[str]:
    """Return the C files and templates that use something of a component and need it not; its folder is left out."""
    needing = {c.name for c in load_catalogue().values() if name in c.needs} | {name}
    word = re.compile(C_NAMES[name])
    found = set()
    for shown, text in texts(package).items():
        is_own = shown.parts[0] == "components" and not needing.isdisjoint(shown.parts[1:2])
        is_c = shown.name.removesuffix(".j2").endswith((".c", ".h"))
        if is_c and not is_own and word.search(text):
            found.add(shown.as_posix())
    return found


@pytest.mark.parametrize("name", C_NAMES)
def test_no_c_file_of_others_uses_what_it_has(name: str, tmp_path: Path) -> None:
    """Others call hooks, which do nothing where the component is not selected."""
    assert naming_in_c(name, PACKAGE) == set()
    (tmp_path / "components" / "other").mkdir(parents=True)
    (tmp_path / "components" / "other" / "a.c").write_text(
        "x = rclc_modes_y; rcl_lifecycle_y(); rcl_diagnosis_y();"
    )
    assert naming_in_c(name, tmp_path) == {"components/other/a.c"}


def test_log_messages_are_known_to_at_most_six_shared_files() -> None:
    assert shared_files("logging", PACKAGE) <= set(LOGGING_SHARED)
    assert len(LOGGING_SHARED) <= 6


@pytest.mark.parametrize("name", OBSERVED)
def test_a_component_of_parameters_graph_and_logging_is_known_to_at_most_six(name: str) -> None:
    assert len(shared_files(name, PACKAGE)) <= 6


def test_a_file_that_names_a_component_is_found(tmp_path: Path) -> None:
    for name, text in {
        "a.py": "x = node.gears\n",
        "b.json": '{"gears": 1}',
        "c.yaml": "  gears: 3\n",
        "d.j2": "{{ plan.gears.max }}",
        "e.py": "# gears of a machine\n",
        "components/gears/component.yaml": "gears: 1\n",
        "components/other/component.yaml": "manifest:\n  gears: 1\n",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    named = {"a.py", "b.json", "c.yaml", "d.j2", "components/other/component.yaml"}
    assert shared_files("gears", tmp_path) == named


def test_most_components_are_named_by_few() -> None:
    assert sum(MENTIONS.values()) <= 63
    assert max(MENTIONS.values()) <= 6


def test_a_new_mention_is_counted(tmp_path: Path) -> None:
    (tmp_path / "x.py").write_text(
        """a = selection.has("publish")\nb = "publish"\nc = "sleep_cycles"\nd = "read" """
    )
    assert counted(tmp_path) == {"publish": 1, "sleep_cycles": 1}
