# SPDX-License-Identifier: Apache-2.0
"""Messages made at random: everything that an .idl file can say."""

from __future__ import annotations

import string

from hypothesis import strategies as st

from microros_gen.interfaces.msg.names import C_KEYWORDS, CPP_KEYWORDS
from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    ElementType,
    Field,
    FieldType,
    Message,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    TypeName,
)

NAME = TypeName("pkg_a", "msg", "Foo")
IDENTIFIERS = st.from_regex(r"[a-zA-Z][a-zA-Z0-9_]{0,8}", fullmatch=True).filter(
    lambda name: name not in C_KEYWORDS | CPP_KEYWORDS and name != "structure_needs_at_least_one_member"
)
TEXTS = st.text(st.characters(min_codepoint=1, codec="utf-8"), max_size=12)
COMMENTS = st.lists(
    st.text(
        string.ascii_letters + string.digits + string.punctuation.replace("[", "") + " äハ",
        min_size=1,
        max_size=20,
    ),
    max_size=3,
).map(tuple)
NUMBERS = [p for p in Primitive if p not in (Primitive.CHAR, Primitive.LONG_DOUBLE)]
UNSIGNED = (Primitive.BYTE, Primitive.WCHAR, *(p for p in Primitive if p.value.startswith("uint")))
BOUNDS = st.none() | st.integers(1, 2**32 - 1)
STRINGS = st.builds(StringType, st.booleans(), st.none() | st.integers(12 * 4, 1000))
NAMED = st.builds(
    lambda kind, name: NamedType(TypeName("pkg_b", kind, name)),
    st.sampled_from(["msg", "srv", "action"]),
    IDENTIFIERS,
)
ELEMENTS: st.SearchStrategy[ElementType] = st.sampled_from(NUMBERS) | STRINGS | NAMED


def values(kind: Primitive | StringType) -> st.SearchStrategy[ScalarValue]:
    if isinstance(kind, StringType):
        return TEXTS
    if kind is Primitive.BOOL:
        return st.booleans()
    if kind in (Primitive.FLOAT32, Primitive.FLOAT64):
        return st.floats(allow_nan=False, allow_infinity=False, width=8 * kind.size)  # type: ignore[arg-type]
    bits = 8 * kind.size
    low, high = (0, 2**bits - 1) if kind in UNSIGNED else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    return st.integers(low, high)


@st.composite
def types(draw: st.DrawFn) -> FieldType:
    element = draw(ELEMENTS)
    form = draw(st.sampled_from(["scalar", "scalar", "array", "sequence"]))
    if element is Primitive.WCHAR:
        return element
    if form == "array":
        return ArrayType(element, draw(st.integers(1, 4)))
    if form == "sequence":
        bound = draw(BOUNDS)
        wide = isinstance(element, StringType) and element.wide and element.bound is not None
        return SequenceType(element, bound if bound is not None or not wide else 9)
    return element


@st.composite
def fields(draw: st.DrawFn, name: str) -> Field:
    field_type = draw(types())
    element = field_type.element if isinstance(field_type, (ArrayType, SequenceType)) else field_type
    default: ScalarValue | tuple[ScalarValue, ...] | None = None
    if not isinstance(element, NamedType) and draw(st.booleans()):
        if isinstance(field_type, (ArrayType, SequenceType)):
            size = (
                field_type.size
                if isinstance(field_type, ArrayType)
                else draw(st.integers(0, min(3, field_type.bound or 3)))
            )
            default = tuple(draw(st.lists(values(element), min_size=size, max_size=size)))
        else:
            default = draw(values(element))
    return Field(name, field_type, default, draw(COMMENTS))


@st.composite
def messages(draw: st.DrawFn) -> Message:
    names = draw(st.lists(IDENTIFIERS, unique=True, max_size=6))
    count = draw(st.integers(0, len(names)))
    constants = []
    for name in names[:count]:
        kind = draw(st.sampled_from(NUMBERS) | st.builds(StringType, st.booleans()))
        constants.append(Constant(name, kind, draw(values(kind)), draw(COMMENTS)))
    members = [draw(fields(name)) for name in names[count:]]
    return Message(NAME, tuple(members), tuple(constants), draw(COMMENTS))
