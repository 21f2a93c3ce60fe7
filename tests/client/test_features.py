# SPDX-License-Identifier: Apache-2.0
"""A component that ships with the tool plans something for itself: its slice, the plan id, paths that begin with it."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import pytest

import microros_gen.components
from microros_gen import compiler
from microros_gen.client.plan.features import feature_of
from microros_gen.compiler import pipeline
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.selection.component_file import parse_component
from microros_gen.selection.find_components import load_catalogue
from tests.support.outside import write_files

COMPONENT = """\
component: gauge
summary: "Made up: plans a separate table"
layer: middleware
status: ready
needs: [publish, executor]
sources: [{file: gauge.c.j2, when: {gauge.any: true}}]
example: {handles: gauge.places}
manifest: {table: gauge.table, places: gauge.places}
reports: [{name: gauge, value: "{gauge.places} places", why: "{streams.mtu} bytes a datagram"}]
size: {"gauge_rows[]": "row {}"}
"""
PLAN = """\
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Gauge:
    places: int
    table: tuple
    any: bool = True


def plan(given, diagnostics):
    places = len(given.application.nodes) + 3
    if places > 5:
        diagnostics.error("too many places", given.application.spans.get("nodes"), id="MG-0000")
    return Gauge(places, tuple((node.name, given.runtime.session.id) for node in given.application.nodes))


def record(part):
    return [part.places, part.table]
"""
EXAMPLE = "{% macro executor() %}\n  /* {{ feature.places }} for {{ selection.name }} */\n{% endmacro %}\n"
GAUGE = {
    "component.yaml": COMPONENT,
    "plan.py": PLAN,
    "example.c.j2": EXAMPLE,
    "src/gauge.c.j2": "int gauge_rows[{{ plan.features.of('gauge').places }}];\n",
}
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+gauge]
session: {key: 1}
"""


@pytest.fixture
def made_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Add a component with a plan.py to those that ship."""
    folder = write_files(tmp_path / "components" / "gauge", GAUGE)
    diagnostics = Diagnostics()
    gauge = parse_component(Source("gauge/component.yaml", COMPONENT), diagnostics)
    diagnostics.check()
    assert gauge is not None
    catalogue = MappingProxyType({**load_catalogue(), "gauge": replace(gauge, folder=folder)})
    monkeypatch.setattr(pipeline, "load_catalogue", lambda: catalogue)
    monkeypatch.setattr(microros_gen.components, "__path__", [str(folder.parent)])
    yield tmp_path
    for name in [name for name in sys.modules if name.startswith("microros_gen.components.gauge")]:
        del sys.modules[name]


def planned(folder: Path, nodes: int) -> compiler.Planned:
    names = "".join(
        f"  - {{name: n{i}, publishers: [{{topic: t{i}, type: std_msgs/msg/Int32}}]}}\n" for i in range(nodes)
    )
    config = folder / "microros.yaml"
    config.write_text(f"{APPLICATION}nodes:\n{names}")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def test_its_slice_is_seen_by_conditions_templates_and_the_manifest(made_up: Path) -> None:
    result = planned(made_up, 1)
    files = compiler.render(result)
    assert files["src/gauge/gauge.c"] == b"int gauge_rows[4];\n"
    example = files[result.project.example].decode()
    assert "  /* 4 for pure_sender */\n" in example
    assert "rclc_executor_init(&executor, &support.context, 4, allocator)" in example
    feature = json.loads(files["manifest.json"])["features"]["gauge"]
    assert feature == {
        "values": {"places": 4, "table": [["n0", 0x81]]},
        "size": {"gauge_rows[]": "row {}"},
    }


def test_its_record_changes_the_plan_id(made_up: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = planned(made_up, 1).project.runtime
    assert json.loads(first.features.records["gauge"]) == [4, [["n0", 0x81]]]
    module = sys.modules["microros_gen.components.gauge.plan"]
    monkeypatch.setattr(module, "record", lambda part: "another layout")
    assert planned(made_up, 1).project.runtime.plan_id != first.plan_id


def test_what_it_refuses_is_reported_with_the_rest(made_up: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(made_up, 3)
    assert [d.message for d in caught.value.diagnostics] == ["too many places"]


def test_nothing_from_outside_is_imported(made_up: Path) -> None:
    gauge = planned(made_up, 1).resolved.catalogue["gauge"]
    assert feature_of(gauge) is not None
    assert feature_of(replace(gauge, origin="folder gauge")) is None
