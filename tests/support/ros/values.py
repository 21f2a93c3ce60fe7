# SPDX-License-Identifier: Apache-2.0
"""Random messages as the codec has them."""

from __future__ import annotations

import math
import random
import struct
import sys
from collections.abc import Mapping
from typing import Any

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.ros.steps import CODES, OCTETS

FLOATS = {
    Primitive.FLOAT32: (0.0, -0.0, -1.5, math.inf, -math.inf, 2.0**-149, (2 - 2**-23) * 2.0**127),
    Primitive.FLOAT64: (0.0, -0.0, -1.5, math.inf, -math.inf, 5e-324, sys.float_info.max, 0.1),
}
LETTERS = "abcXYZ 0123'\"\\?éß→ハ😀"
MOST = 3
"""Elements of a sequence without a bound."""


def random_value(messages: Mapping[TypeName, Message], name: TypeName, source: random.Random) -> Any:
    """Return a message with all its members."""
    return {field.name: _field(messages, field, source) for field in messages[name].fields}


def without_bytes(value: Any) -> Any:
    """Return the same with lists in place of bytes, as other oracles have them."""
    if isinstance(value, dict):
        return {name: without_bytes(member) for name, member in value.items()}
    if isinstance(value, list):
        return [without_bytes(element) for element in value]
    return list(value) if isinstance(value, bytes) else value


def _field(messages: Mapping[TypeName, Message], field: Field, source: random.Random) -> Any:
    element = element_of(field.type)
    if isinstance(field.type, ArrayType):
        count = field.type.size
    elif isinstance(field.type, SequenceType):
        bound = MOST if field.type.bound is None else field.type.bound
        count = source.choice((0, min(bound, MOST), bound))
    else:
        return _element(messages, element, source)
    values = [_element(messages, element, source) for _ in range(count)]
    return bytes(values) if element in OCTETS else values


def _element(messages: Mapping[TypeName, Message], element: ElementType, source: random.Random) -> Any:
    if isinstance(element, NamedType):
        return random_value(messages, element.name, source)
    if isinstance(element, StringType):
        return _text(element, source)
    if element is Primitive.BOOL:
        return source.random() < 0.5
    if element in FLOATS:
        return source.choice(FLOATS[element])
    bits = 8 * struct.calcsize(f"<{CODES[element]}")
    low = -(1 << bits - 1) if CODES[element].islower() else 0
    return source.choice((low, low + (1 << bits) - 1, low + source.randint(0, (1 << bits) - 1)))


def _text(element: StringType, source: random.Random) -> str:
    text = "".join(source.choice(LETTERS) for _ in range(source.randint(0, 9)))
    encoding, unit = ("utf-16-le", 2) if element.wide else ("utf-8", 1)
    while element.bound is not None and len(text.encode(encoding)) > unit * element.bound:
        text = text[:-1]
    return text
