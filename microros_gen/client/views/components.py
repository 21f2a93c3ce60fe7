# SPDX-License-Identifier: Apache-2.0
"""Renders the files of components: templates with the plan and with what the components contribute."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from jinja2 import Environment

from microros_gen.client.plan.runtime import WAITED_KINDS
from microros_gen.client.plan.values import Values
from microros_gen.client.views.contributions import contributed
from microros_gen.client.views.init_options import init_options
from microros_gen.documents.own_templates import render_own
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.component_sources import ComponentFile


@dataclass(frozen=True)
class _Waits:
    """Kinds that one can wait for: those whose functions are `present`, and those that a wait set has no type of."""

    present: tuple[str, ...]
    absent: tuple[str, ...]


_RCL = (
    "client error_handling graph guard_condition init init_options node publisher service subscription time timer"
    " wait"
)
_RCLC = "action_client action_server client init node publisher service sleep subscription timer types"
_GATHERED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"rcl/rcl.h": tuple(_RCL.split()), "rclc/rclc.h": tuple(_RCLC.split())}
)
"""What ROS 2's umbrella headers include, of their folders."""
_UMBRELLA = "rmw_microros/rmw_microros.h"
"""Includes every selected header of its folder."""


def umbrellas(headers: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """Return what each umbrella header includes of the selected `headers`."""
    found = {
        umbrella: tuple(h for name in names if (h := f"{umbrella.partition('/')[0]}/{name}.h") in headers)
        for umbrella, names in _GATHERED.items()
    }
    folder = _UMBRELLA.partition("/")[0]
    return found | {_UMBRELLA: tuple(h for h in headers if h.startswith(f"{folder}/") and h != _UMBRELLA)}


def _waits(headers: tuple[str, ...]) -> _Waits:
    present = tuple(kind for kind in WAITED_KINDS if f"rcl/{kind}.h" in headers)
    return _Waits(present, tuple(kind for kind in WAITED_KINDS if kind not in present))


def render_components(
    files: Iterable[ComponentFile],
    values: Values,
    environment: Environment,
    functions: tuple[str, ...] = (),
    unselected: Iterable[Component] = (),
) -> dict[str, bytes]:
    """Return the bytes of `files` by path below the output folder.

    `functions` are those that the application defines; `unselected` are the components that it could select.
    """
    components = [c.component for c in values.selection.components]
    headers = tuple(sorted(h for c in components for h in c.headers))
    context = {
        "plan": values.runtime,
        "selection": values.selection,
        "target": values.target,
        "board": values.board,
        "headers": headers,
        "umbrellas": umbrellas(headers),
        "waits": _waits(headers),
        "functions": functions,
        "contributed": contributed(components, values),
        "init_options": init_options(components, unselected, values),
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
