# SPDX-License-Identifier: Apache-2.0
"""Checks the rules of `limits:`: what they name must be there, and a number must be possible."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.interfaces.types import (
    FieldType,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.size import is_fixed

LARGEST_LIMIT = 0x7FFFFFFF
"""Elements or characters: what a CDR length (uint32) and `int` can both hold."""


class RuleChecker:
    """Finds rules that cannot hold: unknown types and members, numbers above a bound or without meaning."""

    def __init__(self, messages: Mapping[TypeName, Message], diagnostics: Diagnostics) -> None:
        self._messages = {str(name): message for name, message in messages.items()}
        self._diagnostics = diagnostics

    def check(self, rules: Iterable[LimitRule], root: TypeName | None = None) -> None:
        """Check `rules`; paths of an entity's own limits start at its `root`."""
        for rule in rules:
            path = absolute_path(rule.path, root)
            self._check_range(rule)
            if path == ("*",):
                continue
            if path[0] not in self._messages:
                self._unknown_type(rule, path[0])
                continue
            field_type = self._follow(rule, path)
            if field_type is not None:
                self._check_field(rule, path, field_type)

    def _unknown_type(self, rule: LimitRule, name: str) -> None:
        parts = [part for part in (f"{name}_Request", f"{name}_Response") if part in self._messages]
        suggestion = f"Limits are those of {' and '.join(parts)}" if parts else nearest(name, self._messages)
        self._diagnostics.warning(
            f"the limit for '{name}' has no effect: the type is not used", rule.span, suggestion, id="MG-5001"
        )

    def _check_range(self, rule: LimitRule) -> None:
        for kind, value in (("string", rule.string), ("sequence", rule.sequence)):
            if value is not None and not 0 <= value <= LARGEST_LIMIT:
                self._diagnostics.error(
                    f"a {kind} limit of {value} is out of range",
                    rule.span,
                    f"Write 0 to {LARGEST_LIMIT}",
                    id="MG-5002",
                )

    def _follow(self, rule: LimitRule, path: tuple[str, ...]) -> FieldType | None:
        """Return the type of the field that `path` ends at; None for a bare type or an unknown member."""
        message = self._messages[path[0]]
        found: FieldType | None = None
        for name in path[1:]:
            if found is not None:
                element = element_of(found)
                if not isinstance(element, NamedType):
                    self._diagnostics.error(
                        f"'{'.'.join(path)}': a primitive has no members",
                        rule.span,
                        "Remove it",
                        id="MG-5003",
                    )
                    return None
                message = self._messages[str(element.name)]
            field = next((f for f in message.fields if f.name == name), None)
            if field is None:
                suggestion = nearest(name, (f.name for f in message.fields))
                self._diagnostics.error(
                    f"{message.name} has no member '{name}'", rule.span, suggestion, id="MG-5004"
                )
                return None
            found = field.type
        return found

    def _check_field(self, rule: LimitRule, path: tuple[str, ...], field_type: FieldType) -> None:
        element = element_of(field_type)
        where = ".".join(path)
        if isinstance(element, NamedType):
            self._check_below(rule, where, field_type, element.name)
            return
        is_sequence = isinstance(field_type, SequenceType)
        is_string = isinstance(element, StringType)
        if not is_sequence and not is_string:
            self._diagnostics.error(
                f"{where} has a fixed size; it takes no limit", rule.span, "Remove it", id="MG-5005"
            )
        elif rule.single and is_sequence and is_string:
            self._diagnostics.error(
                f"one number for {where} is ambiguous: it is a sequence of strings",
                rule.span,
                f"Write `{{sequence: {rule.sequence}}}` for its elements, or `{{string: {rule.sequence}}}`"
                " for their bytes",
                id="MG-5006",
            )
        else:
            self._check_kind(rule, where, "sequence", is_sequence, rule.sequence, bound_of(field_type))
            self._check_kind(rule, where, "string", is_string, rule.string, bound_of(element))

    def _check_kind(
        self, rule: LimitRule, where: str, kind: str, fits: bool, value: int | None, bound: int | None
    ) -> None:
        if value is None or (rule.single and not fits):
            return
        if not fits:
            self._diagnostics.error(f"{where} is not a {kind}", rule.span, f"Remove '{kind}'", id="MG-5007")
        elif bound is not None and value > bound:
            self._diagnostics.error(
                f"the limit {value} for {where} is above its bound {bound}",
                rule.span,
                f"Write at most {bound}",
                id="MG-5008",
            )

    def _check_below(self, rule: LimitRule, where: str, field_type: FieldType, name: TypeName) -> None:
        if not isinstance(field_type, SequenceType):
            if is_fixed(self._messages[str(name)], {m.name: m for m in self._messages.values()}):
                self._diagnostics.error(
                    f"{where} has a fixed size; it takes no limit", rule.span, "Remove it", id="MG-5009"
                )
            return
        self._check_kind(rule, where, "sequence", True, rule.sequence, field_type.bound)


def bound_of(field_type: FieldType) -> int | None:
    """Return the bound of a sequence or string in the interface file, None where it has none."""
    return field_type.bound if isinstance(field_type, (SequenceType, StringType)) else None


def is_count(path: tuple[str, ...], messages: Mapping[TypeName, Message]) -> bool:
    """Return whether `path`, its type first, ends at a sequence of messages: one number there counts them."""
    message = next((m for m in messages.values() if str(m.name) == path[0]), None)
    found: FieldType | None = None
    for name in path[1:]:
        field = next((f for f in message.fields if f.name == name), None) if message is not None else None
        if field is None:
            return False
        found = field.type
        element = element_of(found)
        message = messages[element.name] if isinstance(element, NamedType) else None
    return isinstance(found, SequenceType) and message is not None


def absolute_path(path: tuple[str, ...], root: TypeName | None) -> tuple[str, ...]:
    """Return `path` with its type first; the own limits of an entity may start at a member."""
    if root is None or path == ("*",) or (path and "/" in path[0]):
        return path
    return (str(root), *path)
