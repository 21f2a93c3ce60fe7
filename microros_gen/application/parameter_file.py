# SPDX-License-Identifier: Apache-2.0
"""A file of generate_parameter_library → declarations of parameters.

https://github.com/PickNikRobotics/generate_parameter_library describes the format. What a device does not check is an
error at its place, so that no file is accepted with less than it says.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from microros_gen.application.model import ParameterDecl
from microros_gen.application.parameter_hints import library_declaration, library_type, library_type_of
from microros_gen.application.parameter_maps import MAP, Maps, is_group, name_of
from microros_gen.application.parameter_validation import check_rules, with_rule
from microros_gen.application.parameters import Places, check_declaration, value_of
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest, reads
from microros_gen.documents.tree_values import bool_of, child, entries, items, span_of, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, YamlNode, parse_yaml

_TYPES: Mapping[str, str] = {
    "bool": "bool",
    "int": "integer",
    "double": "double",
    "string": "string",
    "bool_array": "bool[]",
    "int_array": "integer[]",
    "double_array": "double[]",
    "string_array": "string[]",
}
_ONLY_DOCUMENTED = "none"
_FIXED = re.compile(r"(string|(?:bool|int|double|string)_array)_fixed_([0-9]{1,6})")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_FIRST_VALUES: Mapping[str, str] = {"bool": "false", "integer": "0", "double": "0.0", "string": '""'}
_READ: tuple[tuple[str, str, Callable[[YamlNode], object]], ...] = (
    ("description", "a text", text_of),
    ("additional_constraints", "a text", text_of),
    ("read_only", "true or false", bool_of),
)
_KEYS = ("type", "default_value", "description", "read_only", "validation", "additional_constraints")


@reads
def parse_parameter_file(source: Source, diagnostics: Diagnostics) -> tuple[ParameterDecl, ...]:
    """Return what the file declares, in its order; groups are names with dots."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    roots = entries(tree)
    declared: tuple[ParameterDecl, ...] = ()
    if not found.has_errors() and _has_one_group(roots, span_of(tree) or Span(source, 1, 1), found):
        declared = tuple(_group(roots[0].value, "", Maps.of(roots[0].value), found))
    diagnostics.extend(found)
    return () if found.has_errors() else declared


def _has_one_group(roots: tuple[Entry, ...], span: Span, diagnostics: Diagnostics) -> bool:
    """Return whether a file has one key with the parameters below it; report at `span` that it has not."""
    hint = "Write `motor: {gain: {type: double, default_value: 0.5}}`"
    if any(isinstance(root.value, MappingNode) and not is_group(root) for root in roots):
        span, hint = roots[0].key_span, "Write `motor:` above them, and indent them"
    elif len(roots) > 1:
        span, hint = roots[1].key_span, f"Move `{roots[1].key}:` to the parameter file of another node"
    elif roots and isinstance(roots[0].value, MappingNode):
        return True
    message = "a file of generate_parameter_library has one key, with the parameters below it"
    diagnostics.error(message, span, hint, id="MG-3064")
    return False


