# SPDX-License-Identifier: Apache-2.0
"""Renders the files of components: templates with the plan and with what the components contribute."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from jinja2 import Environment

from microros_gen.client.plan.runtime import WAITED_KINDS
from microros_gen.client.plan.values import Values
from microros_gen.client.views.contributions import contributed
from microros_gen.documents.own_templates import render_own
from microros_gen.records import dataclass
from microros_gen.selection.component_sources import ComponentFile


@dataclass(frozen=True)
class _Waits:
    """Kinds that one can wait for: those whose functions are `present`, and those that a wait set has no type of."""

    present: tuple[str, ...]
    absent: tuple[str, ...]


def _waits(headers: tuple[str, ...]) -> _Waits:
    present = tuple(kind for kind in WAITED_KINDS if f"rcl/{kind}.h" in headers)
    return _Waits(present, tuple(kind for kind in WAITED_KINDS if kind not in present))


def render_components(
    files: Iterable[ComponentFile],
    values: Values,
    environment: Environment,
    functions: tuple[str, ...] = (),
) -> dict[str, bytes]:
    """Return the bytes of `files` by path below the output folder.

    `functions` are those that the application defines.
    """
    components = [c.component for c in values.selection.components]
    headers = tuple(sorted(h for c in components for h in c.headers))
    context = {
        "plan": values.runtime,
        "selection": values.selection,
        "target": values.target,
        "board": values.board,
        "headers": headers,
        "waits": _waits(headers),
        "functions": functions,
        "contributed": contributed(components, values),
    }
    return {
        file.path: file.content if file.template is None else _rendered(file, environment, context).encode()
        for file in files
    }


def _rendered(file: ComponentFile, environment: Environment, context: Mapping[str, object]) -> str:
    """Render a template by its name, or from the text of one that does not ship with the tool."""
    if file.template:
        return environment.get_template(file.template).render(context)
    return render_own(file.source, environment, context)
