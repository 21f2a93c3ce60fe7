# SPDX-License-Identifier: Apache-2.0
"""The struct of current values of a node's declared parameters, and the C that fills it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

from microros_gen.application.model import ParameterDecl
from microros_gen.components.parameters.constants import C_TYPES, KINDS, string_limit

_RESERVED = frozenset(
    """auto bool break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    and asm bitand bitor catch class compl delete explicit export false friend mutable namespace new not operator or
    private protected public template this throw true try typeid typename using virtual xor""".split()  # noqa: SIM905
)
"""Words that are no names in C or C++."""
_LONGEST = 105
"""Characters of a call in one line."""
_OWN = ("changed", "revision")
"""Members that every struct has."""


class Identifiers:
    """Names of C, each of which is given once."""

    def __init__(self, *taken: str) -> None:
        self._taken = set(taken)

    def take(self, name: str) -> str:
        """Return `name` as one of C; with a number where it is taken."""
        plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
        plain = f"{plain}_" if plain in _RESERVED else plain
        number, found = 2, plain
        while found in self._taken:
            found, number = f"{plain}_{number}", number + 1
        self._taken.add(found)
        return found


def _named(parameters: tuple[ParameterDecl, ...]) -> Iterator[tuple[str, ParameterDecl]]:
    names = Identifiers(*_OWN)
    for parameter in parameters:
        yield names.take(parameter.name), parameter


def members(parameters: tuple[ParameterDecl, ...], string_size: int) -> Iterator[str]:
    """Yield the members; a string of an array has `string_size` bytes."""
    for name, parameter in _named(parameters):
        if parameter.type == "string":
            yield f"char {name}[{string_limit(parameter) + 1}];"
        elif parameter.type == "string[]":
            yield f"struct {{ char data[{parameter.size}][{string_size}]; size_t size; }} {name};"
        elif parameter.is_array:
            kind = C_TYPES[parameter.type.removesuffix("[]")]
            yield f"struct {{ {kind}data[{parameter.size}]; size_t size; }} {name};"
        else:
            yield f"{C_TYPES[parameter.type]}{name};"


def copies(parameters: tuple[ParameterDecl, ...]) -> Iterator[str]:
    """Yield the calls that copy each value to its member."""
    for name, parameter in _named(parameters):
        start = f"(parameter_server, {json.dumps(parameter.name)}, "
        to = f"values->{name}"
        if parameter.type == "string":
            yield _wrapped(f"rclc_parameter_copy_string{start}{to}, sizeof({to}));")
        elif parameter.type == "string[]":
            yield _wrapped(f"rclc_parameter_copy_strings{start}{to}.data, {parameter.size}, &{to}.size);")
        elif parameter.is_array:
            kind = f"RCLC_PARAMETER_{KINDS[parameter.type].upper()}"
            yield _wrapped(
                f"rclc_parameter_copy_array{start}{kind}, {to}.data, {parameter.size}, &{to}.size);"
            )
        else:
            yield f"rclc_parameter_copy_{parameter.type}{start}&{to});"


def _wrapped(call: str) -> str:
    """Return a call whose arguments are in the next line where it is a long one."""
    name, _, arguments = call.partition("(")
    return call if len(call) <= _LONGEST else f"{name}(\n      {arguments}"
