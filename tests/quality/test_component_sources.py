# SPDX-License-Identifier: Apache-2.0
"""Who refers to whom in the C of components, and how much their templates decide."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from jinja2 import Environment, nodes

from microros_gen.platform.capabilities import capabilities
from microros_gen.selection.component import Component
from microros_gen.selection.find_components import components_folder, load_catalogue, parts_folder

ROOT = components_folder()
PACKAGES = parts_folder() / "package"
CATALOGUE = load_catalogue()
_INCLUDE = re.compile(r'^\s*#include "([^"]+)"', re.MULTILINE)
SELECTING_FILTERS = {"select", "selectattr", "reject", "rejectattr", "default", "d"}
"""Filters that leave something out: a condition in another form."""


def templates() -> list[Path]:
    """Return the templates of all components, parts of a platform included."""
    return sorted(path for component in CATALOGUE.values() for path in component.folder.rglob("*.j2"))


def conditions(text: str) -> int:
    """Return how many conditions a template has: if, elif, inline if, a loop's if or else, a filter that selects."""
    tree = Environment(autoescape=True).parse(text)
    count = len(list(tree.find_all((nodes.If, nodes.CondExpr))))
    count += sum((loop.test is not None) + bool(loop.else_) for loop in tree.find_all(nodes.For))
    return count + sum(f.name in SELECTING_FILTERS for f in tree.find_all(nodes.Filter))


def test_conditions_are_counted_in_every_form() -> None:
    text = "{% if a %}{% elif b %}{% endif %}{{ 1 if c }}{% for d in e if f %}{% else %}h{% endfor %}{{ g | select }}"
    assert conditions(text) == 6


def test_no_template_of_a_component_or_part_is_left_out() -> None:
    parts = (path for path in parts_folder().rglob("*.j2") if not path.is_relative_to(PACKAGES))
    assert set(templates()) == {*ROOT.rglob("*.j2"), *parts}


def test_templates_of_packages_decide_nothing() -> None:
    """What they print is decided by the view, and which of them there are by package.yaml."""
    assert {
        path: conditions(path.read_text(encoding="utf-8")) for path in PACKAGES.rglob("*.j2")
    } == dict.fromkeys(PACKAGES.rglob("*.j2"), 0)


def test_templates_decide_little() -> None:
    """Choices are files with conditions in component.yaml; templates had 396 before."""
    assert sum(conditions(path.read_text(encoding="utf-8")) for path in templates()) <= 100


@cache
def headers() -> dict[str, set[str]]:
    """Return which components bring each header; one that stands in for another's does not count."""
    found: dict[str, set[str]] = {}
    for component in CATALOGUE.values():
        replaces = {r.header for r in component.contributes.replaces}
        folder = component.folder / "include"
        paths = [
            p.relative_to(folder).as_posix().removesuffix(".j2") for p in folder.rglob("*") if p.is_file()
        ]
        for header in (*paths, *(variant.header for variant in component.contributes.variants)):
            if header not in replaces:
                found.setdefault(header, set()).add(component.name)
    return found


def includes(component: Component) -> Iterator[tuple[str, str]]:
    """Yield each file of a component with the component whose header it includes; a choice of several has no owner."""
    owners = headers()
    for path in sorted(component.folder.rglob("*")):
        if path.suffix in (".c", ".h", ".j2", ".S"):
            for header in _INCLUDE.findall(path.read_text(encoding="utf-8")):
                owner = owners.get(header, set())
                if len(owner) == 1 and component.name not in owner:
                    yield path.name, next(iter(owner))


def groups(edges: Iterable[tuple[str, str]]) -> list[set[str]]:
    """Return the sets of components that include each other, directly or by way of others."""
    reached: dict[str, set[str]] = {}
    graph: dict[str, set[str]] = {}
    for source, target in edges:
        graph.setdefault(source, set()).add(target)
    for name in graph:
        seen: set[str] = set()
        waiting = [name]
        while waiting:
            for target in graph.get(waiting.pop(), ()):
                if target not in seen:
                    seen.add(target)
                    waiting.append(target)
        reached[name] = seen
    found: list[set[str]] = []
    for name, seen in reached.items():
        group = {other for other in seen if name in reached.get(other, ())}
        if name in seen and group not in found:
            found.append(group)
    return found


def test_groups_are_found() -> None:
    assert groups([("a", "b"), ("b", "c"), ("c", "b"), ("c", "d")]) == [{"b", "c"}]


def test_components_do_not_include_each_other() -> None:
    edges = {(c.name, owner) for c in CATALOGUE.values() for _, owner in includes(c)}
    assert {name for name, _ in edges} > {"publish", "session", "port_bare", "port_cortex_m"}, "all are read"
    assert groups(edges) == []


def declaring(component: Component) -> set[str]:
    """Return who declares the capabilities that a part of a platform provides or asks for, in their headers."""
    if component.layer != "port":
        return set()
    asks = (*component.asks, *(ask for provided in component.provides for ask in provided.asks))
    names = {ask.capability for ask in asks} | {provided.capability for provided in component.provides}
    owners = headers()
    return {owner for name in names for owner in owners[capabilities()[name].header]}


