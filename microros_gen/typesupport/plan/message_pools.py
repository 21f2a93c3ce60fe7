# SPDX-License-Identifier: Apache-2.0
"""Storage of messages that are sent: blocks for `__Sequence__init` and `__assign`, from the limits of declared senders.

A C function such as rosidl_runtime_c__String__assign knows the kind of its elements and how many are asked for, not
which member of which message it serves. So there is a pool for each kind of element, with blocks of a few sizes. A
request takes a block of the smallest size that holds it, and of no other size. Each size has as many blocks as there
are members (in all messages that the senders keep) that can ever need that size: every member whose limit is above
the next smaller size. A member holds one block at a time, so within the limits there is always one free, in whatever
order members are filled and refilled; nothing moves, and nothing is split.

Where limits differ, a member counts in several sizes. `block_sizes` chooses the sizes that take the fewest bytes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.layout import StructLayouts
from microros_gen.typesupport.plan.names import c_name, element_c_type, primitive_sequence_name, struct_header
from microros_gen.typesupport.plan.size import TypeLimits

DEFAULT_MESSAGES = 1
"""Messages that each declared sender keeps, unless `memory.messages` says otherwise."""

_WHOLE = "__message"

_FIXED_KINDS = (
    *("text", "u16text", "string", "u16string", "float", "double", "long_double", "char", "wchar", "boolean"),
    *("octet", "uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64"),
)
"""Kinds that functions of rosidl_runtime_c name; those of messages come from the application."""


@dataclass(frozen=True)
class Sender:
    """What sends: the message that it sends, and its limits (None: of fixed size). `topic`: the full name of its topic
    or service, where it is declared."""

    type: TypeName
    limits: TypeLimits | None
    topic: str = ""


@dataclass(frozen=True)
class BlockSize:
    """`count` blocks of `elements` each."""

    elements: int
    count: int

    @property
    def bits(self) -> int:
        """Bytes that hold which of them are taken, a bit each."""
        return -(-self.count // 8)


@dataclass(frozen=True)
class MessagePool:
    """The blocks for elements of one kind, smallest first.

    `kind` ends its names in C (`text`: characters; `string`: strings of a sequence; `double`;
    `geometry_msgs__msg__Point`: messages of a sequence; with `__message` after it: those of `__create`).
    `element` is its type in C, which `header` declares (empty: the language does). `sizes`: of one element for each of
    the data models that the plan knows.
    """

    kind: str
    element: str
    header: str
    blocks: tuple[BlockSize, ...]
    sizes: tuple[int, ...]

    @property
    def symbol(self) -> str:
        """The name of the pool in C."""
        return f"microros_pool_{self.kind}"

    @property
    def of_messages(self) -> bool:
        """Whether its blocks are whole messages, for `__create`."""
        return self.kind.endswith(_WHOLE)

    def bytes(self, model: int) -> int:
        """Return what the pool takes for a data model (its place among those of the plan), which blocks are taken
        included."""
        return sum(b.elements * b.count * self.sizes[model] + b.bits for b in self.blocks)


@dataclass(frozen=True)
class PoolPointer:
    """What the C code of a kind names: a pool, or NULL."""

    kind: str
    value: str


def plan_message_pools(
    senders: Iterable[Sender],
    messages: Mapping[TypeName, Message],
    layouts: Iterable[StructLayouts],
    kept: int,
) -> tuple[MessagePool, ...]:
    """Return the pools for `kept` messages of each sender, in the order of their kinds; none where `kept` is 0."""
    demand = _Demand(messages, kept)
    for sender in senders if kept else ():
        demand.add(sender)
    return tuple(demand.pools(tuple(layouts)))


def message_pool(name: TypeName) -> str:
    """Return the kind of the pool of messages that `__create` gives; those of sequences have its name alone."""
    return c_name(name) + _WHOLE


def pool_pointers(pools: Iterable[MessagePool]) -> tuple[PoolPointer, ...]:
    """Return what each kind of rosidl_runtime_c has."""
    known = {pool.kind: f"(&{pool.symbol})" for pool in pools}
    return tuple(PoolPointer(kind, known.get(kind, "NULL")) for kind in _FIXED_KINDS)


def block_sizes(wanted: Mapping[int, int]) -> tuple[BlockSize, ...]:
    """Return the block sizes that serve any order of requests with the fewest elements in all.

    `wanted` has for each limit how many members have it.
    """
    limits = sorted(wanted)
    least = [0] * (len(limits) + 1)  # elements of the best choice for limits[first:]
    choice = [0] * len(limits)
    members = 0
    for first in range(len(limits) - 1, -1, -1):
        members += wanted[limits[first]]
        totals = [limits[last] * members + least[last + 1] for last in range(first, len(limits))]
        least[first] = min(totals)
        choice[first] = first + totals.index(least[first])
    found = []
    first = 0
    while first < len(limits):
        found.append(BlockSize(limits[choice[first]], sum(wanted[x] for x in limits[first:])))
        first = choice[first] + 1
    return tuple(found)


def open_members(sender: Sender, messages: Mapping[TypeName, Message]) -> tuple[tuple[str, int], ...]:
    """Return strings and sequences of a sender's message without a bound in the interface file, with their limits.

    Strings of a sequence, and members of its messages, have `[]` after its name.
    """
    found: list[tuple[str, int]] = []

    def walk(name: TypeName, limits: TypeLimits, before: str) -> None:
        for field, entry in zip(messages[name].fields, limits.fields, strict=True):
            element, path = element_of(field.type), before + field.name
            if entry is not None and isinstance(field.type, SequenceType):
                if field.type.bound is None:
                    found.append((path, entry.sequence or 0))
                path += "[]"
            if entry is not None and isinstance(element, StringType) and element.bound is None:
                found.append((path, entry.string or 0))
            elif entry is not None and entry.nested is not None and isinstance(element, NamedType):
                walk(element.name, entry.nested, f"{path}.")

    if sender.limits is not None:
        walk(sender.type, sender.limits, "")
    return tuple(found)


class _Demand:
    """Counts what the members of all kept messages can need at most, by kind."""

    def __init__(self, messages: Mapping[TypeName, Message], kept: int) -> None:
        self._messages = messages
        self._kept = kept
        self._wanted: dict[str, Counter[int]] = {}
        self._elements: dict[str, ElementType | None] = {}

    def add(self, sender: Sender) -> None:
        """Add the messages of one sender."""
        self._want(message_pool(sender.type), NamedType(sender.type), 1, self._kept)
        if sender.limits is not None:
            self._message(sender.type, sender.limits, self._kept)

    def pools(self, layouts: tuple[StructLayouts, ...]) -> list[MessagePool]:
        """Return the pools, sorted by kind."""
        return [self._pool(kind, layouts) for kind in sorted(self._wanted)]

    def _message(self, name: TypeName, limits: TypeLimits, times: int) -> None:
        for field, entry in zip(self._messages[name].fields, limits.fields, strict=True):
            if entry is None:
                continue
            element, many = element_of(field.type), times
            if isinstance(field.type, SequenceType):
                self._want(_kind(element), element, entry.sequence or 0, times)
                many *= entry.sequence or 0
            elif isinstance(field.type, ArrayType):
                many *= field.type.size
            if isinstance(element, StringType) and entry.string:
                kind = "u16text" if element.wide else "text"
                self._want(kind, None, entry.string + 1, many)
            elif isinstance(element, NamedType) and entry.nested is not None:
                self._message(element.name, entry.nested, many)

    def _want(self, kind: str, element: ElementType | None, most: int, times: int) -> None:
        if most and times:
            self._elements[kind] = element
            self._wanted.setdefault(kind, Counter())[most] += times

    def _pool(self, kind: str, layouts: tuple[StructLayouts, ...]) -> MessagePool:
        element, blocks = self._elements[kind], block_sizes(self._wanted[kind])
        if element is None:
            wide = kind == "u16text"
            c_type, size = ("uint_least16_t", 2) if wide else ("char", 1)
            return MessagePool(kind, c_type, "", blocks, tuple(size for _ in layouts))
        sizes = tuple(layout.of(element).size for layout in layouts)
        return MessagePool(kind, element_c_type(element), _header(element), blocks, sizes)


def _kind(element: ElementType) -> str:
    if isinstance(element, Primitive):
        return primitive_sequence_name(element)
    if isinstance(element, StringType):
        return "u16string" if element.wide else "string"
    return c_name(element.name)


def _header(element: ElementType) -> str:
    if isinstance(element, NamedType):
        return struct_header(element)
    if isinstance(element, StringType):
        return f"rosidl_runtime_c/{'u16string' if element.wide else 'string'}.h"
    return ""
