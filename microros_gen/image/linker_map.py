# SPDX-License-Identifier: Apache-2.0
"""Reads what a linker says of its image (`-Map`): which input section of which object lies where.

Two formats are known, those of GNU ld (binutils manual, "-Map") and of LLVM's lld.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Placed:
    """An input section of the image, in the output section `output`.

    `object` is as the linker names it: a path, or `library.a(member.o)`.
    """

    output: str
    section: str
    object: str
    address: int
    size: int


_MEMBER = re.compile(r"^(?P<archive>.*)\((?P<member>[^()]*)\)$")
_TOOL_CHAIN = re.compile(
    r"^lib(gcc\w*|clang_rt[\w.-]*|c|m|g|rt|dl|pthread|atomic|nosys|rdimon|gloss|semihost|sim|crypto?|util|quadmath|ssp|stdc\+\+|supc\+\+)"
    r"(_nano|_nonshared|-v2m|_v2m|_p|fs)*\.a$"
)


def member_of(name: str) -> tuple[str, str]:
    """Split `lib/librobot.a(app.o)` into library and member; both are empty for an object outside of a library."""
    match = _MEMBER.match(name)
    return (match["archive"], match["member"]) if match else ("", "")


def is_of_tool_chain(archive: str) -> bool:
    """Whether a library, by its name without folders, is the compiler's or the C library."""
    return _TOOL_CHAIN.match(archive) is not None


_GNU_BEGIN = "Linker script and memory map"
_GNU_OUTPUT = re.compile(r"^(?P<name>[.\w][^\s]*)(?:\s+0x[0-9a-f]+\s+0x[0-9a-f]+.*)?$")
_GNU_NAME = re.compile(r"^ (?P<name>\*?[.\w][^\s]*\*?)(?:\s+(?P<rest>0x.*))?$")
_GNU_PLACE = re.compile(r"^\s+0x(?P<address>[0-9a-f]+)\s+0x(?P<size>[0-9a-f]+)(?:\s+(?P<object>\S.*))?$")
_GNU_ONE_LINE = re.compile(
    r"^ (?P<name>[.\w][^\s]*)\s+0x(?P<address>[0-9a-f]+)\s+0x(?P<size>[0-9a-f]+)\s+(?P<object>\S.*)$"
)
_LLD_HEAD = re.compile(r"^\s*VMA\s+LMA\s+Size\s+Align\s+Out\s+In\s+Symbol$")
_LLD_OUTPUT = re.compile(r"^\s*[0-9a-f]+\s+[0-9a-f]+\s+[0-9a-f]+\s+\d+ (?P<name>\S+)$")
_LLD_LINE = re.compile(
    r"^\s*(?P<address>[0-9a-f]+)\s+[0-9a-f]+\s+(?P<size>[0-9a-f]+)\s+\d+ {9}(?P<object>\S.*):\((?P<name>[^()]*)\)$"
)


def parse_map(text: str) -> tuple[Placed, ...]:
    """Return the input sections with content, by address; empty for a text that is no known map."""
    lines = text.splitlines()
    is_lld = bool(lines) and _LLD_HEAD.match(lines[0]) is not None
    found = _lld(lines) if is_lld else _gnu(lines)
    return tuple(sorted((p for p in found if p.size), key=lambda p: (p.address, p.section, p.object)))


def _lld(lines: list[str]) -> Iterator[Placed]:
    output = ""
    for line in lines:
        head = _LLD_OUTPUT.match(line)
        if head:
            output = head["name"]
        match = _LLD_LINE.match(line)
        if match:
            yield _placed(match, output, match["name"])


def _gnu(lines: list[str]) -> Iterator[Placed]:
    output, waiting = "", ""
    for line in lines[lines.index(_GNU_BEGIN) + 1 if _GNU_BEGIN in lines else len(lines) :]:
        head = _GNU_OUTPUT.match(line)
        if head:
            output = head["name"]
        match = _GNU_ONE_LINE.match(line)
        if match:
            yield _placed(match, output, match["name"])
        else:
            match = _GNU_PLACE.match(line)
            if match and waiting and match["object"]:
                yield _placed(match, output, waiting)
        name = _GNU_NAME.match(line)
        waiting = name["name"] if name and not name["rest"] and "*" not in name["name"] else ""


def _placed(match: re.Match[str], output: str, section: str) -> Placed:
    return Placed(output, section, match["object"], int(match["address"], 16), int(match["size"], 16))