def needed(component: Component) -> set[str]:
    """Return what a component may include: what it needs, and what they need; what a condition names."""
    found: set[str] = set()
    waiting = [component.name]
    while waiting:
        for need in CATALOGUE[waiting.pop()].needs:
            if need not in found:
                found.add(need)
                waiting.append(need)
    parts = component.contributes
    conditional = (*parts.hooks, *parts.handlers, *parts.state, *parts.replaces, *parts.variants)
    conditions = [part.when for part in conditional]
    conditions += [source.when for source in component.sources]
    names = [path for when in conditions for path, _ in when if path.startswith("component.")]
    return found | {name.partition(".")[2] for name in names} | declaring(component)


def test_what_is_included_is_needed() -> None:
    wrong = {
        f"{c.name}/{file}: {owner}"
        for c in CATALOGUE.values()
        for file, owner in includes(c)
        if owner not in needed(c)
    }
    assert wrong == set()


def test_the_time_of_day_is_asked_in_one_place() -> None:
    """A stamp that asked the port itself ignored the source of the time; a header that is replaced does not."""
    callers = {
        f"{component.name}/{path.name}"
        for component in CATALOGUE.values()
        if component.layer != "port"
        for path in component.folder.rglob("*.[chj]*")
        if path.suffix in {".c", ".h", ".j2"}
        if "port_time_epoch_ns()" in path.read_text(encoding="utf-8")
    }
    by_clocks = {"clock/rcl_clock_epoch.h", "time_sync/rcl_clock_epoch.h"}
    assert callers == {"support/epoch.h", "time_source/epoch.h", *by_clocks}


def test_calls_go_down() -> None:
    """rclc_* → rcl_* → rmw_* → xrce_*: a file includes internal headers of its layer and of lower ones."""
    layers = ("rclc", "rcl", "rmw", "xrce")
    order = {layer: i for i, layer in enumerate(layers)}
    wrong = []
    for path in sorted(ROOT.rglob("*")):
        layer = order.get(path.name.partition("_")[0])
        if layer is None or path.suffix not in (".c", ".h", ".j2"):
            continue
        for header in _INCLUDE.findall(path.read_text(encoding="utf-8")):
            name = header.removeprefix("microros/")
            other = order.get(name.partition("_")[0]) if name != header else None
            if other is not None and other < layer:
                wrong.append(f"{path.relative_to(ROOT)}: {header}")
    assert wrong == []


_ARGUMENT = re.compile(r'microros_error_refuse\([^;]*"[^;]*;')
"""An error that names an argument of the application, such as "node"."""


@cache
def shared_texts() -> dict[str, str]:
    """Return the files of components and the shared templates, each with its text, less names of arguments."""
    package = ROOT.parent
    paths = [p for folder in (ROOT, package / "templates") for p in sorted(folder.rglob("*"))]
    return {
        p.relative_to(package).as_posix(): _ARGUMENT.sub("", p.read_text(encoding="utf-8"))
        for p in paths
        if p.suffix in (".c", ".h", ".j2", ".yaml")
    }


def mentions(component: str) -> list[str]:
    """Return the files of other components and the shared templates that name a component."""
    word = re.compile(rf"(?:has\(['\"]|component\.|\"){component}\b")
    own = f"{ROOT.name}/{component}/"
    return [path for path, text in shared_texts().items() if not path.startswith(own) and word.search(text)]


MOST_MENTIONS = 9


def test_few_places_name_a_component() -> None:
    named = {name: len(mentions(name)) for name in CATALOGUE}
    assert {name: count for name, count in named.items() if count > MOST_MENTIONS} == {}


_HAS = re.compile(r'\bhas\(\s*"([a-z_]+)"\s*\)')
MOST_QUESTIONS = 33
"""Modules that ask whether a component by its name is selected, summed over the components."""


def test_few_modules_ask_for_a_component() -> None:
    """A component contributes: what depends on it is declared in its component.yaml, or in its own plan.py."""
    package = ROOT.parent
    found = {
        (path.relative_to(package).as_posix(), name)
        for path in package.rglob("*.py")
        for name in _HAS.findall(path.read_text(encoding="utf-8"))
        if name in CATALOGUE and not path.is_relative_to(ROOT / name)
    }
    assert 0 < len(found) <= MOST_QUESTIONS, sorted(found)


_C_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_C_FUNCTION = re.compile(r"^[\w *]*\b(\w+)\([^;{}]*\)\n\{\n(.*?)\n\}", re.MULTILINE | re.DOTALL)
SHORT = 200
"""Characters of a function, without spaces, that two components may both have."""


def bodies(path: Path) -> list[tuple[str, str]]:
    """Return the longer functions of a C file, each with its statements without spaces and comments."""
    found = _C_FUNCTION.findall(_C_COMMENT.sub("", path.read_text(encoding="utf-8")))
    texts = [(name, "".join(body.split())) for name, body in found]
    return [(name, text) for name, text in texts if len(text) > SHORT]


def test_no_line_is_too_long_for_a_review() -> None:
    """clang-format wraps code at 110 characters and leaves comments alone: most of them keep 120."""
    long = [
        f"{path.name}:{number}"
        for path in sorted(ROOT.parent.rglob("*.[ch]"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 130
    ]
    assert long == []


def test_no_function_is_in_two_components() -> None:
    """What two components need is in one that both need."""
    where: dict[str, set[str]] = {}
    for component in CATALOGUE.values():
        for path in sorted(component.folder.rglob("*")):
            if path.suffix in {".c", ".h", ".j2"}:
                for name, text in bodies(path):
                    where.setdefault(text, set()).add(f"{component.name}: {name}")
    assert len(where) > 100
    assert [sorted(names) for names in where.values() if len(names) > 1] == []
