# SPDX-License-Identifier: Apache-2.0
"""Sizes and offsets of the generated C structs on a target, from its data model (no compiler asked)."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    FieldType,
    Message,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import align, members


@dataclass(frozen=True)
class DataModel:
    """What a C compiler decides: bytes of a pointer and of `size_t`, and the alignment of 8-byte numbers.

    `align_most` is the largest alignment of anything, `double` the bytes of a double.
    """

    pointer: int
    size: int
    align_8: int
    align_most: int = 8
    double: int = 8

    @property
    def converts_float64(self) -> bool:
        """Whether a double is no binary64, so that float64 members are converted on the wire."""
        return self.double != Primitive.FLOAT64.size


LP64 = DataModel(pointer=8, size=8, align_8=8)
"""64-bit hosts (System V x86-64, AArch64)."""

ILP32 = DataModel(pointer=4, size=4, align_8=8)
"""32-bit targets whose ABI aligns 8-byte numbers to 8: Arm EABI, RISC-V, Xtensa."""

I386 = DataModel(pointer=4, size=4, align_8=4)
"""32-bit x86 System V: 8-byte numbers are aligned to 4 in structs."""

IP16 = DataModel(pointer=2, size=2, align_8=1, align_most=1, double=4)
"""AVR (avr-gcc's ABI): int and pointers of 16 bits, no padding, and a double that is a float."""

WIDE_MODELS = (LP64, ILP32, I386)
"""Those of the one output for all targets of 32 and 64 bits: its assertions choose by the size of a pointer."""

ALL_MODELS = (*WIDE_MODELS, IP16)
"""Those of sources for every processor, in the order of CDR_SIZE_ANY."""

_MODELS = {"lp64": WIDE_MODELS, "ilp32": WIDE_MODELS, "ip16": (IP16,), "any": ALL_MODELS}


def models_of(data_model: str) -> tuple[DataModel, ...]:
    """Return the data models that the output for a target must be right for, from its `data_model`."""
    return _MODELS[data_model]


@dataclass(frozen=True)
class Extent:
    """Size and alignment, bytes."""

    size: int
    alignment: int


class StructLayouts:
    """Extents and member offsets of the structs of a closed set of messages; results are kept."""

    def __init__(self, messages: Mapping[TypeName, Message], model: DataModel) -> None:
        self._messages = messages
        self.model = model
        self._known: dict[TypeName, tuple[Extent, dict[str, int]]] = {}

    def extent(self, name: TypeName) -> Extent:
        """Return the extent of the struct of `name`."""
        return self._struct(name)[0]

    def offsets(self, name: TypeName) -> Mapping[str, int]:
        """Return the offset of each member of the struct of `name`, bytes."""
        return self._struct(name)[1]

    def of(self, field_type: FieldType) -> Extent:
        """Return the extent of a member of this type."""
        if isinstance(field_type, ArrayType):
            element = self.of(field_type.element)
            return Extent(element.size * field_type.size, element.alignment)
        if isinstance(field_type, (SequenceType, StringType)):
            return self.pointer_and_sizes()
        return self._element(field_type)

    def character(self, wide: bool) -> Extent:
        """Return the extent of a character of a string, or of a UTF-16 unit."""
        return Extent(2, min(2, self.model.align_most)) if wide else Extent(1, 1)

    def pointer_and_sizes(self) -> Extent:
        """Return the extent of a string or sequence: a pointer and two `size_t`."""
        alignment = min(max(self.model.pointer, self.model.size), self.model.align_most)
        return Extent(
            align(align(self.model.pointer, self.model.size) + 2 * self.model.size, alignment), alignment
        )

    def _element(self, element: ElementType) -> Extent:
        if isinstance(element, Primitive):
            return self._number(element)
        if isinstance(element, StringType):
            return self.pointer_and_sizes()
        return self.extent(element.name)

    def _number(self, number: Primitive) -> Extent:
        if number is Primitive.FLOAT64:
            size, alignment = self.model.double, min(self.model.double, self.model.align_8)
        else:
            size = number.size
            alignment = self.model.align_8 if size == 8 else size
        return Extent(size, min(alignment, self.model.align_most))

    def _struct(self, name: TypeName) -> tuple[Extent, dict[str, int]]:
        if name not in self._known:
            self._known[name] = struct_extent(
                {field.name: self.of(field.type) for field in members(self._messages[name])}
            )
        return self._known[name]


def struct_extent(parts: Mapping[str, Extent]) -> tuple[Extent, dict[str, int]]:
    """Return the extent of a struct with these members in this order, and their offsets."""
    offsets: dict[str, int] = {}
    end = 0
    alignment = 1
    for name, part in parts.items():
        offsets[name] = align(end, part.alignment)
        end = offsets[name] + part.size
        alignment = max(alignment, part.alignment)
    return Extent(align(end, alignment), alignment), offsets
