# SPDX-License-Identifier: Apache-2.0
"""What a model file can say of a node besides its modes: `contingencies` and `diagnostics`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.named import Named
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.tree_values import items, text_of
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode
from microros_gen.modes.model import ERROR_LEVEL, STALE_LEVEL, WARN_LEVEL, DiagnosticLevels, is_named

LEVELS = (WARN_LEVEL, ERROR_LEVEL, STALE_LEVEL)


def parse_contingencies(
    body: MappingNode, part: str, modes: tuple[str, ...], diagnostics: Diagnostics
) -> tuple[str, ...]:
    """Return the modes that a node changes to by itself; names of no mode are reported and left out."""
    found: list[str] = []
    for item in _listed(body.get("contingencies"), "contingencies", "[SAFE]", diagnostics):
        name = text_of(item) or ""
        if name in modes:
            found.append(name)
            continue
        hint = nearest(name, modes) or f"Known: {', '.join(modes)}"
        diagnostics.error(
            f"'contingencies' of '{part}': unknown mode '{name}'", item.span, hint, id="MG-8881"
        )
    return tuple(dict.fromkeys(found))


def parse_levels(
    body: MappingNode, part: str, published: tuple[str, ...] | None, diagnostics: Diagnostics
) -> DiagnosticLevels:
    """Return which levels of /diagnostics are errors of a node; ERROR always is one.

    `published` are the names of its statuses, None: they are not known.
    """
    node = expect_mapping(body.get("diagnostics"), f"'diagnostics' of '{part}'", diagnostics)
    if node is None:
        return DiagnosticLevels()
    levels, names = parse_levels_and_names(node, part, diagnostics)
    check_published(part, names, published, diagnostics)
    found = tuple(level for level in LEVELS if level in (ERROR_LEVEL, *levels))
    return DiagnosticLevels(found, tuple(named.name for named in names))


def parse_levels_and_names(
    node: MappingNode, owner: str, diagnostics: Diagnostics, others: tuple[str, ...] = ()
) -> tuple[tuple[str, ...], tuple[Named, ...]]:
    """Return `level` and `names` of the diagnostics of a node or rule; what is wrong with them is reported.

    `others` are keys that can be there, too.
    """
    check_keys(node, ("level", "names", *others), ("level",), diagnostics)
    levels = tuple(_texts(node, "level", owner, "warn, or [warn, stale]", diagnostics))
    for level in levels:
        if level.name not in LEVELS:
            hint = nearest(level.name, LEVELS) or f"Known: {', '.join(LEVELS)}"
            message = f"unknown level '{level.name}' of the diagnostics of '{owner}'"
            diagnostics.error(message, level.span, hint, id="MG-8882")
    names = tuple(_texts(node, "names", owner, "[battery]", diagnostics))
    for i, named in enumerate(names):
        check_pattern(named, diagnostics)
        _check_repeated(
            named, (*names[:i], *(n for n in names[i + 1 :] if n.name != named.name)), diagnostics
        )
    for i, level in enumerate(levels):
        _check_repeated(level, levels[:i], diagnostics)
    return tuple(level.name for level in levels if level.name in LEVELS), names


def check_pattern(named: Named, diagnostics: Diagnostics) -> None:
    """Report a `*` that is not the last character."""
    if "*" in named.name[:-1]:
        message = f"'{named.name}' has a '*' that is not at its end"
        hint = f"Write '{named.name.partition('*')[0]}*', or the whole name"
        diagnostics.error(message, named.span, hint, id="MG-9830")


def check_published(
    owner: str, names: Sequence[Named], published: tuple[str, ...] | None, diagnostics: Diagnostics
) -> None:
    """Report names of statuses that a node does not publish; `published` None: it is not known what it publishes."""
    prefix = f"{owner}:"
    for named in names:
        name = named.name.lstrip("/")
        message = f"nothing publishes the status '{named.name}' of '{owner}'"
        if name.startswith(prefix):
            message += ": its own name is left out here"
            hint = f"Write '{name.removeprefix(prefix).strip() or '*'}'"
        elif published is None or any(is_named(each, (named.name,)) for each in published):
            continue
        else:
            hint = nearest(named.name, published) or f"Known: {', '.join(published)}"
        diagnostics.error(message, named.span, hint, id="MG-9832")


def _check_repeated(own: Named, others: Sequence[Named], diagnostics: Diagnostics) -> None:
    """Report a name that is the same as another one, or that a pattern among them matches."""
    other = next((other for other in others if is_named(own.name, (other.name,))), None)
    if other is not None:
        is_same = other.name == own.name
        message = f"'{own.name}' is listed twice" if is_same else f"'{own.name}' is among '{other.name}'"
        diagnostics.error(message, own.span, "Remove it", id="MG-9831")


def _texts(
    node: MappingNode, key: str, owner: str, example: str, diagnostics: Diagnostics
) -> Iterator[Named]:
    """Yield the texts of a key with their places; a list without any is an error."""
    value = node.get(key)
    if isinstance(value, SequenceNode) and not value.items:
        message = f"'{key}' of the diagnostics of '{owner}' is empty"
        diagnostics.error(message, value.span, f"Write {key}: {example}", id="MG-9833")
    for item in _listed(value, key, example, diagnostics):
        yield Named(text_of(item) or "", item.span)


def _listed(node: YamlNode | None, key: str, example: str, diagnostics: Diagnostics) -> Iterator[YamlNode]:
    """Yield the texts of a list, or the only one."""
    if isinstance(node, ScalarNode) and text_of(node) is not None:
        yield node
    elif isinstance(node, SequenceNode) and all(text_of(item) is not None for item in node.items):
        yield from items(node)
    elif node is not None:
        message = f"'{key}' must be a text, or a list of texts"
        diagnostics.error(message, node.span, f"Write {key}: {example}", id="MG-8883")
