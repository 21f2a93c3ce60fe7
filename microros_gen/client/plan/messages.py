# SPDX-License-Identifier: Apache-2.0
"""What the messages of a plan consist of: it decides which functions of rosidl_runtime_c the library has."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.interfaces.types import Primitive, SequenceType, StringType, element_of
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import primitive_sequence_name
from microros_gen.typesupport.plan.types import TypePlan

_ALIASES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}
"""Second names that rosidl_runtime_c's primitives_sequence_functions.h gives to the functions of a sequence."""


@dataclass(frozen=True)
class NumberSequence:
    """The functions of a sequence of numbers: `name` in their names, that of the sequence, and the element in C."""

    name: str
    sequence: str
    element: str


@dataclass(frozen=True, kw_only=True)
class MessagesPlan:
    """What occurs in any message: sequences of numbers, of strings, and of wide strings; wide strings alone."""

    number_sequences: tuple[NumberSequence, ...] = ()
    text_sequences: bool = False
    wide_texts: bool = False
    wide_text_sequences: bool = False


def plan_messages(types: Iterable[TypePlan]) -> MessagesPlan:
    """Return what occurs in the messages of `types`."""
    fields = [field.type for plan in types for field in plan.message.fields]
    elements = {element_of(field) for field in fields}
    of_sequences = {field.element for field in fields if isinstance(field, SequenceType)}
    texts = {element.wide for element in of_sequences if isinstance(element, StringType)}
    return MessagesPlan(
        number_sequences=number_sequences(e for e in of_sequences if isinstance(e, Primitive)),
        text_sequences=False in texts,
        wide_texts=any(isinstance(element, StringType) and element.wide for element in elements),
        wide_text_sequences=True in texts,
    )


def number_sequences(elements: Iterable[Primitive]) -> tuple[NumberSequence, ...]:
    """Return the sequences of `elements`, in the order of their names; `char` and `uint8` of .msg files share one."""
    names = sorted({(primitive_sequence_name(element), element.c_type) for element in elements})
    return tuple(sequence for name, element in names for sequence in _functions(name, element))


def _functions(sequence: str, element: str) -> list[NumberSequence]:
    names = [sequence, *([_ALIASES[sequence]] if sequence in _ALIASES else [])]
    return [NumberSequence(name, sequence, element) for name in names]
