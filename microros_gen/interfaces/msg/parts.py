# SPDX-License-Identifier: Apache-2.0
"""What .srv and .action files share: messages one below the other, with a line `---` between them.

As rosidl_adapter of ROS 2 Jazzy reads them: the separator is a line of exactly these three characters, each
part is read like a separate .msg file (its comment at the top, its constants and names), and may be empty.
"""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.interfaces.derived import derived_name, make_declaration
from microros_gen.interfaces.msg.names import interface_name_warning
from microros_gen.interfaces.msg.parser import checked_source, parse_part
from microros_gen.interfaces.types import Action, Message, Service, TypeName

SEPARATOR = "---"


def parse_parts(
    source: Source, name: TypeName, parts: Sequence[str], diagnostics: Diagnostics
) -> Service | Action | None:
    """Return the service or action `name` whose messages are `parts`, or None when there is an error.

    Every error and warning goes to `diagnostics`, at its line in the file; a file with too few or too many
    separators is read as far as it goes, so that its other faults are reported too.
    """
    found = Diagnostics()
    source = checked_source(source, name.package, (f"{name.name}_{part}" for part in parts), found)
    warning = interface_name_warning(name.name, parts)
    if warning is not None:
        found.warning(warning.message, Span(source, 1, 1), warning.hint, id=warning.id)
    lines = source.text.splitlines()
    borders = _borders(source, lines, parts, found)
    starts = [0, *(border + 1 for border in borders)]
    ends = [*borders, len(lines)]
    messages: list[Message] = []
    for part, start, end in zip(_names(parts, len(starts)), starts, ends, strict=True):
        messages.append(parse_part(source, start + 1, lines[start:end], derived_name(name, part), found))
    _check_equal_constants(messages, found)
    diagnostics.extend(found)
    if found.has_errors():
        return None
    return make_declaration(name, tuple(messages), messages[0].comment, Span(source, 1, 1))


def _check_equal_constants(messages: Sequence[Message], diagnostics: Diagnostics) -> None:
    """Report a constant that two parts declare alike: rosidl_parser gives both to the first part."""
    first: dict[tuple[object, ...], TypeName] = {}
    for message in messages:
        for constant in message.constants:
            key = (constant.name, constant.type, constant.value, constant.comment)
            earlier = first.setdefault(key, message.name)
            if earlier != message.name:
                diagnostics.error(
                    f"ROS 2 Jazzy takes '{constant.name}' for a constant of {earlier.name} too, because both are "
                    "declared in the same way; its C code does not compile",
                    constant.span,
                    "Give one of them another name or comment",
                    id="MG-2026",
                )


def _names(parts: Sequence[str], count: int) -> list[str]:
    """Return a name for each of `count` parts; those beyond the last are read like it."""
    return [parts[min(index, len(parts) - 1)] for index in range(count)]


def _borders(
    source: Source, lines: Sequence[str], parts: Sequence[str], diagnostics: Diagnostics
) -> list[int]:
    """Return the indices of the separators; report malformed separators, too few and too many."""
    exact, similar = [], []
    for index, line in enumerate(lines):
        if line == SEPARATOR:
            exact.append(index)
        elif _resembles(line):
            similar.append(index)
    for index in similar:
        diagnostics.error(
            f"'{lines[index].strip()}' is not a separator",
            Span(source, index + 1, 1, len(lines[index]) + 1),
            "ROS 2 takes a line of exactly three hyphens, without spaces or a comment",
            id="MG-2027",
        )
    wanted = len(parts) - 1
    for number, index in enumerate(exact[wanted:], wanted + 1):
        place = Span(source, index + 1, 1, len(SEPARATOR) + 1)
        diagnostics.error(
            f"'---' number {number}: {_kind(parts)} has {_count(wanted)}", place, _order(parts), id="MG-2028"
        )
    if len(exact) + len(similar) < wanted:
        missing = parts[len(exact) + len(similar) :]
        diagnostics.error(
            f"the line '---' before the {missing[1].lower()} is missing",
            Span(source, max(len(lines), 1), 1),
            _order(parts),
            id="MG-2029",
        )
    return sorted(exact + similar)


def _resembles(line: str) -> bool:
    text = line.partition("#")[0].strip()
    return len(text) > 1 and not text.strip("-")


def _kind(parts: Sequence[str]) -> str:
    return "a service" if len(parts) == 2 else "an action"


def _count(number: int) -> str:
    return "one" if number == 1 else "two"


def _order(parts: Sequence[str]) -> str:
    return f"Its parts are {', then '.join(part.lower() for part in parts)}; each may be empty"
