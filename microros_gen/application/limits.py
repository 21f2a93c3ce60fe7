# SPDX-License-Identifier: Apache-2.0
"""`limits:` → rules. The longest path from the declared root wins, then the type, then `*`."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.model import LimitRule
from microros_gen.documents.tree_values import entries, int_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, YamlNode

_CAPACITIES = ("string", "sequence")


def application_limits(node: YamlNode | None) -> tuple[LimitRule, ...]:
    """Return the rules of the application's `limits:`, in the order of the file."""
    return tuple(rule for entry in entries(node) for rule in _rules((entry.key,), entry))


def endpoint_limits(node: YamlNode | None, type_name: str) -> tuple[LimitRule, ...]:
    """Return the rules of an endpoint's own `limits:`, with paths below its type.

    `string` and `sequence` there become a rule for `*`.
    """
    if not isinstance(node, MappingNode):
        return ()
    own = _capacities(("*",), node, None)
    fields = (rule for entry in _fields(node) for rule in _rules((type_name, entry.key), entry))
    return (*own, *fields)


def _rules(path: tuple[str, ...], entry: Entry) -> Iterator[LimitRule]:
    number = int_of(entry.value)
    if number is not None and len(path) > 1:
        yield LimitRule(path, number, number, entry.key_span, single=True)
    if isinstance(entry.value, MappingNode):
        yield from _capacities(path, entry.value, entry)
        for field in _fields(entry.value):
            yield from _rules((*path, field.key), field)


def _capacities(path: tuple[str, ...], node: MappingNode, owner: Entry | None) -> Iterator[LimitRule]:
    found = {key: int_of(node.get(key)) for key in _CAPACITIES}
    if any(value is not None for value in found.values()):
        span = owner.key_span if owner else node.span
        yield LimitRule(path, found["string"], found["sequence"], span)


def _fields(node: MappingNode) -> Iterator[Entry]:
    """Yield entries that are fields; one called `string` or `sequence` is a field where it has a mapping."""
    for entry in node:
        if entry.key not in _CAPACITIES or isinstance(entry.value, MappingNode):
            yield entry
