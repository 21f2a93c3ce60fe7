# SPDX-License-Identifier: Apache-2.0
"""Reads the components that ship with the tool: one folder each, described by its `component.yaml`.

Parts of a platform (layer `port`) are below platform/<kind>/, the component `port_<name>` in the folder `<name>`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, nearest
from microros_gen.documents.files import read_text
from microros_gen.documents.shipped import COMPONENTS
from microros_gen.selection.component import Catalogue, Component
from microros_gen.selection.component_file import parse_component

COMPONENT_FILE = "component.yaml"
BOARD_FILE = "board.yaml"
_FUNCTION = re.compile(
    r"(?:\b|#define )((?:rclc?|rmw|rcutils|rosidl|micro_ros|uxr)_\w+)(?=\(| \w+$)", re.MULTILINE
)

_ANY_FUNCTION = re.compile(
    r"^(?!typedef\b|return\b)(?:#define |[A-Za-z_][\w *]*?\b)([A-Za-z_]\w*)\(", re.MULTILINE
)
"""A declaration in the first column, or a macro with arguments: names from outside have no common prefix."""
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|\{#.*?#\}", re.DOTALL)


def components_folder() -> Path:
    """Return the folder of the components that ship with the tool."""
    return COMPONENTS


def parts_folder() -> Path:
    """Return the folder of the parts of platforms that ship with the tool: `<kind>/<name>/` each."""
    return Path(__file__).resolve().parent.parent / "platform"


def part_files(kind: str) -> tuple[str, ...]:
    """Return the files of which a part of a platform has at least one: a board has functions, facts, or both."""
    return (COMPONENT_FILE, BOARD_FILE) if kind == "board" else (COMPONENT_FILE,)


def load_catalogue(folder: Path | None = None) -> Catalogue:
    """Return every component below `folder` (the tool's own unless given) by name, in the order of the names.

    Raises UserError with all that is wrong: an unreadable or faulty file, a component that is not named as
    its folder, and a `needs` that names no component.
    """
    root = components_folder() if folder is None else folder
    parts = parts_folder() if folder is None else root
    diagnostics = Diagnostics()
    found: dict[str, Component] = {}
    for path in sorted(root.glob(f"*/{COMPONENT_FILE}")):
        component = _read(path, root, diagnostics)
        if component is not None:
            found[component.name] = component
    for path in sorted(parts.glob(f"*/*/{COMPONENT_FILE}")):
        component = _read(path, parts, diagnostics, "port_")
        if component is not None:
            found[component.name] = component
    found = dict(sorted(found.items()))
    for component in found.values():
        _check_needs(component, found, diagnostics)
    diagnostics.check()
    return MappingProxyType(found)


def declared_functions(catalogue: Catalogue) -> Mapping[str, str]:
    """Return which ready component declares each function of the C API, from the public headers below its include/ and
    its `init_options`.

    Of a component from outside these are all functions and macros of its public headers.
    """
    found: dict[str, str] = {}
    for component in catalogue.values():
        folder = component.folder / "include"
        for header in _public_headers(component) if component.ready else ():
            path = folder / header
            path = path if path.exists() else path.with_name(f"{path.name}.j2")
            if path.exists():
                for name in (_ANY_FUNCTION if component.origin else _FUNCTION).findall(
                    _COMMENT.sub("", read_text(path))
                ):
                    found.setdefault(name, component.name)
        for option in component.contributes.init_options if component.ready else ():
            found.setdefault(option.function, component.name)
    return MappingProxyType(found)


def _public_headers(component: Component) -> tuple[str, ...]:
    """Return the headers that applications include, and those that such a header includes for this component."""
    included = component.contributes.includes
    return (*component.headers, *(i.header for i in included if not i.into.startswith("microros/")))


def _read(path: Path, root: Path, diagnostics: Diagnostics, prefix: str = "") -> Component | None:
    shown = path.relative_to(root).as_posix()
    try:
        source = Source(shown, read_text(path))
    except (OSError, UnicodeDecodeError) as fault:
        diagnostics.error(f"cannot read the component file '{shown}': {fault}", id="MG-4011")
        return None
    component = parse_component(source, diagnostics)
    if component is not None and component.name != f"{prefix}{path.parent.name}":
        diagnostics.error(
            f"'{shown}' describes '{component.name}'",
            None,
            "Give the folder the name of the component",
            id="MG-4012",
        )
        return None
    return component and replace(component, folder=path.parent)


def _check_needs(component: Component, found: dict[str, Component], diagnostics: Diagnostics) -> None:
    for name in component.needs:
        if name not in found:
            message = f"the component '{component.name}' needs the unknown component '{name}'"
            diagnostics.error(message, None, nearest(name, found), id="MG-4013")
