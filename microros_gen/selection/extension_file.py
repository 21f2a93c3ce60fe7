# SPDX-License-Identifier: Apache-2.0
"""Reads a component that does not ship with the tool, and checks what tests check of those that do."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from microros_gen.application.kinds import KIND, NAMES
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import child, items, span_of, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode, parse_yaml
from microros_gen.interfaces.closure import split_type_name
from microros_gen.selection.component import Component
from microros_gen.selection.component_file import parse_component
from microros_gen.selection.extension import Extension, digest_of, own_name
from microros_gen.selection.find_components import COMPONENT_FILE
from microros_gen.selection.presence import EXAMPLE_FILE, EXAMPLE_POINTS

SCHEMA = Path(__file__).with_name("component.schema.json")


def read_outside(
    extension: Extension, folder: Path, capabilities: Iterable[str], diagnostics: Diagnostics
) -> Component | None:
    """Read the component in `folder`; `capabilities` are those that it can ask the platform for.

    None and errors in `diagnostics` where it does not hold.
    """
    path = folder / COMPONENT_FILE
    found = Diagnostics()
    try:
        source = Source(str(path), read_text(path))
        digest = digest_of(folder)
    except (OSError, UnicodeDecodeError) as error:
        diagnostics.error(f"cannot read '{path}': {reason_of(error)}", extension.span, id="MG-4062")
        return None
    tree = parse_yaml(source, found)
    if not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    component = None if found.has_errors() else parse_component(source, found)
    if component is not None and isinstance(tree, MappingNode):
        _check(component, folder, tree, tuple(capabilities), found)
    diagnostics.extend(found)
    if component is None or found.has_errors():
        return None
    return replace(component, folder=folder, origin=extension.origin, digest=digest)


def check_needs(component: Component, known: Iterable[str], diagnostics: Diagnostics) -> None:
    """Report each component that `component` needs and nobody has."""
    path = component.folder / COMPONENT_FILE
    names = tuple(known)
    tree = parse_yaml(Source(str(path), read_text(path)), Diagnostics())
    for span, name in _texts(child(tree, "needs")):
        if name not in names:
            message = f"the component '{component.name}' needs the unknown component '{name}'"
            diagnostics.error(message, span, nearest(name, names), id="MG-4063")


def _check(
    component: Component,
    folder: Path,
    tree: MappingNode,
    capabilities: tuple[str, ...],
    diagnostics: Diagnostics,
) -> None:
    if component.name != own_name(folder):
        message = f"the folder of the component '{component.name}' is named '{own_name(folder)}'"
        hint = f"Write `component: {own_name(folder)}`, or rename the folder"
        diagnostics.error(message, span_of(tree.get("component")), hint, id="MG-4064")
    if component.layer == "port" or component.provides:
        key = "provides" if component.provides else "layer"
        hint = "Name its folder in the target file: `os: ./folder`"
        diagnostics.error("a part of a platform is not a component", _span(tree, key), hint, id="MG-4065")
    for span, name in _texts(tree.get("asks"), "capability"):
        if name not in capabilities:
            hint = nearest(name, capabilities) or f"Known: {', '.join(capabilities)}"
            diagnostics.error(f"unknown capability '{name}'", span, hint, id="MG-4066")
    if "common" in tree.entries:
        hint = "Remove it: it says which templates of the tool's own components are compiled ahead"
        diagnostics.error("`common` is for built-in components", _span(tree, "common"), hint, id="MG-9875")
    _check_files(tree, folder, diagnostics)
    for item in items(tree.get("implies")):
        _check_type(item, diagnostics)


def _check_files(tree: MappingNode, folder: Path, diagnostics: Diagnostics) -> None:
    if "example" in tree.entries and not is_file(folder / EXAMPLE_FILE):
        hint = f"Add it, or remove `example`: its macros are {', '.join(EXAMPLE_POINTS)}"
        diagnostics.error(f"missing file '{EXAMPLE_FILE}'", _span(tree, "example"), hint, id="MG-4048")
    src, include = folder / "src", folder / "include"

    def is_source(name: str) -> bool:
        return is_file(src / name)

    variants = {text_of(child(item, "header")) for item in items(tree.get("variants"))}

    def is_header(name: str) -> bool:
        return name in variants or is_file(include / name) or is_file(include / f"{name}.j2")

    checks: tuple[tuple[str, str, Callable[[str], bool]], ...] = (
        ("sources", "src", is_source),
        ("headers", "include", is_header),
    )
    for key, place, is_there in checks:
        for span, name in _texts(tree.get(key), "file"):
            if name.startswith("/") or ".." in Path(name).parts:
                hint = f"Name a file below {place}/"
                diagnostics.error(f"'{name}' is outside the component's {place}/", span, hint, id="MG-4067")
            elif not is_there(name):
                diagnostics.error(
                    f"missing file '{place}/{name}'", span, "Add it, or remove its name", id="MG-4068"
                )


def _check_type(item: YamlNode, diagnostics: Diagnostics) -> None:
    kind = next((kind for kind in NAMES if child(item, kind) is not None), None)
    node = child(item, "type")
    if node is None or kind is None:
        return
    default = KIND[kind].type_kind
    if split_type_name(text_of(node) or "", default) is None:
        message = f"'{text_of(node)}' is not a type"
        diagnostics.error(message, node.span, f"Write `package/{default}/Name`", id="MG-4069")


def _texts(node: YamlNode | None, key: str = "") -> Iterator[tuple[Span, str]]:
    """Yield the items of a list, texts or mappings that have one as `key`, each with its place."""
    for item in items(node):
        value = child(item, key) if key and isinstance(item, MappingNode) else item
        text = text_of(value)
        if value is not None and text is not None:
            yield value.span, text


def _span(tree: MappingNode, key: str) -> Span | None:
    entry = tree.entries.get(key)
    return entry.key_span if entry is not None else None
