# SPDX-License-Identifier: Apache-2.0
"""A model file of the package system_modes → Model."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.documents.files import read_text, reason_of
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.yaml_tree import parse_yaml
from microros_gen.modes.hierarchy import check_start_order, find_parents
from microros_gen.modes.leaflets import check_twins
from microros_gen.modes.model import DEFAULT, Mode, Model, Part
from microros_gen.modes.node_keys import parse_contingencies, parse_levels
from microros_gen.modes.outline import PARAMETERS, Outline, parse_outlines
from microros_gen.modes.part_names import parse_parts
from microros_gen.modes.rule_diagnostics import check_rules
from microros_gen.modes.statuses import Subject
from microros_gen.modes.systems import parse_system
from microros_gen.modes.templates import check_templates
from microros_gen.modes.values import inherit, parse_values

NO_LEAFLETS: Mapping[str, Part] = MappingProxyType({})


def read_model(path: Path) -> Model:
    """Return the model of a file. Raises UserError with all that is wrong with it."""
    diagnostics = Diagnostics()
    source = read_source(path, diagnostics)
    model = parse_model(source, diagnostics) if source is not None else None
    diagnostics.check()
    assert model is not None
    return model


def read_source(path: Path, diagnostics: Diagnostics) -> Source | None:
    """Return the text of a model file or a script, named as the user wrote it; None: it was reported."""
    try:
        return Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        reason = reason_of(error) if isinstance(error, OSError) else "it is not UTF-8 text"
        hint = "Give the path of a YAML file"
        diagnostics.error(f"cannot read '{path}': {reason}", hint=hint, id="MG-8801")
        return None


@reads
def parse_model(
    source: Source, diagnostics: Diagnostics, leaflets: Mapping[str, Part] = NO_LEAFLETS
) -> Model | None:
    """Return the model that `source` describes; None where `diagnostics` got errors from it.

    `leaflets` are nodes that have their modes in application files: they are parts as if the file had them.

    Every mistake is reported in one run, in the order of the lines.
    """
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if tree is None and not found.has_errors():
        found.error(f"'{source.name}' has no parts", hint="Write at least one node", id="MG-8802")
    mapping = expect_mapping(tree, "a model file", found)
    outlines, unreadable = (
        parse_outlines(mapping, found, leaflets) if mapping is not None else ({}, frozenset[str]())
    )
    subjects = {name: Subject(name, False, tuple(part.modes)) for name, part in leaflets.items()}
    subjects |= {name: o.subject for name, o in outlines.items() if o.modes or name not in leaflets}
    lists = {o.name: parse_parts(o, subjects, unreadable, found) for o in outlines.values() if o.is_system}
    parents = find_parents({name: listed.parts for name, listed in lists.items()}, found)
    has_structure = not found.has_errors()
    parts = {
        name: parse_system(outline, lists[name], subjects, found)
        if outline.is_system
        else _node(outline, leaflets.get(name), found)
        for name, outline in outlines.items()
    }
    check_twins(parts, leaflets, found)
    model = Model(source, {**leaflets, **parts}, parents)
    for system in parts.values():
        check_start_order(system, found)
        check_rules(system, model.parts, found)
    if has_structure:
        check_templates(model, found)
    diagnostics.extend(sorted(found, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0)))
    return None if found.has_errors() else model


def _node(outline: Outline, leaflet: Part | None, diagnostics: Diagnostics) -> Part:
    """Return a node; what its application file says of it counts as well."""
    is_here = leaflet is None or "modes" in outline.body.entries
    modes = _node_modes(outline, diagnostics) if is_here or leaflet is None else dict(leaflet.modes)
    own = parse_contingencies(outline.body, outline.name, tuple(modes), diagnostics)
    contingencies = dict.fromkeys((*own, *(leaflet.contingencies if leaflet else ())))
    published = leaflet.published if leaflet else None
    return Part(
        outline.name,
        False,
        outline.span,
        modes,
        contingencies=tuple(contingencies),
        diagnostics=parse_levels(outline.body, outline.name, published, diagnostics),
        published=published,
    )


def _node_modes(outline: Outline, diagnostics: Diagnostics) -> dict[str, Mode]:
    found: dict[str, Mode] = {}
    default = outline.modes.get(DEFAULT)
    for entry in ([default] if default else []) + [e for e in outline.modes.values() if e is not default]:
        mode = expect_mapping(entry.value, f"the mode '{entry.key}'", diagnostics)
        if mode is not None:
            check_keys(mode, (PARAMETERS,), (PARAMETERS,), diagnostics)
            expect_mapping(mode.get(PARAMETERS), f"'{PARAMETERS}' of '{entry.key}'", diagnostics)
        own = parse_values(mode.get(PARAMETERS) if mode else None, diagnostics)
        base = found[DEFAULT].parameters if DEFAULT in found else None
        values = inherit(entry.key, own, base, diagnostics)
        found[entry.key] = Mode(entry.key, entry.key_span, values)
    return {name: found[name] for name in outline.modes}
