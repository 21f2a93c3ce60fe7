# SPDX-License-Identifier: Apache-2.0
"""The profile's example application: its names, which members of each message it fills, and with what."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from microros_gen.interfaces.types import (
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import snake_case
from microros_gen.typesupport.plan.size import TypeLimits

_TIME = TypeName("builtin_interfaces", "msg", "Time")
# Enough to see every part of an Imu move, and still readable for a message of a hundred members.
_MOST_VALUES = 16


@dataclass(frozen=True)
class MemberValue:
    """A member path (`linear_acceleration.x`) and the C expression or text that it gets."""

    member: str
    value: str


@dataclass(frozen=True)
class Filling:
    """What the example writes into one message: time stamps, numbers from its counter, texts.

    `elements` are the sequences that get one element, whose texts are in `element_texts`.
    """

    stamps: tuple[str, ...]
    values: tuple[MemberValue, ...]
    texts: tuple[MemberValue, ...]
    elements: tuple[str, ...] = ()
    element_texts: tuple[MemberValue, ...] = ()


@dataclass(frozen=True)
class Shown:
    """What the example prints of a message that it received: a format and an argument, where {message} is its name."""

    format: str
    expression: str


def example_node(project: str) -> str:
    """Return the name of the example's node where the application file declares none."""
    return project.replace("+", "_")


def example_topics(roots: Sequence[TypeName]) -> tuple[tuple[TypeName, str], ...]:
    """Return a topic for each of `roots`, by which the example without `nodes:` publishes it."""
    topics = [snake_case(root.name) for root in roots]
    return tuple(
        (root, topic if topics.count(topic) == 1 else f"{root.package}/{topic}")
        for root, topic in zip(roots, topics, strict=True)
    )


def plan_filling(
    message: Message, messages: Mapping[TypeName, Message], text: str, limits: TypeLimits | None
) -> Filling:
    """Fill every plain member of `message` without its own default; arrays and sequences of plain ones stay.

    A message that would be empty, but for a header, gets an element with texts in each sequence of messages that has
    room for one. A string gets as much of `text` as its limit has room for; one whose type has a lower bound stays
    empty.
    """
    members = tuple(_plain_members(message, messages, ""))
    stamps = tuple(path for path, field in members if field.type == NamedType(_TIME))
    numbers = [(path, f.type) for path, f in members if isinstance(f.type, Primitive)]
    values = tuple(MemberValue(path, _expression(kind)) for path, kind in numbers[:_MOST_VALUES])
    texts = tuple(_texts(message, messages, text, limits))
    elements, element_texts = list[str](), list[MemberValue]()
    is_empty = not values and all("." in text.member for text in texts)
    for field, own in zip(message.fields, limits.fields if limits and is_empty else (), strict=False):
        kind = field.type.element if isinstance(field.type, SequenceType) else None
        if isinstance(kind, NamedType) and own is not None and own.sequence and own.nested:
            found = tuple(_texts(messages[kind.name], messages, text, own.nested))
            elements += [field.name] if found else []
            element_texts += [MemberValue(f"{field.name}.data[0].{t.member}", t.value) for t in found]
    return Filling(stamps, values, texts, tuple(elements), tuple(element_texts))


def _texts(
    message: Message, messages: Mapping[TypeName, Message], text: str, limits: TypeLimits | None
) -> Iterator[MemberValue]:
    for path, field in _plain_members(message, messages, ""):
        kind = field.type
        if isinstance(kind, StringType) and not kind.wide and (kind.bound is None or kind.bound >= len(text)):
            yield MemberValue(path, text[: _string_limit(message, messages, limits, path)])


def _string_limit(
    message: Message, messages: Mapping[TypeName, Message], limits: TypeLimits | None, path: str
) -> int | None:
    """Return how many characters the string at `path` holds; None: nothing limits it."""
    name, _, rest = path.partition(".")
    index, field = next((i, f) for i, f in enumerate(message.fields) if f.name == name)
    own = limits.fields[index] if limits is not None else None
    if isinstance(field.type, NamedType):
        return _string_limit(messages[field.type.name], messages, own.nested if own else None, rest)
    bound = field.type.bound if isinstance(field.type, StringType) else None
    return bound if own is None or own.string is None else own.string


def plan_shown(message: Message, messages: Mapping[TypeName, Message]) -> Shown | None:
    """Return the first number or text of `message` as printf takes it; None: it has neither."""
    for path, field in _plain_members(message, messages, "", with_default=True):
        if field.type == NamedType(_TIME):
            return Shown("%d.%09u s", f"(int){{message}}.{path}.sec, (unsigned){{message}}.{path}.nanosec")
        if isinstance(field.type, StringType) and not field.type.wide:
            return Shown("%s", f"{{message}}.{path}.data")
        if isinstance(field.type, Primitive):
            real = field.type in (Primitive.FLOAT32, Primitive.FLOAT64)
            return Shown("%g" if real else "%lld", f"({'double' if real else 'long long'}){{message}}.{path}")
    return None


def _plain_members(
    message: Message, messages: Mapping[TypeName, Message], prefix: str, *, with_default: bool = False
) -> Iterator[tuple[str, Field]]:
    for field in message.fields:
        path = f"{prefix}{field.name}"
        if field.default is not None and not with_default:
            continue
        if isinstance(field.type, NamedType) and field.type.name != _TIME:
            yield from _plain_members(
                messages[field.type.name], messages, f"{path}.", with_default=with_default
            )
        elif isinstance(field.type, (Primitive, StringType, NamedType)):
            yield path, field


def _expression(kind: Primitive) -> str:
    if kind is Primitive.BOOL:
        return "(count % 2u) == 1u"
    if kind is Primitive.FLOAT32:
        return "0.1f * (float)count"
    if kind is Primitive.FLOAT64:
        return "0.1 * (double)count"
    return "count" if kind is Primitive.UINT32 else f"({kind.c_type})count"
