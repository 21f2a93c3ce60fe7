# SPDX-License-Identifier: Apache-2.0
"""What encoders and decoders ask about a type: what varies in it, what is small, what lies as on the wire."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.interfaces.types import (
    ArrayType,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.layout import LP64, StructLayouts
from microros_gen.typesupport.plan.size import is_fixed, members

DOUBLE = "double"
"""The form of a float64 where a double is no binary64: `cdr_put_double` converts it."""

LARGEST_INLINE = 3
"""Variable parts that a nested type may have to be written in place: beyond, a call costs less flash."""


class TypeFacts:
    """Answers about the types of one plan; each is worked out once.

    `converts_float64`: a double of the target is no binary64.
    """

    def __init__(self, messages: Mapping[TypeName, Message], converts_float64: bool = False) -> None:
        self.messages = messages
        self.converts_float64 = converts_float64
        self.layouts = StructLayouts(messages, LP64)
        self._fixed: dict[TypeName, bool] = {}
        self._parts: dict[TypeName, int] = {}

    def fixed(self, name: TypeName) -> bool:
        """Return whether the type has no part of variable length."""
        if name not in self._fixed:
            self._fixed[name] = is_fixed(self.messages[name], self.messages)
        return self._fixed[name]

    def form(self, primitive: Primitive) -> str:
        """Return what ends the names of the functions that write and read it: `bool`, `double`, or its bytes."""
        if primitive is Primitive.BOOL:
            return "bool"
        is_converted = primitive is Primitive.FLOAT64 and self.converts_float64
        return DOUBLE if is_converted else str(primitive.size)

    def is_copied(self, primitive: Primitive) -> bool:
        """Return whether it has the same bytes in memory (little endian) as on the wire."""
        return self.form(primitive).isdigit()

    def is_inline(self, name: TypeName) -> bool:
        """Return whether a member of this type is written in place."""
        return self.variable_parts(name) <= LARGEST_INLINE

    def variable_parts(self, name: TypeName) -> int:
        """Return the number of strings, sequences and arrays of messages, nested ones included."""
        if name not in self._parts:
            self._parts[name] = sum(self._parts_of(field) for field in self.messages[name].fields)
        return self._parts[name]

    def _parts_of(self, field: Field) -> int:
        element = element_of(field.type)
        if isinstance(field.type, NamedType):
            return self.variable_parts(field.type.name)
        return int(not isinstance(element, Primitive) or isinstance(field.type, SequenceType))

    def packed(self, name: TypeName) -> tuple[int, int] | None:
        """Return size and alignment where an array of the type is one run on the wire and in C, else None.

        That is: nothing that is converted, no padding, the first member has the largest alignment, the size is a
        multiple of it.
        """
        leaves = list(self.leaves(name))
        if not leaves or not self.fixed(name) or None in leaves:
            return None
        primitives = [p for p in leaves if p is not None]
        alignment = max(p.size for p, _ in primitives)
        size = 0
        for primitive, count in primitives:
            if not self.is_copied(primitive) or size % primitive.size:
                return None
            size += primitive.size * count
        if primitives[0][0].size != alignment or size % alignment:
            return None
        return (size, alignment) if self.layouts.extent(name).size == size else None

    def leaves(self, name: TypeName) -> Iterator[tuple[Primitive, int] | None]:
        """Yield the numbers that the type consists of with their counts, None for a part of variable length."""
        for field in members(self.messages[name]):
            element = element_of(field.type)
            count = field.type.size if isinstance(field.type, ArrayType) else 1
            if isinstance(element, Primitive):
                yield element, count
            elif isinstance(element, NamedType) and not isinstance(field.type, SequenceType):
                for _ in range(count):
                    yield from self.leaves(element.name)
            else:
                yield None
