# SPDX-License-Identifier: Apache-2.0
"""Renders the example application, with the parts that the selected components add to it."""

from __future__ import annotations

from dataclasses import replace

from jinja2 import Environment

from microros_gen.client.plan.project import Project
from microros_gen.client.plan.values import Values
from microros_gen.client.views.example import ExampleView, example_view
from microros_gen.documents.own_templates import render_macros
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.component_sources import template_name
from microros_gen.selection.presence import EXAMPLE_FILE, EXAMPLE_POINTS, ExamplePart


@dataclass(frozen=True)
class _Parts:
    """The C of all components at each point; empty where none has any."""

    variables: str = ""
    init: str = ""
    executor: str = ""
    fini: str = ""
    functions: str = ""
    turn: str = ""


def render_example(project: Project, environment: Environment, heading: str = "") -> bytes:
    """Return examples/<profile>/main.c; `heading` replaces the first sentence of its comment.

    Raises UserError with the line of a component's template that is wrong.
    """
    values = project.values
    found = [
        (chosen.component, part)
        for chosen in project.selection.components
        for part in chosen.component.presence.example
        if values.holds(part.when)
    ]
    includes = tuple(include for _, part in found for include in part.includes)
    handles = sum(_handles(part, values) for _, part in found)
    view = example_view(project, includes, handles, has_parts=bool(found))
    view = replace(view, heading=heading) if heading else view
    parts = _joined([_rendered(component, values, view, environment) for component, _ in found])
    return environment.get_template("example/main.c.j2").render(view=view, parts=parts).encode()


def _handles(part: ExamplePart, values: Values) -> int:
    number = values.value(part.handles) if isinstance(part.handles, str) else part.handles
    return number if isinstance(number, int) else 0


def _rendered(
    component: Component, values: Values, view: ExampleView, environment: Environment
) -> dict[str, str]:
    path = component.folder / EXAMPLE_FILE
    context = {
        "view": view,
        "plan": values.runtime,
        "feature": values.runtime.features.of(component.name),
        "selection": values.selection,
        "target": values.target,
        "board": values.board,
    }
    return render_macros(path, template_name(path), environment, context, EXAMPLE_POINTS)


def _joined(texts: list[dict[str, str]]) -> _Parts:
    return _Parts(**{point: "".join(text.get(point, "") for text in texts) for point in EXAMPLE_POINTS})
