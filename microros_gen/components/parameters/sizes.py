# SPDX-License-Identifier: Apache-2.0
"""How long the values of parameters can be, and what is declared longer than that."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from microros_gen.application.model import Application, ParameterDecl
from microros_gen.components.parameters.constants import LONGEST_TEXT, string_limit
from microros_gen.diagnostics import Diagnostic

_PACKAGE = "rcl_interfaces"
STRING_VALUE = (f"{_PACKAGE}/msg/ParameterValue", "string_value")
STRINGS = (f"{_PACKAGE}/msg/ParameterValue", "string_array_value")
ARRAYS = {
    "byte[]": ("byte_array_value", 1),
    "bool[]": ("bool_array_value", 1),
    "integer[]": ("integer_array_value", 8),
    "double[]": ("double_array_value", 8),
}
"""Type of an array → its member of a ParameterValue, and the bytes of an element."""


def longer_than_limits(
    application: Application, parameters: Iterable[ParameterDecl], what: str
) -> Iterator[Diagnostic]:
    """Yield the defaults that the application's own limits of a value do not hold; `what` they are called."""
    for parameter in parameters:
        default = parameter.default
        texts = default if isinstance(default, tuple) else (default,)
        longest = max((len(text.encode()) for text in texts if isinstance(text, str)), default=0)
        member, most = "string_value", string_size(application) - 1
        if parameter.type == "string[]":
            member, most = STRINGS[1], array_string_size(application)
        room = max(longest, parameter.size or 0) if parameter.type == "string" else longest
        if longest > most and parameter.type in ("string", "string[]"):
            yield _too_long(
                parameter, what, f"a text of {longest} bytes", member, most, f"{{string: {room}}}"
            )
        elements = elements_of(application, parameter.type) if parameter.is_array else 0
        if isinstance(default, tuple) and len(default) > elements:
            member = ARRAYS[parameter.type][0] if parameter.type in ARRAYS else member
            count = len(default)
            yield _too_long(parameter, what, f"{count} elements", member, elements, f"{{sequence: {count}}}")


def sizes_above_limits(application: Application, parameters: Iterable[ParameterDecl]) -> Iterator[Diagnostic]:
    """Yield the declared sizes that the application's own limits of a value do not hold, unless a default says so."""
    for parameter in parameters:
        if any(longer_than_limits(application, [parameter], "the default")):
            continue
        member, most = STRING_VALUE[1], string_size(application) - 1
        if parameter.is_array:
            member = ARRAYS.get(parameter.type, (STRINGS[1],))[0]
            most = elements_of(application, parameter.type)
        elif parameter.type != "string":
            continue
        if (parameter.size or 0) > most:
            what = f"the size of the parameter '{parameter.name}' is {parameter.size}"
            message = f"{what}, and the limit of {member} is {most}"
            limit = f"{'sequence' if parameter.is_array else 'string'}: {parameter.size}"
            if parameter.type == "string[]":
                limit += f", string: {array_string_size(application)}"
            limits = f"`limits: {{{STRING_VALUE[0]}: {{{member}: {{{limit}}}}}}}`"
            yield Diagnostic(message, parameter.span, f"Write size: {most}, or {limits}", id="MG-9852")


def _too_long(
    parameter: ParameterDecl, what: str, has: str, member: str, most: int, limit: str
) -> Diagnostic:
    message = f"{what} of the parameter '{parameter.name}' has {has}, and the limit of {member} is {most}"
    hint = f"Raise it: `limits: {{{_PACKAGE}/msg/ParameterValue: {{{member}: {limit}}}}}`"
    return Diagnostic(message, parameter.span, hint, id="MG-3098")


def string_size(application: Application) -> int:
    """Return the bytes of the longest value with its NUL: what is declared, or the application's own limit."""
    own = next(
        (rule.string for rule in application.limits if rule.path == STRING_VALUE and rule.string), None
    )
    sizes = [string_limit(p) for node in application.nodes for p in node.parameters if p.type == "string"]
    longest = own if own is not None else max(sizes, default=0)
    return longest + 1 if longest else 0


def elements_of(application: Application, kind: str) -> int:
    """Return the most elements of an array of a type: what is declared, or the application's own limit."""
    member = ARRAYS[kind][0] if kind in ARRAYS else STRINGS[1]
    path = (f"{_PACKAGE}/msg/ParameterValue", member)
    own = next((rule.sequence for rule in application.limits if rule.path == path), None)
    if own is not None:
        return own
    sizes = (p.size or 0 for node in application.nodes for p in node.parameters if p.type == kind)
    return max(sizes, default=0)


def array_string_size(application: Application) -> int:
    """Return the most bytes of a string in an array, without the NUL."""
    own = next((rule.string for rule in application.limits if rule.path == STRINGS and rule.string), None)
    defaults = (
        len(str(text).encode())
        for node in application.nodes
        for p in node.parameters
        if p.type == "string[]" and isinstance(p.default, tuple)
        for text in p.default
    )
    return own if own is not None else max(LONGEST_TEXT, *defaults, 0)
