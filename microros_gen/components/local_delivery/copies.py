# SPDX-License-Identifier: Apache-2.0
"""C functions that copy a message into another one's memory: its numbers, strings and sequences, without CDR.

Unlike `__copy` of rosidl, a copy never takes memory: what has no room is refused. A string without data is empty, as it
is for the encoder.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Field,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.names import c_name
from microros_gen.typesupport.plan.size import is_fixed, members

Messages = Mapping[TypeName, Message]
_FAIL = ("    return false;", "  }")


def copy_lines(roots: Iterable[TypeName], messages: Messages) -> tuple[str, ...]:
    """Return the functions that copy the variable types among `roots`, those of their parts first, as lines of C."""
    done: dict[TypeName, tuple[str, ...]] = {}
    for root in roots:
        _add(root, messages, done)
    return tuple(line for lines in done.values() for line in lines)


def put_body(name: TypeName, messages: Messages, slot: str) -> tuple[str, ...]:
    """Return the statements that copy `message`, a pointer to void, to a slot, and return whether there was room."""
    if not is_fixed(messages[name], messages):
        return (f"  return {_function(name)}(message, &{slot});",)
    return (f"  const {c_name(name)} * from = message;", "", f"  {slot} = *from;", "  return true;")


def get_body(name: TypeName, messages: Messages, slot: str) -> tuple[str, ...]:
    """Return the statements that copy a slot to `message`, a pointer to void, and return whether there was room."""
    if not is_fixed(messages[name], messages):
        return (f"  return {_function(name)}(&{slot}, message);",)
    return (f"  {c_name(name)} * to = message;", "", f"  *to = {slot};", "  return true;")


def _function(name: TypeName) -> str:
    return f"local_copy_{c_name(name)}"


def _add(name: TypeName, messages: Messages, done: dict[TypeName, tuple[str, ...]]) -> None:
    if name in done or is_fixed(messages[name], messages):
        return
    fields = tuple(members(messages[name]))
    for field in fields:
        element = element_of(field.type)
        if isinstance(element, NamedType):
            _add(element.name, messages, done)
    type_ = c_name(name)
    done[name] = (
        "",
        f"static bool {_function(name)}(const {type_} * from, {type_} * to)",
        "{",
        *(line for field in fields for line in _field(field, messages)),
        "  return true;",
        "}",
    )


def _field(field: Field, messages: Messages) -> Iterator[str]:
    source, target = f"from->{field.name}", f"to->{field.name}"
    element = element_of(field.type)
    varies = _varies(element, messages)
    if isinstance(field.type, SequenceType):
        yield f"  if ({source}.size > {target}.capacity) {{"
        yield from _FAIL
        if varies:
            yield from _each(element, f"{source}.size", f"{source}.data", f"{target}.data")
        else:
            yield f"  if ({source}.size != 0u) {{"
            yield "    /* at most MICROROS_LOCAL_ROOM bytes */"
            yield f"    (void)memcpy({target}.data, {source}.data, {source}.size * sizeof(*{target}.data));"
            yield "  }"
        yield f"  {target}.size = {source}.size;"
    elif isinstance(field.type, ArrayType):
        if varies:
            yield from _each(element, f"{field.type.size}u", source, target)
        else:
            yield f"  (void)memcpy({target}, {source}, sizeof({target}));"
    elif varies:
        yield f"  if (!{_call(element, source, target)}) {{"
        yield from _FAIL
    else:
        yield f"  {target} = {source};"


def _varies(element: ElementType, messages: Messages) -> bool:
    if isinstance(element, NamedType):
        return not is_fixed(messages[element.name], messages)
    return isinstance(element, StringType)


def _each(element: ElementType, count: str, source: str, target: str) -> Iterator[str]:
    if not count[0].isdigit():
        yield "  /* at most MICROROS_LOCAL_ELEMENTS rounds */"
    yield f"  for (size_t i = 0; i < {count}; ++i) {{"
    yield f"    if (!{_call(element, f'{source}[i]', f'{target}[i]')}) {{"
    yield "      return false;"
    yield "    }"
    yield "  }"


def _call(element: ElementType, source: str, target: str) -> str:
    if isinstance(element, StringType):
        function = "rmw_local_copy_wide" if element.wide else "rmw_local_copy_text"
    else:
        assert isinstance(element, NamedType), element
        function = _function(element.name)
    return f"{function}(&{source}, &{target})"
