# SPDX-License-Identifier: Apache-2.0
"""Views of the struct header and of the functions that rosidl_generator_c has for each message."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping

from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    Field,
    FieldType,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.message_pools import message_pool
from microros_gen.typesupport.plan.names import (
    element_c_type,
    guard,
    include_path,
    sequence_c_type,
    struct_header,
    type_files,
)
from microros_gen.typesupport.plan.size import members
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.notes import member_comment
from microros_gen.typesupport.views.text import INT_MAX, INT_MIN, comment_lines, number, string, wide_units


@dataclass(frozen=True)
class ConstantView:
    """A constant; `kind` is enum (fits int), macro (an integer that does not) or object."""

    kind: str
    name: str
    type: str
    dimension: str
    value: str
    comment: tuple[str, ...]


@dataclass(frozen=True)
class BoundView:
    """The bound of a sequence or string, as rosidl names it."""

    name: str
    value: int
    comment: str


@dataclass(frozen=True)
class MemberView:
    """A member of the struct."""

    declaration: str
    comment: tuple[str, ...]


@dataclass(frozen=True)
class StructView:
    """struct.h.j2."""

    guard: str
    ros_name: str
    name: str
    includes: tuple[str, ...]
    system_includes: tuple[str, ...]
    constants: tuple[ConstantView, ...]
    bounds: tuple[BoundView, ...]
    comment_lines: tuple[str, ...]
    members: tuple[MemberView, ...]


@dataclass(frozen=True)
class CallView:
    """A call, or `count` calls for i; `guarded` lines follow it where all went well."""

    call: str
    count: int = 0
    guarded: tuple[str, ...] = ()


@dataclass(frozen=True)
class WideDefault:
    """A static array with the UTF-16 units of a default value."""

    name: str
    units: str


@dataclass(frozen=True)
class FunctionsView:
    """functions.h.j2 and functions.c.j2.

    `init_fails`: __init needs memory, for default values. `pool` is the C expression of the pool of sequences of this
    message, `message_pool` of that of messages of __create.
    """

    guard: str
    ros_name: str
    name: str
    struct_header: str
    functions_header: str
    includes: tuple[str, ...]
    system_includes: tuple[str, ...]
    number_defaults: tuple[str, ...]
    wide_defaults: tuple[WideDefault, ...]
    init: tuple[CallView, ...]
    fini: tuple[CallView, ...]
    equal: tuple[CallView, ...]
    number_copies: tuple[str, ...]
    copy: tuple[CallView, ...]
    init_fails: bool
    pool: str
    message_pool: str


def struct_view(plan: TypePlan) -> StructView:
    """Return the view of the struct header."""
    message = plan.message
    values = [constant.value for constant in message.constants]
    floating = any(isinstance(v, float) and not math.isfinite(v) for v in values)
    return StructView(
        guard=guard(plan.files.struct),
        ros_name=str(plan.name),
        name=plan.c_name,
        includes=tuple(sorted({_struct_include(field.type) for field in message.fields} - {""})),
        system_includes=("math.h",) if floating else (),
        constants=tuple(_constant(plan, constant) for constant in message.constants),
        bounds=tuple(bound for field in message.fields for bound in _bounds(plan, field)),
        comment_lines=comment_lines(message.comment),
        members=tuple(MemberView(declaration(field), member_comment(field)) for field in members(message)),
    )


def declaration(field: Field) -> str:
    """Return the C declaration of a member."""
    if isinstance(field.type, ArrayType):
        return f"{element_c_type(field.type.element)} {field.name}[{field.type.size}]"
    if isinstance(field.type, SequenceType):
        return f"{sequence_c_type(field.type)} {field.name}"
    return f"{element_c_type(field.type)} {field.name}"


def _struct_include(field_type: FieldType) -> str:
    element = element_of(field_type)
    if isinstance(element, NamedType):
        return struct_header(element)
    if isinstance(element, StringType):
        return "rosidl_runtime_c/u16string.h" if element.wide else "rosidl_runtime_c/string.h"
    return "rosidl_runtime_c/primitives_sequence.h" if isinstance(field_type, SequenceType) else ""


def _constant(plan: TypePlan, constant: Constant) -> ConstantView:
    name = f"{plan.c_name}__{constant.name}"
    comment = comment_lines(constant.comment)
    if isinstance(constant.type, StringType):
        if constant.type.wide:
            units = "{" + ", ".join(wide_units(str(constant.value))) + "}"
            return ConstantView("object", name, "uint_least16_t", "[]", units, comment)
        return ConstantView("object", name, "char * const", "", string(str(constant.value)), comment)
    value = number(constant.type, constant.value)
    if constant.type in (Primitive.BOOL, Primitive.FLOAT32, Primitive.FLOAT64):
        return ConstantView("object", name, constant.type.c_type, "", value, comment)
    if INT_MIN <= int(constant.value) <= INT_MAX:
        return ConstantView("enum", name, "", "", _enumerator(int(constant.value)), comment)
    macro = f"({value})" if value.startswith("-") else value
    return ConstantView("macro", name, "", "", macro, comment)


def _enumerator(value: int) -> str:
    return f"({value + 1} - 1)" if value == INT_MIN else str(value)


def _bounds(plan: TypePlan, field: Field) -> Iterator[BoundView]:
    prefix = f"{plan.c_name}__{field.name}"
    if isinstance(field.type, SequenceType) and field.type.bound is not None:
        comment = f"Largest number of elements of {field.name}."
        yield BoundView(f"{prefix}__MAX_SIZE", field.type.bound, comment)
    element = element_of(field.type)
    if isinstance(element, StringType) and element.bound is not None:
        comment = f"Largest number of characters of {field.name}."
        yield BoundView(f"{prefix}__MAX_STRING_SIZE", element.bound, comment)


def functions_view(
    plan: TypePlan, plans: Mapping[TypeName, TypePlan], pools: Collection[str]
) -> FunctionsView:
    """Return the view of the functions' header and source; `pools` are the kinds of elements that have one."""
    fields = members(plan.message)
    init = tuple(call for field in fields for call in _init(field))
    needs_math = any("INFINITY" in line or "NAN" in line for field in fields for line in _numbers(field))
    return FunctionsView(
        guard=guard(plan.files.functions),
        ros_name=str(plan.name),
        name=plan.c_name,
        struct_header=include_path(plan.files.struct),
        functions_header=include_path(plan.files.functions),
        includes=_function_includes(fields),
        system_includes=("math.h", "stdint.h", "string.h") if needs_math else ("stdint.h", "string.h"),
        number_defaults=tuple(line for field in fields for line in _numbers(field)),
        wide_defaults=tuple(wide for field in fields for wide in wide_defaults(field, field.name)),
        init=init,
        fini=tuple(call for field in fields for call in _all(field, "fini", "msg", None)),
        equal=tuple(call for field in fields for call in _equal(field)),
        number_copies=tuple(line for field in fields for line in _number_copy(field)),
        copy=tuple(call for field in fields for call in _all(field, "copy", "input", "output")),
        init_fails=_needs_memory(plan, plans),
        pool=pool_pointer(plan.c_name, pools),
        message_pool=pool_pointer(message_pool(plan.name), pools),
    )


