# SPDX-License-Identifier: Apache-2.0
"""Messages read from texts, and compared without their places."""

from __future__ import annotations

from dataclasses import replace

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
    SequenceType,
    StringType,
    TypeName,
    Value,
)

NAME = TypeName("pkg_a", "msg", "Foo")


def without_places(message: Message) -> Message:
    return replace(
        message,
        span=None,
        fields=tuple(replace(f, span=None) for f in message.fields),
        constants=tuple(replace(c, span=None) for c in message.constants),
    )


NAMES = st.from_regex(r"[a-z][a-z0-9]{0,3}(_[a-z0-9]{1,3}){0,2}", fullmatch=True).filter(
    lambda name: name not in C_KEYWORDS | CPP_KEYWORDS
)
TYPE_NAMES = st.from_regex(r"[A-Z][A-Za-z0-9]{0,6}", fullmatch=True)
CHARACTERS = st.characters(exclude_categories=["Cs"], exclude_characters="\0")
PLAIN = st.text(st.sampled_from("abc XYZ09_-+.,;:!?()[]{}<>/"), max_size=8)
SIZES = st.integers(1, 2**32 - 1)
RANGES = dict.fromkeys((Primitive.BYTE, Primitive.CHAR), (0, 255)) | {
    p: (-(2 ** (8 * p.size - 1)), 2 ** (8 * p.size - 1) - 1)
    if p.value[0] == "i"
    else (0, 2 ** (8 * p.size) - 1)
    for p in Primitive
    if "int" in p.value
}


def scalars(kind: Primitive | StringType) -> st.SearchStrategy[bool | int | float | str]:
    if isinstance(kind, StringType):
        if kind.bound is None:
            return st.text(CHARACTERS, max_size=12)
        bound = kind.bound
        return PLAIN.map(lambda text: text[:bound])
    if kind is Primitive.BOOL:
        return st.booleans()
    if kind in RANGES:
        return st.integers(*RANGES[kind])
    return st.floats(allow_nan=False, allow_infinity=False, width=32 if kind is Primitive.FLOAT32 else 64)


ELEMENTS: st.SearchStrategy[ElementType] = st.one_of(
    st.sampled_from([p for p in Primitive if p.in_msg]),
    st.builds(StringType, st.booleans(), st.none() | SIZES),
    st.builds(NamedType, st.builds(TypeName, NAMES, st.just("msg"), TYPE_NAMES)),
)


@st.composite
def field_types(draw: st.DrawFn) -> FieldType:
    element = draw(ELEMENTS)
    shape = draw(st.sampled_from(["scalar", "array", "sequence", "bounded"]))
    if shape == "scalar":
        return element
    if shape == "array":
        return ArrayType(element, draw(st.integers(1, 4)))
    wide = isinstance(element, StringType) and element.wide and element.bound is not None
    return SequenceType(element, draw(SIZES) if shape == "bounded" or wide else None)


@st.composite
def defaults(draw: st.DrawFn, field_type: FieldType) -> Value | None:
    if isinstance(field_type, (Primitive, StringType)):
        return draw(st.none() | scalars(field_type))
    if isinstance(field_type, NamedType) or isinstance(field_type.element, NamedType):
        return None
    least, most = 0, 4
    if isinstance(field_type, ArrayType):
        least = most = field_type.size
    elif field_type.bound is not None:
        most = min(most, field_type.bound)
    element = field_type.element
    values = scalars(element)
    if isinstance(element, StringType) and element.bound is not None:
        # An escaped blank at an element's end takes more of the bound than a blank.
        values = values.map(lambda text: str(text).strip())
    return draw(st.none() | st.lists(values, min_size=least, max_size=most).map(tuple))


LINES = st.text(st.characters(categories=["L", "N", "P", "S"]), min_size=1, max_size=12)
COMMENTS = st.lists(LINES.filter(lambda line: not line.startswith("#")), max_size=3).map(tuple)


@st.composite
def messages(draw: st.DrawFn) -> Message:
    fields = []
    for name in draw(st.lists(NAMES, max_size=4, unique=True)):
        field_type = draw(field_types())
        fields.append(Field(name, field_type, draw(defaults(field_type)), draw(COMMENTS)))
    constants = []
    for name in draw(st.lists(NAMES, max_size=3, unique_by=str.upper)):
        kind = draw(
            st.sampled_from([p for p in Primitive if p.in_msg]) | st.builds(StringType, st.booleans())
        )
        constants.append(Constant(name.upper(), kind, draw(scalars(kind)), draw(COMMENTS)))
    return Message(NAME, tuple(fields), tuple(constants), draw(COMMENTS))
