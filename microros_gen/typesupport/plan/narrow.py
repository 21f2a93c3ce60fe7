# SPDX-License-Identifier: Apache-2.0
"""Constants and default values of float64 where a double of the target is a binary32 (IEEE 754, 3.4): rounded as the
target rounds what it receives."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from dataclasses import replace

from microros_gen.interfaces.types import (
    FieldType,
    Message,
    Primitive,
    ScalarValue,
    TypeName,
    Value,
    element_of,
)


def narrowed(messages: Mapping[TypeName, Message]) -> dict[TypeName, Message]:
    """Return the messages with every value of a float64 as the nearest binary32; beyond the largest: infinity."""
    return {name: _narrowed_message(message) for name, message in messages.items()}


def as_binary32(value: float) -> float:
    """Return the nearest binary32, ties to even (IEEE 754, 4.3.1)."""
    try:
        [rounded] = struct.unpack("<f", struct.pack("<f", value))
    except OverflowError:
        return math.copysign(math.inf, value)
    return float(rounded)


def _narrowed_message(message: Message) -> Message:
    fields = tuple(
        field if field.default is None else replace(field, default=_narrowed(field.type, field.default))
        for field in message.fields
    )
    constants = tuple(replace(c, value=_scalar(c.type, c.value)) for c in message.constants)
    return replace(message, fields=fields, constants=constants)


def _narrowed(field_type: FieldType, value: Value) -> Value:
    if isinstance(value, tuple):
        return tuple(_scalar(element_of(field_type), element) for element in value)
    return _scalar(element_of(field_type), value)


def _scalar(element: object, value: ScalarValue) -> ScalarValue:
    return as_binary32(float(value)) if element is Primitive.FLOAT64 else value