def pool_pointer(kind: str, pools: Collection[str]) -> str:
    """Return the C expression of the pool of a kind of elements: NULL if none exists."""
    return f"&microros_pool_{kind}" if kind in pools else "NULL"


def _needs_memory(plan: TypePlan, plans: Mapping[TypeName, TypePlan]) -> bool:
    """Return whether __init needs memory: for default values of strings and sequences, also of nested messages."""
    for field in plan.message.fields:
        element = element_of(field.type)
        if isinstance(field.type, SequenceType):
            needed = bool(defaults(field))
        elif isinstance(element, NamedType):
            needed = _needs_memory(plans[element.name], plans)
        else:
            needed = isinstance(element, StringType) and any(defaults(field))
        if needed:
            return True
    return False


def _function_includes(fields: tuple[Field, ...]) -> tuple[str, ...]:
    found = {"microros/message_pools.h", "rcutils/allocator.h"}
    for field in fields:
        element = element_of(field.type)
        if isinstance(element, NamedType):
            found.add(include_path(type_files(element.name).functions))
        elif isinstance(element, StringType):
            found.add(f"rosidl_runtime_c/{'u16string' if element.wide else 'string'}_functions.h")
        elif isinstance(field.type, SequenceType):
            found.add("rosidl_runtime_c/primitives_sequence_functions.h")
    return tuple(sorted(found))


