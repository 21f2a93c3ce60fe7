# SPDX-License-Identifier: Apache-2.0
"""C names of interface types, as rosidl_generator_c of Jazzy makes them, and the paths of their files."""

from __future__ import annotations

import re
from functools import cache

from microros_gen.interfaces.derived import declaring_name
from microros_gen.interfaces.types import (
    ElementType,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from microros_gen.records import dataclass

_SEQUENCES = {
    Primitive.BOOL: "boolean",
    Primitive.BYTE: "octet",
    Primitive.CHAR: "uint8",
    Primitive.FLOAT32: "float",
    Primitive.FLOAT64: "double",
    Primitive.IDL_CHAR: "char",
}


@cache
def snake_case(name: str) -> str:
    """Return `CamelCase` as `camel_case`, split as rosidl does (`ABCDef` → `abc_def`)."""
    split = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", split).lower()


@cache
def c_name(name: TypeName) -> str:
    """Return the name of the C struct: `sensor_msgs__msg__Imu`."""
    return f"{name.package}__{name.kind}__{name.name}"


def element_c_type(element: ElementType) -> str:
    """Return the C type of one value."""
    if isinstance(element, Primitive):
        return element.c_type
    if isinstance(element, StringType):
        return f"rosidl_runtime_c__{'U16String' if element.wide else 'String'}"
    return c_name(element.name)


def sequence_c_type(sequence: SequenceType) -> str:
    """Return the C type of a sequence."""
    if isinstance(sequence.element, Primitive):
        return f"rosidl_runtime_c__{primitive_sequence_name(sequence.element)}__Sequence"
    return f"{element_c_type(sequence.element)}__Sequence"


def primitive_sequence_name(primitive: Primitive) -> str:
    """Return how rosidl_runtime_c names the sequence of a primitive: `float64` → `double`."""
    return _SEQUENCES.get(primitive, primitive.value)


@dataclass(frozen=True)
class TypeFiles:
    """Paths of a type's files below the output folder; which of them exist is said by its plan."""

    header: str
    struct: str
    functions: str
    type_support: str
    storage: str
    functions_source: str
    type_support_source: str
    storage_source: str


@cache
def type_files(name: TypeName) -> TypeFiles:
    """Return the paths of the files of `name`; all messages of a service or action share one set of files."""
    stem = snake_case(declaring_name(name).name)
    detail = f"include/{name.package}/{name.kind}/detail/{stem}"
    source = f"src/{name.package}/" + (stem if name.kind == "msg" else f"{name.kind}__{stem}")
    return TypeFiles(
        header=f"include/{name.package}/{name.kind}/{stem}.h",
        struct=f"{detail}__struct.h",
        functions=f"{detail}__functions.h",
        type_support=f"{detail}__type_support.h",
        storage=f"{detail}__storage.h",
        functions_source=f"{source}__functions.c",
        type_support_source=f"{source}__type_support.c",
        storage_source=f"{source}__storage.c",
    )


def include_path(path: str) -> str:
    """Return a header's path as an #include names it."""
    return path.removeprefix("include/")


def guard(path: str) -> str:
    """Return the include guard of a header."""
    return re.sub(r"[^A-Z0-9]", "_", include_path(path).upper().replace("/", "__"))


def struct_header(element: NamedType) -> str:
    """Return the header that declares the struct of a nested type, as an #include names it."""
    return include_path(type_files(element.name).struct)
