# SPDX-License-Identifier: Apache-2.0
"""Reading component.yaml files, and the folder that ships with the tool."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from operator import attrgetter
from pathlib import Path

import pytest

from microros_gen.application.parser import SCHEMA as APPLICATION_SCHEMA
from microros_gen.client.plan.board import BoardPlan
from microros_gen.client.plan.features import feature_of
from microros_gen.diagnostics import UserError
from microros_gen.documents.schema import load_schema
from microros_gen.platform.target import Target
from microros_gen.selection.component import Ask, Catalogue, Component, Middleware, Provision, SourceFile
from microros_gen.selection.contribution import Conditional
from microros_gen.selection.find_components import components_folder, load_catalogue
from microros_gen.selection.xrce import MICRO_ROS_COMPONENTS
from tests.support.ids import without_id
from tests.support.plans import POOL

GOOD = """\
component: x
summary: An example
layer: middleware
status: ready
needs: []
xrce: [read, write]
sends: [READ_DATA]
receives: [DATA]
objects: [datareader]
headers: [rcl/x.h]
sources: [rcl_x.c, {file: rcl_y.c, when: {on_full: error, mtu: 512}}]
asks: [time, {capability: lock, when: {session.multithread: true}}]
provides: {wait: {sources: [rcl_w.c], asks: [idle], always: true}}
"""


def write(folder: Path, name: str, text: str) -> None:
    (folder / name).mkdir()
    (folder / name / "component.yaml").write_text(text, encoding="utf-8")


def test_a_component_is_read(tmp_path: Path) -> None:
    write(tmp_path, "x", GOOD)
    (tmp_path / "not_a_component").mkdir()
    catalogue = load_catalogue(tmp_path)
    component = catalogue["x"]
    assert list(catalogue) == ["x"]
    assert (component.summary, component.layer, component.ready) == ("An example", "middleware", True)
    assert component.xrce == ("read", "write")
    assert (component.sends, component.receives, component.objects) == (
        ("READ_DATA",),
        ("DATA",),
        ("datareader",),
    )
    assert (component.headers, component.sources) == (
        ("rcl/x.h",),
        (SourceFile("rcl_x.c"), SourceFile("rcl_y.c", (("on_full", "error"), ("mtu", 512)))),
    )
    assert component.asks == (Ask("time"), Ask("lock", (("session.multithread", True),)))
    wait = Provision("wait", (SourceFile("rcl_w.c"),), (Ask("idle"),), True)
    assert component.provides == (wait,)


ERRORS = {
    "unknown key": (
        "needs:",
        "need:",
        "x/component.yaml:5:1: error: unknown key 'need'. Did you mean",
    ),
    "missing key": ("summary: An example\n", "", "x/component.yaml:1:1: error: missing key 'summary'"),
    "layer": (
        "middleware",
        "midleware",
        "x/component.yaml:3:8: error: 'layer' must be one of micro-ROS, middle",
    ),
    "status": ("ready\n", "done\n", "x/component.yaml:4:9: error: 'status' must be one of ready, planned"),
    "list": ("[rcl/x.h]", "rcl/x.h", "x/component.yaml:10:10: error: 'headers' must be a list"),
    "sources": (
        "sources: [rcl_x.c, {",
        "sources: {rcl_x.c: 1, a: {",
        "x/component.yaml:11:10: error: 'sources' must",
    ),
    "source": (
        "[rcl_x.c",
        "[[rcl_x.c]",
        "x/component.yaml:11:11: error: 'sources' must list files. Write `x.c`",
    ),
    "source key": ("when:", "if:", "x/component.yaml:11:20: error: 'sources' must list files"),
    "source value": ("mtu: 512", "mtu: 0.5", "x/component.yaml:11:20: error: 'sources' must list files"),
    "asks": ("asks: [", "asks: x #", "x/component.yaml:12:7: error: 'asks' must be a list"),
    "ask": ("capability: lock", "lock: 1", "x/component.yaml:12:14: error: 'asks' must list capabilities"),
    "provides": (
        "provides: {",
        "provides: [] #",
        "x/component.yaml:13:11: error: 'provides' must be a mapping",
    ),
    "provision": ("sources: [rcl_w.c], ", "", "x/component.yaml:13:18: error: missing key 'sources'"),
    "provision key": ("always", "alway", "x/component.yaml:13:53: error: unknown key 'alway'"),
    "xrce": (
        "[read, w",
        "[reed, w",
        "x/component.yaml:6:8: error: unknown value 'reed' in 'xrce'. Did you mean 'read'",
    ),
    "submessage": ("[DATA]", "[DATUM]", "x/component.yaml:8:12: error: unknown value 'DATUM' in 'receives'"),
    "object": (
        "[datareader]",
        "[reader]",
        "x/component.yaml:9:11: error: unknown value 'reader' in 'objects'",
    ),
    "number": ("needs: []", "needs: [3]", "x/component.yaml:5:9: error: 'needs' must list names"),
    "text": ("An example", "[a]", "x/component.yaml:2:10: error: 'summary' must be a text"),
    "need": (
        "needs: []",
        "needs: [y]",
        "microros-gen: error: the component 'x' needs the unknown component 'y'",
    ),
    "folder": ("component: x", "component: y", "microros-gen: error: 'x/component.yaml' describes 'y'"),
    "empty": (GOOD, "", "microros-gen: error: the component file 'x/component.yaml' is empty"),
    "not a mapping": (
        GOOD,
        "- a\n",
        "x/component.yaml:1:1: error: a component file must be a mapping of keys",
    ),
}


@pytest.mark.parametrize("case", ERRORS)
def test_a_faulty_component_is_refused(case: str, tmp_path: Path) -> None:
    before, after, reported = ERRORS[case]
    assert before in GOOD
    text = GOOD.replace(before, after, 1)
    write(tmp_path, "x", text.replace("}}]", "}}}", 1) if case == "sources" else text)
    with pytest.raises(UserError) as caught:
        load_catalogue(tmp_path)
    lines = [without_id(d.headline()) for d in caught.value.diagnostics]
    assert any(line.startswith(reported) for line in lines), lines


def test_every_axis_value_has_its_component(real_catalogue: Catalogue, middleware: Middleware) -> None:
    for axis in middleware.axes.values():
        for value in axis.values.values():
            assert value.component is None or value.component in real_catalogue


def test_the_eleven_components_are_there(real_catalogue: Catalogue) -> None:
    assert set(MICRO_ROS_COMPONENTS) <= set(real_catalogue)


def test_files_of_components_are_there(real_catalogue: Catalogue) -> None:
    for component in real_catalogue.values():
        folder = component.folder
        if component.ready:
            assert any(path.is_file() for path in folder.glob("*/**/*")), component.name
        else:
            assert not component.sources, component.name
        for source in component.files:
            assert (folder / "src" / source.path).is_file(), f"{component.name}: {source.path}"
        for variant in component.contributes.variants:
            assert (folder / "variants" / variant.file).is_file(), f"{component.name}: {variant.file}"
        for replacement in component.contributes.replaces:
            assert (folder / "include" / replacement.header).is_file(), (
                f"{component.name}: {replacement.header}"
            )
        for path in conditions(component):
            assert is_of_the_plan(path, real_catalogue), f"{component.name}: {path}"


def conditions(component: Component) -> Iterator[str]:
    """Yield the paths of all conditions of a component."""
    parts: list[SourceFile | Ask | Conditional] = [
        *component.sources,
        *component.asks,
        *contributed_parts(component),
    ]
    for provision in component.provides:
        parts += [*provision.sources, *provision.asks]
    yield from (path for part in parts for path, _ in part.when)


def contributed_parts(component: Component) -> Iterator[Conditional]:
    """Yield everything that a component contributes."""
    for field in fields(component.contributes):
        yield from getattr(component.contributes, field.name)


def is_of_the_plan(path: str, catalogue: Catalogue) -> bool:
    """Whether a condition names a value of a slice of the plan, of the board or of the target."""
    first, _, name = path.partition(".")
    if first == "component":
        return (components_folder() / name / "component.yaml").is_file()
    feature = feature_of(catalogue[first]) if first in catalogue else None
    if feature is not None:
        parts = [value for value in vars(feature).values() if isinstance(value, type)]
        return any(name in {*dir(part), *getattr(part, "__annotations__", {})} for part in parts)
    others = {"board": BoardPlan, "target": Target}
    if first in others:
        return name in {*dir(others[first]), *(field.name for field in fields(others[first]))}
    try:
        value = attrgetter(path)(POOL)
    except AttributeError:
        return False
    return isinstance(value, (str, int, tuple))


@pytest.mark.parametrize(
    "path", ["on_full", "streams", "streams.when_full", "board.on_full", "entities.clients"]
)
def test_a_condition_names_one_value(path: str, real_catalogue: Catalogue) -> None:
    assert not is_of_the_plan(path, real_catalogue)


def test_no_two_components_have_the_same_public_header(real_catalogue: Catalogue) -> None:
    headers = [header for component in real_catalogue.values() for header in component.headers]
    assert sorted(headers) == sorted(set(headers))


def test_needs_have_no_cycle(real_catalogue: Catalogue) -> None:
    done: set[str] = set()

    def walk(name: str, path: tuple[str, ...]) -> None:
        assert name not in path, f"{' → '.join((*path, name))}"
        if name not in done:
            for need in real_catalogue[name].needs:
                walk(need, (*path, name))
            done.add(name)

    for name in real_catalogue:
        walk(name, ())


def test_each_pool_is_of_a_component() -> None:
    """Those of streams and of the bytes of queues are checked where the plan has their sizes."""
    keys = set(load_schema(APPLICATION_SCHEMA)["properties"]["pools"]["properties"])
    owned = {key for component in load_catalogue().values() for key in component.pools}
    assert keys - owned == {"history", "input_history", "best_effort_history", "slot_size", "queue_bytes"}
    assert owned - keys == set()