def defaults(field: Field) -> tuple[ScalarValue, ...]:
    """Return the default values of a field, one for each element that has one."""
    if field.default is None:
        return ()
    return field.default if isinstance(field.default, tuple) else (field.default,)


def wide_defaults(field: Field, member: str) -> Iterator[WideDefault]:
    """Yield the arrays that hold the default values of a wide string or of an array of them."""
    element = element_of(field.type)
    if isinstance(element, StringType) and element.wide:
        for index, value in enumerate(defaults(field)):
            if value:
                yield WideDefault(wide_name(member, index), ", ".join(wide_units(str(value))))


def wide_name(member: str, index: int) -> str:
    """Return the name of the array with the units of the default value of a member's element."""
    return f"{member.replace('.', '__')}__default_{index}"


def _numbers(field: Field) -> Iterator[str]:
    """Yield the assignments of default values that are not zero, of numbers that are no sequence."""
    if isinstance(field.type, SequenceType) or not isinstance(element_of(field.type), Primitive):
        return
    for index, value in enumerate(defaults(field)):
        yield from _assign(field, f"msg->{field.name}", index, value)


def _assign(field: Field, target: str, index: int, value: ScalarValue) -> Iterator[str]:
    primitive = element_of(field.type)
    if isinstance(primitive, Primitive) and value:
        place = f"{target}[{index}]" if isinstance(field.type, (ArrayType, SequenceType)) else target
        yield f"{place} = {number(primitive, value)}"


def _init(field: Field) -> Iterator[CallView]:
    element = element_of(field.type)
    count = field.type.size if isinstance(field.type, ArrayType) else 0
    values = defaults(field)
    if isinstance(field.type, SequenceType):
        target = f"msg->{field.name}.data"
        lines: tuple[str, ...] = ()
        if isinstance(element, Primitive):
            lines = tuple(x for i, v in enumerate(values) for x in _assign(field, target, i, v))
        if values:  # an empty one is zero
            yield CallView(
                f"{sequence_c_type(field.type)}__init(&msg->{field.name}, {len(values)}U)", guarded=lines
            )
    elif not isinstance(element, Primitive):
        index = "[i]" if count else ""
        yield CallView(f"{element_c_type(element)}__init(&msg->{field.name}{index})", count)
    if isinstance(element, StringType):
        yield from _text_defaults(field, element, values)


def _text_defaults(field: Field, element: StringType, values: tuple[ScalarValue, ...]) -> Iterator[CallView]:
    place = f"msg->{field.name}" + (".data" if isinstance(field.type, SequenceType) else "")
    is_many = isinstance(field.type, (ArrayType, SequenceType))
    for index, value in enumerate(values):
        if value:
            text = wide_name(field.name, index) if element.wide else string(str(value))
            target = f"{place}[{index}]" if is_many else place
            yield CallView(f"{element_c_type(element)}__assign(&{target}, {text})")


def _all(field: Field, function: str, first: str, second: str | None) -> Iterator[CallView]:
    """Yield the calls of `function` for what is not a plain number."""
    element = element_of(field.type)
    count = field.type.size if isinstance(field.type, ArrayType) else 0
    if isinstance(field.type, SequenceType):
        kind = sequence_c_type(field.type)
    elif isinstance(element, Primitive):
        return
    else:
        kind = element_c_type(element)
    member = f"{field.name}[i]" if count else field.name
    arguments = f"&{first}->{member}" + (f", &{second}->{member}" if second else "")
    yield CallView(f"{kind}__{function}({arguments})", count)


def _equal(field: Field) -> Iterator[CallView]:
    element = element_of(field.type)
    if isinstance(field.type, SequenceType) or not isinstance(element, Primitive):
        yield from _all(field, "are_equal", "lhs", "rhs")
        return
    count = field.type.size if isinstance(field.type, ArrayType) else 0
    member = f"{field.name}[i]" if count else field.name
    yield CallView(f"(lhs->{member} == rhs->{member})", count)


def _number_copy(field: Field) -> Iterator[str]:
    if isinstance(field.type, SequenceType) or not isinstance(element_of(field.type), Primitive):
        return
    if isinstance(field.type, ArrayType):
        yield f"(void)memcpy(output->{field.name}, input->{field.name}, sizeof(output->{field.name}))"
    else:
        yield f"output->{field.name} = input->{field.name}"
