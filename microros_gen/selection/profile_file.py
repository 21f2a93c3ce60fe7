# SPDX-License-Identifier: Apache-2.0
"""Profile files and the middleware table → model."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from microros_gen.application.model import NodeDecl, component_change
from microros_gen.application.modes import check_modes
from microros_gen.application.nodes import parse_nodes
from microros_gen.application.parser import SCHEMA as APPLICATION_SCHEMA
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.tree_read import check_keys, expect_mapping, read_choice, read_names, read_text
from microros_gen.documents.tree_values import bool_of, int_of
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml
from microros_gen.selection.component import Axis, AxisValue, Middleware, Profile, XrceProfile
from microros_gen.selection.xrce import MICRO_ROS_COMPONENTS, SUBMESSAGES, XRCE_PROFILES

SCHEMA = Path(__file__).with_name("profile.schema.json")
AXES = {
    "entities": ("preconfigured", "reference", "xml", "binary"),
    "transport": ("udp", "tcp", "serial", "canfd", "custom"),
    "liveliness": ("ping", "acknack", "none"),
    "logging": ("console", "callback", "rosout", "ring"),
    "clock": ("steady", "ros"),
}
"""Axis → its values, as both schemas and the middleware table have them."""

_PROFILE_KEYS = ("profile", "summary", "order", "extends", "components", *AXES, "nodes")
_Part = TypeVar("_Part", bound=Any)
_AXIS_VALUE_KEYS = ("component", "xrce", "agent", "allows")


@reads
def parse_profile(source: Source, diagnostics: Diagnostics, builtin: bool = False) -> Profile | None:
    """Return the profile that `source` describes, or None with errors in `diagnostics`.

    A user's file is validated against its JSON Schema; `builtin` files are not, tests do that.
    """
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not builtin and not found.has_errors():
        from microros_gen.documents.schema import load_schema, validate

        validate(tree, source, load_schema(SCHEMA, APPLICATION_SCHEMA), found)
    node = expect_mapping(tree, "a profile file", found) if builtin else tree
    if not found.has_errors() and isinstance(node, MappingNode):
        profile = _profile(node, Span(source, 1, 1), found, builtin)
    diagnostics.extend(found)
    return None if found.has_errors() or not isinstance(node, MappingNode) else profile


def _profile(node: MappingNode, start: Span, diagnostics: Diagnostics, builtin: bool) -> Profile:
    check_keys(node, _PROFILE_KEYS, ("profile",), diagnostics)
    changes = read_names(node, "components", diagnostics)
    axes = {axis: read_choice(node, axis, values, diagnostics) for axis, values in AXES.items()}
    chosen = {axis: value for axis, value in axes.items() if value is not None}
    named = node.entries.get("profile")
    return Profile(
        name=read_text(node, "profile", diagnostics),
        summary=read_text(node, "summary", diagnostics),
        extends=read_names(node, "extends", diagnostics),
        components=tuple(component_change(c.name, c.span) for c in changes),
        axes=MappingProxyType(chosen),
        builtin=builtin,
        span=named.value.span if named else start,
        nodes=_nodes(node, diagnostics, builtin),
        order=int_of(node.get("order")),
    )


def _nodes(node: MappingNode, diagnostics: Diagnostics, builtin: bool) -> tuple[NodeDecl, ...] | None:
    """Return the nodes of the example; None where the profile says nothing of them.

    Those of a built-in profile have no places, since it is no file of the user's.
    """
    if "nodes" not in node.entries:
        return None
    nodes = parse_nodes(node.get("nodes"), diagnostics)
    for declared in nodes:
        if declared.parameter_file is not None:
            diagnostics.error(
                "a node of a profile reads no parameter file",
                declared.parameter_file.span,
                "Write the parameters below `declare`",
                id="MG-4094",
            )
        else:
            check_modes(declared, diagnostics)
    return tuple(_without_places(declared) for declared in nodes) if builtin else nodes


def _without_places(part: _Part) -> _Part:
    """Return a declaration whose places, and those of its parts, are None."""
    changed: dict[str, Any] = {}
    for field in fields(part):
        value = getattr(part, field.name)
        if isinstance(value, Span):
            changed[field.name] = None
        elif isinstance(value, tuple):
            changed[field.name] = tuple(_without_places(v) if is_dataclass(v) else v for v in value)
        elif is_dataclass(value):
            changed[field.name] = _without_places(value)
    return replace(part, **changed)


@reads
def parse_middleware(source: Source, diagnostics: Diagnostics) -> Middleware | None:
    """Return the middleware table, or None with errors in `diagnostics`."""
    node = expect_mapping(parse_yaml(source, diagnostics), "the middleware table", diagnostics)
    if node is None:
        return None
    keys = ("components", "xrce_profiles", "axes")
    check_keys(node, keys, keys, diagnostics)
    components, profiles, axes = (expect_mapping(node.get(k), f"'{k}'", diagnostics) for k in keys)
    if components is None or profiles is None or axes is None:
        return None
    check_keys(components, MICRO_ROS_COMPONENTS, (), diagnostics)
    check_keys(profiles, XRCE_PROFILES, XRCE_PROFILES, diagnostics)
    check_keys(axes, tuple(AXES), tuple(AXES), diagnostics)
    needs = {e.key: _names(components, e.key, diagnostics, XRCE_PROFILES) for e in components}
    return Middleware(
        MappingProxyType(needs),
        MappingProxyType({e.key: _xrce_profile(profiles, e.key, diagnostics) for e in profiles}),
        MappingProxyType({axis: _axis(axes, axis, diagnostics) for axis in AXES}),
    )


def _xrce_profile(profiles: MappingNode, name: str, diagnostics: Diagnostics) -> XrceProfile:
    node = expect_mapping(profiles.get(name), f"'{name}'", diagnostics)
    if node is None:
        return XrceProfile(name, "")
    check_keys(node, ("summary", "all_but", "only"), ("summary",), diagnostics)
    names = tuple(SUBMESSAGES)
    allowed = set(_names(node, "only", diagnostics, names))
    if "all_but" in node.entries:
        allowed = set(names) - set(_names(node, "all_but", diagnostics, names))
    return XrceProfile(name, read_text(node, "summary", diagnostics), frozenset(allowed))


def _axis(axes: MappingNode, axis: str, diagnostics: Diagnostics) -> Axis:
    node = expect_mapping(axes.get(axis), f"'{axis}'", diagnostics)
    if node is None:
        return Axis({}, "")
    check_keys(node, ("several", "default", "values"), ("default", "values"), diagnostics)
    values = expect_mapping(node.get("values"), "'values'", diagnostics)
    default = read_choice(node, "default", AXES[axis], diagnostics)
    found: dict[str, AxisValue] = {}
    for entry in values or ():
        value = expect_mapping(entry.value, f"'{entry.key}'", diagnostics)
        if value is None:
            continue
        check_keys(value, _AXIS_VALUE_KEYS, (), diagnostics)
        found[entry.key] = AxisValue(
            axis,
            entry.key,
            read_text(value, "component", diagnostics) or None,
            _names(value, "xrce", diagnostics, XRCE_PROFILES),
            _names(value, "agent", diagnostics, XRCE_PROFILES),
            _names(value, "allows", diagnostics, tuple(SUBMESSAGES)),
        )
    several = bool_of(node.get("several")) is True
    return Axis(MappingProxyType(found), default.name if default else "", several)


def _names(node: MappingNode, key: str, diagnostics: Diagnostics, known: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(name.name for name in read_names(node, key, diagnostics, known))