def _group(node: YamlNode, prefix: str, maps: Maps, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
    for entry in entries(node):
        name = f"{prefix}{entry.key}"
        if entry.key.startswith(MAP) and is_group(entry):
            within = maps.within(prefix)
            for index, value in enumerate(within.values(entry, diagnostics)):
                # What is wrong below is wrong for each value: it is reported once.
                found = Diagnostics() if index else diagnostics
                yield from _group(entry.value, f"{prefix}{value}.", within, found)
        elif not _NAME.fullmatch(entry.key) or entry.key.startswith(MAP):
            message = f"'{entry.key}' is no name of a parameter"
            hint = f"Write {name_of(entry.key.removeprefix(MAP))}: letters, digits and underscores"
            diagnostics.error(message, entry.key_span, hint, id="MG-3065")
        elif text_of(child(entry.value, "type")) is not None:
            yield from _leaf(entry, name, maps, diagnostics)
        elif is_group(entry) and _default_without_type(entry) is None:
            yield from _group(entry.value, f"{name}.", maps, diagnostics)
        else:
            default = _default_without_type(entry)
            hint = f"Write {library_declaration(entry.key, entry.value)}"
            hint = hint if default is None else f"Add `type: {library_type_of(default)}`"
            diagnostics.error(f"'{name}' has no type", entry.key_span, hint, id="MG-3066")


def _default_without_type(entry: Entry) -> YamlNode | None:
    """Return the default of an entry that is a parameter without a type; None: it is none."""
    default = child(entry.value, "default_value")
    return None if isinstance(default, MappingNode) else default


def _leaf(entry: Entry, name: str, maps: Maps, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
    node = entry.value
    _check_keys(node, diagnostics)
    kind_node, default = child(node, "type"), child(node, "default_value")
    type_text = text_of(kind_node) or ""
    fixed = _FIXED.fullmatch(type_text)
    kind = _TYPES.get(fixed.group(1) if fixed else type_text)
    if type_text == _ONLY_DOCUMENTED:
        return
    if kind is None:
        meant = library_type(type_text)
        hint = f"Available: {', '.join(_TYPES)}, with _fixed_8 behind strings and arrays"
        hint = f"Write type: {meant}" if meant not in (None, type_text) else hint
        message = f"the type '{type_text}' of '{name}' is not supported"
        diagnostics.error(message, span_of(kind_node), hint, id="MG-3067")
        return
    if default is None:
        if child(node, "default") is not None:
            return  # reported: the key has another name
        message = f"'{name}' has no default_value, and nothing sets parameters when a device starts"
        hint = f"Add `default_value: {_FIRST_VALUES.get(kind, '[]')}`"
        diagnostics.error(message, entry.key_span, hint, id="MG-3068")
        return
    parameter = ParameterDecl(
        name=name,
        type=kind,
        default=value_of(default),
        description=text_of(child(node, "description")) or "",
        read_only=bool_of(child(node, "read_only")) or name in maps.lists,
        span=entry.key_span,
        size=int(fixed.group(2)) if fixed else None,
        constraints=text_of(child(node, "additional_constraints")) or "",
    )
    validation = child(node, "validation")
    for rule in entries(validation):
        parameter = with_rule(parameter, rule, diagnostics)
    if parameter.is_array and not parameter.size and parameter.read_only:
        # Nothing changes it.
        default_size = len(parameter.default) if isinstance(parameter.default, tuple) else 0
        parameter = replace(parameter, size=max(default_size, 1))
    if parameter.is_array and not parameter.size:
        message = f"the array '{name}' has no largest size"
        hint = f"Write type: {type_text.partition('_fixed_')[0]}_fixed_8, or validation: {{size_lt<>: [9]}}"
        diagnostics.error(message, entry.key_span, hint, id="MG-3069")
        return
    bounds = span_of(validation) if parameter.minimum is not None else None
    choices = items(child(validation, "one_of<>"))
    before = len(tuple(diagnostics))
    places = Places(default, bounds, choices[0] if choices else None, library=True)
    check_declaration(parameter, places, diagnostics)
    if len(tuple(diagnostics)) == before and default is not None and parameter.default is not None:
        what = f"the default of the parameter '{parameter.name}'"
        check_rules(parameter, parameter.default, default.span, what, diagnostics)
    yield parameter


def _check_keys(node: YamlNode, diagnostics: Diagnostics) -> None:
    for entry in entries(node):
        if entry.key not in _KEYS:
            known = nearest(entry.key, _KEYS)
            hint = known or f"Remove it; available: {', '.join(_KEYS)}"
            message = f"'{entry.key}' of a parameter is not supported"
            diagnostics.error(message, entry.key_span, hint, id="MG-3070")
    for key, kind, read in _READ:
        value = child(node, key)
        if value is not None and read(value) is None:
            shown = value.text if isinstance(value, ScalarNode) else "…"
            hint = f'Put it into quotes: "{shown}"' if read is text_of else f"Write true, or remove `{key}`"
            diagnostics.error(f"this value must be {kind}: '{key}'", value.span, hint, id="MG-3075")
    validation = child(node, "validation")
    if validation is not None and not isinstance(validation, MappingNode):
        message = "'validation' must be a mapping of rules"
        diagnostics.error(message, validation.span, "Write {bounds<>: [0, 10]}", id="MG-3074")
