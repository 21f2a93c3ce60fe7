# SPDX-License-Identifier: Apache-2.0
"""A message type as a flat list of steps.

Members of nested messages are steps of the outermost one; adjacent numbers are one step, so that `struct` writes and
reads them in one call. Only elements of arrays and sequences have a separate program.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.diagnostics import nearest
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
from microros_gen.ros.errors import CodecError
from microros_gen.ros.steps import CODES, OCTETS, Many, Numbers, Octets, Place, Run, Step, Text
from microros_gen.ros.texts import Characters, WideCharacters

_NOTHING: Mapping[str, Any] = {}
_SCALARS: dict[str, Any] = {"?": False, "f": 0.0, "d": 0.0}
"""What a number is without a default, where it is not 0."""


class Program:
    """Writes and reads one message type.

    Its containers are the dicts of the message (number 0) and of its nested messages, in the order of their creation.
    """

    def __init__(self, message: Message) -> None:
        self._names: list[dict[str, None]] = [{field.name: None for field in message.fields}]
        self._links: list[tuple[int, str]] = []
        """For each nested message: the number of its parent's container, and the name of the member in the parent."""
        self._paths = [""]
        self.steps: tuple[Step, ...] = ()

    def add_container(self, parent: int, path: str, field: Field, message: Message) -> int:
        """Add a container for the nested message `field` of container `parent`; return its number."""
        self._names.append({member.name: None for member in message.fields})
        self._links.append((parent, field.name))
        self._paths.append(path)
        return len(self._links)

    def write(self, value: Any, out: bytearray) -> None:
        """Append the CDR of `value` to `out`; alignment counts from the start of `out`.

        Raises CodecError, which names the member, if the value does not match the type.
        """
        containers = [self._checked(0, value)]
        for number, (parent, name) in enumerate(self._links, 1):
            containers.append(self._checked(number, containers[parent].get(name, _NOTHING)))
        for step in self.steps:
            step.write(containers, out)

    def read(self, data: memoryview, at: int, order: str) -> tuple[dict[str, Any], int]:
        """Return the message at position `at` of `data`, and the position after it; `order` is `<` or `>`.

        Raises CodecError, which names the member, if the data end too early or exceed a bound.
        """
        containers: list[dict[str, Any]] = [names.copy() for names in self._names]
        for number, (parent, name) in enumerate(self._links, 1):
            containers[parent][name] = containers[number]
        for step in self.steps:
            at = step.read(data, at, order, containers)
        return containers[0], at

    def _checked(self, number: int, value: Any) -> Mapping[str, Any]:
        if not isinstance(value, Mapping):
            raise CodecError(f"{value!r:.60} is not a message: a dict is expected", self._paths[number])
        names = self._names[number]
        if not value.keys() <= names.keys():
            wrong = next(name for name in value if name not in names)
            hint = nearest(str(wrong), names) or f"It has {', '.join(names) or 'none'}"
            raise CodecError(f"unknown member '{wrong}'. {hint}", self._paths[number])
        return value


def compile_program(
    name: TypeName, messages: Mapping[TypeName, Message], programs: dict[TypeName, Program]
) -> Program:
    """Return the program of a message, with those of its elements from `programs` or added there."""
    if name not in programs:
        if name not in messages:
            raise CodecError(f"its part {name} is not among these interfaces")
        program = Program(messages[name])
        compiler = _Compiler(program, messages, programs)
        compiler.add_message(messages[name], 0, "")
        program.steps = compiler.finished()
        programs[name] = program
    return programs[name]


class _Compiler:
    def __init__(
        self, program: Program, messages: Mapping[TypeName, Message], programs: dict[TypeName, Program]
    ) -> None:
        self._program = program
        self._messages = messages
        self._programs = programs
        self._steps: list[Step] = []
        self._run: list[tuple[Place | None, Primitive]] = []

    def add_message(self, message: Message, container: int, prefix: str) -> None:
        if not message.fields:
            self._run.append((None, Primitive.UINT8))  # structure_needs_at_least_one_member
        for field in message.fields:
            self._add_field(field, container, f"{prefix}{field.name}")

    def finished(self) -> tuple[Step, ...]:
        self._end_run()
        return tuple(self._steps)

    def _add_field(self, field: Field, container: int, path: str) -> None:
        if isinstance(field.type, NamedType):
            if field.type.name not in self._messages:
                raise CodecError(f"its type {field.type.name} is not among these interfaces", path)
            message = self._messages[field.type.name]
            number = self._program.add_container(container, path, field, message)
            self.add_message(message, number, f"{path}.")
            return
        if element_of(field.type) is Primitive.LONG_DOUBLE:
            raise CodecError("long double is as wide as each machine has it, and has no CDR here", path)
        place = Place(container, field.name, path, _default(field))
        if isinstance(field.type, Primitive):
            self._run.append((place, field.type))
            return
        self._end_run()
        self._steps.append(self._step(field, place))

    def _step(self, field: Field, place: Place) -> Step:
        if isinstance(field.type, StringType):
            return Text(place, _text(field.type))
        element = element_of(field.type)
        size = field.type.size if isinstance(field.type, ArrayType) else None
        bound = field.type.bound if isinstance(field.type, SequenceType) else None
        if isinstance(element, Primitive):
            kind = Octets if element in OCTETS else Numbers
            return kind(place, element, size, bound)
        if isinstance(element, StringType):
            return Many(place, _text(element), size, bound)
        program = compile_program(element.name, self._messages, self._programs)
        return Many(place, program, size, bound)

    def _end_run(self) -> None:
        if self._run:
            self._steps.append(Run(self._run))
            self._run = []


def _text(kind: StringType) -> Characters:
    return WideCharacters(kind.bound) if kind.wide else Characters(kind.bound)


def _default(field: Field) -> Any:
    """Return the default of a missing member."""
    if field.default is not None:
        return field.default
    if isinstance(field.type, ArrayType):
        return [_zero(field.type.element)] * field.type.size
    return () if isinstance(field.type, SequenceType) else _zero(element_of(field.type))


def _zero(element: ElementType) -> Any:
    if isinstance(element, StringType):
        return ""
    return _NOTHING if isinstance(element, NamedType) else _SCALARS.get(CODES[element], 0)
