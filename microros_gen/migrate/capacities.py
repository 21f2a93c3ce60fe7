# SPDX-License-Identifier: Apache-2.0
"""What sources say of capacities: of members that get buffers, and of texts that are put there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from microros_gen.diagnostics import Span
from microros_gen.interfaces.types import TypeName
from microros_gen.migrate.c_program import (
    Assignment,
    Call,
    CFile,
    Function,
    Tokens,
    matching,
    split_arguments,
)
from microros_gen.migrate.c_tokens import Token
from microros_gen.migrate.c_values import TypeSupport, Unknown, Values, handle_of
from microros_gen.records import dataclass

_TYPE = re.compile(r"([a-z]\w*?)__(msg|srv|action)__([A-Z]\w*?)")
_MEMORY_CALLS = (
    "micro_ros_utilities_create_message_memory",
    "micro_ros_utilities_create_static_message_memory",
)
_TEXT_CALLS = ("micro_ros_string_utilities_set", "rosidl_runtime_c__String__assign")
_CONF = ("max_string_capacity", "max_ros2_type_sequence_capacity", "max_basic_type_sequence_capacity")
_CONF_DEFAULTS = (20, 5, 5)


@dataclass(frozen=True)
class Capacity:
    """What a member of a message type can hold: `parts` as C names them, without the last `.capacity`.

    `terminated`: of a string the number counts its terminator.
    """

    type: TypeName
    parts: tuple[str, ...]
    number: int
    span: Span
    terminated: bool = True


@dataclass(frozen=True)
class MemoryRules:
    """What micro_ros_utilities is told for a type: `defaults` are for strings, sequences of messages, and others."""

    type: TypeName
    defaults: tuple[int, int, int]
    rules: tuple[tuple[str, int], ...]
    span: Span


Fact = Capacity | MemoryRules


def find_capacities(files: Iterable[CFile], calls: Sequence[Call], values: Values) -> list[Fact]:
    """Return every capacity whose message type and number are known, in the order of the sources."""
    files = tuple(files)
    variables = {name: kind for file in files for name, kind in _variables(file.text.tokens)}
    found: list[Fact] = []
    for file in files:
        for assignment in file.assignments:
            call = _at(assignment)
            found += _assigned(assignment, variables, call, values)
            found += _initialized(assignment, variables, call, values)
    for call in calls:
        found += _text(call, variables, values)
        found += _memory(call, variables, values)
    return found


def _at(assignment: Assignment) -> Call:
    """Return a place for names to be looked up from, as a call has it."""
    outside = Function("", frozenset(), 0, 0, assignment.span)
    token = Token("name", "", assignment.span.source, assignment.span.line, assignment.span.column)
    return Call("", (), assignment.function or outside, assignment.index, token)


def _variables(tokens: Sequence[Token]) -> Iterator[tuple[str, TypeName]]:
    """Yield variables, parameters and members of message types."""
    for index, token in enumerate(tokens[:-1]):
        match = _TYPE.fullmatch(token.text) if token.kind == "name" else None
        if not match or token.text.endswith("__Sequence"):
            continue
        after = index + 1
        while after < len(tokens) - 1 and tokens[after].text in ("*", "const", "&"):
            after += 1
        if (
            tokens[after].kind == "name"
            and tokens[after + 1 if after + 1 < len(tokens) else after].text != "("
        ):
            yield tokens[after].text, TypeName(match[1], match[2], match[3])


def _typed(target: str, variables: Mapping[str, TypeName]) -> tuple[TypeName, tuple[str, ...]] | None:
    """Return the type of the variable in `a.b.c` that is a message, and the parts after it."""
    parts = target.split(".")
    for index, part in enumerate(parts):
        name = part.removesuffix("[]")
        if name in variables:
            return variables[name], tuple(parts[index + 1 :])
    return None


def _assigned(
    assignment: Assignment, variables: Mapping[str, TypeName], call: Call, values: Values
) -> Iterator[Capacity]:
    """Yield `message.member.capacity = N` and `message.member = micro_ros_string_utilities_init…(…)`."""
    typed = _typed(assignment.target, variables)
    if typed is None or not typed[1]:
        return
    kind, parts = typed
    value = assignment.value
    if parts[-1] == "capacity":
        number = values.number(value, call)
        if isinstance(number, int):
            yield Capacity(kind, parts[:-1], number, assignment.span)
    elif len(value) > 2 and value[0].text.startswith("micro_ros_string_utilities_init"):
        size = _size_of_new_string(value, call, values)
        if size is not None:
            yield Capacity(kind, parts, size, assignment.span, terminated=False)


def _size_of_new_string(value: Tokens, call: Call, values: Values) -> int | None:
    if value[0].text.endswith("_with_size"):
        number = values.number(value[2:-1], call)
        return number if isinstance(number, int) else None
    text = values.text(value[2:-1], call)
    return len(text.encode()) if isinstance(text, str) else None


def _initialized(
    assignment: Assignment, variables: Mapping[str, TypeName], call: Call, values: Values
) -> Iterator[Capacity]:
    """Yield what `message = {.member = {buffer, 0, N}}` says."""
    name = assignment.target.removesuffix("[]")
    if name in variables and assignment.value[:1] and assignment.value[0].text == "{":
        yield from _members(variables[name], (), assignment.value, call, values)


def _members(
    kind: TypeName, parts: tuple[str, ...], value: Tokens, call: Call, values: Values
) -> Iterator[Capacity]:
    entries = split_arguments(value[1 : matching(value).get(0, len(value))])
    if len(entries) == 3 and parts and all(entry and entry[0].text != "." for entry in entries):
        number = values.number(entries[2], call)
        if isinstance(number, int):
            yield Capacity(kind, parts, number, value[0].span)
        return
    for entry in entries:
        if len(entry) > 3 and entry[0].text == "." and entry[2].text == "=" and entry[3].text == "{":
            yield from _members(kind, (*parts, entry[1].text), entry[3:], call, values)


def _text(call: Call, variables: Mapping[str, TypeName], values: Values) -> Iterator[Capacity]:
    """Yield the length of a text that is put into a string."""
    if call.name in _TEXT_CALLS and len(call.arguments) == 2:
        typed = _typed(handle_of(call.arguments[0]), variables)
        text = values.text(call.arguments[1], call)
        if typed and typed[1] and isinstance(text, str):
            yield Capacity(typed[0], typed[1], len(text.encode()), call.span, terminated=False)


def _memory(call: Call, variables: Mapping[str, TypeName], values: Values) -> Iterator[MemoryRules]:
    """Yield what micro_ros_utilities is told."""
    if call.name not in _MEMORY_CALLS or len(call.arguments) < 3:
        return
    support = values.type_support(call.arguments[0], call)
    conf = handle_of(call.arguments[2])
    kind = variables.get(handle_of(call.arguments[1]))
    if isinstance(support, TypeSupport):
        kind = TypeName(support.package, support.kind, support.name)
    if kind is None or not conf:
        return
    defaults = list(_CONF_DEFAULTS)
    rules: tuple[tuple[str, int], ...] = ()
    for change in values.changes(conf, call):
        member = change.target.removeprefix(f"{conf}.")
        if member in _CONF:
            number = values.number(change.value, call)
            if isinstance(number, int) and number:  # 0 is the default
                defaults[_CONF.index(member)] = number
        elif member == "rules":
            rules = tuple(_rules(change, call, values))
    yield MemoryRules(kind, (defaults[0], defaults[1], defaults[2]), rules, call.span)


def _rules(change: Assignment, call: Call, values: Values) -> Iterator[tuple[str, int]]:
    table = values.before(handle_of(change.value), call)
    tokens = table.value if table else ()
    for entry in split_arguments(tokens[1 : matching(tokens).get(0, len(tokens))]) if tokens else ():
        pair = split_arguments(entry[1 : matching(entry).get(0, len(entry))])
        if len(pair) == 2:
            path, size = values.text(pair[0], call), values.number(pair[1], call)
            if not isinstance(path, Unknown) and not isinstance(size, Unknown):
                yield path, size
