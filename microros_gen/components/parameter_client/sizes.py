# SPDX-License-Identifier: Apache-2.0
"""The largest message with values of parameters: of the members of a value, one has content."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.interfaces.types import NamedType, TypeName, element_of
from microros_gen.typesupport.plan.size import FieldLimits, TypeLimits, WireSizes, members
from microros_gen.typesupport.plan.types import TypePlan

VALUE_TYPES = {"string": 4, "byte[]": 5, "bool[]": 6, "integer[]": 7, "double[]": 8, "string[]": 9}
"""Type that has a size → its number in rcl_interfaces/msg/ParameterType, which is the place of its member, too."""
_VALUE = TypeName("rcl_interfaces", "msg", "ParameterValue")
_EMPTY = FieldLimits(0, 0, None)


def largest(types: Mapping[TypeName, TypePlan], name: TypeName) -> int:
    """Return the size of a message whose values have the type that takes most, bytes of the CDR body.

    Each value begins at a multiple of 8, so values of several types take no more than those of the largest one.
    """
    sizes = WireSizes({known: plan.message for known, plan in types.items()})
    return max(
        sizes.largest(name, _narrowed(types, name, types[name].limits, n)) for n in VALUE_TYPES.values()
    )


def _narrowed(
    types: Mapping[TypeName, TypePlan], name: TypeName, limits: TypeLimits | None, number: int
) -> TypeLimits | None:
    """Return the limits with those of one type of values alone."""
    if limits is None:
        return None
    if name == _VALUE:
        fields = enumerate(limits.fields)
        return TypeLimits(tuple(_EMPTY if f is not None and i != number else f for i, f in fields))
    narrowed: list[FieldLimits | None] = []
    for field, entry in zip(members(types[name].message), limits.fields, strict=True):
        element = element_of(field.type)
        if entry is not None and isinstance(element, NamedType):
            nested = _narrowed(types, element.name, entry.nested, number)
            narrowed.append(FieldLimits(entry.sequence, entry.string, nested))
        else:
            narrowed.append(entry)
    return TypeLimits(tuple(narrowed))
