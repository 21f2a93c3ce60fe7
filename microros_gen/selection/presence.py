# SPDX-License-Identifier: Apache-2.0
"""How a component appears in what the tool writes and tells: example, manifest, reports, sizes, migrated sources.

Its `component.yaml` declares it, so no module names the component for that. Texts and values refer to the plan by
paths (`streams.mtu`, `parameters.count`), as conditions do.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from microros_gen.records import dataclass
from microros_gen.selection.contribution import Conditional

EXAMPLE_FILE = "example.c.j2"
"""The template of a component's part of the example, in its folder: one macro for each point that it uses."""
EXAMPLE_POINTS = ("variables", "init", "executor", "fini", "functions", "turn")
"""The points of examples/<profile>/main.c; docs/architecture.md says where each is."""

_CONVERSION = re.compile(r"%(?:%|[-+ #0-9.*]*(hh?|ll?|[jztL])?([A-Za-z]))")
"""A conversion of printf, with its length and letter (ISO C99, 7.19.6.1); `%%` has none."""
_WIDE = {"ls": "S", "lc": "C"}
"""Letters for the conversions of wide characters, whose arguments have other types than those of `s` and `c`."""


@dataclass(frozen=True, kw_only=True)
class ExamplePart(Conditional):
    """Its part of the example: headers that this includes, and `handles` that its first executor has for it.

    `handles` is a number, or the path of one in the plan.
    """

    includes: tuple[str, ...] = ()
    handles: int | str = 0


@dataclass(frozen=True, kw_only=True)
class ManifestEntry(Conditional):
    """An entry of the manifest: a number, or the path of a value in the plan."""

    name: str
    value: int | str


@dataclass(frozen=True, kw_only=True)
class ReportRow(Conditional):
    """A line that `build` prints and a row of `resolve`; `value` and `why` may have paths of the plan in braces."""

    name: str
    value: str
    why: str = ""


@dataclass(frozen=True, kw_only=True)
class MemoryUse(Conditional):
    """What `size` says that a variable, a constant, or a member of the client, is for.

    `variable` may end with `[]` or `*`: then `use` can have `{}`, which becomes the number of the element, or the rest
    of the name up to `__`.
    """

    variable: str
    use: str


@dataclass(frozen=True)
class SelectingCall:
    """Functions and macros that select the component where migrated sources use them; `x_*`: all that begin so.

    `conversions` are letters of conversions of printf, S and C of `ls` and `lc`: only calls with one of them in a
    string count.
    """

    name: str
    conversions: str = ""

    def matches(self, function: str, texts: Iterable[str] = ()) -> bool:
        """Return whether a call of that function, with those strings among its arguments, selects the component."""
        start = self.name.removesuffix("*")
        if not (function.startswith(start) if start != self.name else function == start):
            return False
        found = {_letter(match) for text in texts for match in _CONVERSION.finditer(text)}
        return not self.conversions or not found.isdisjoint(self.conversions)


def _letter(conversion: re.Match[str]) -> str:
    """Return the letter of a conversion; empty for `%%` and for S and C, which C99 does not have."""
    length, letter = conversion.groups(default="")
    return _WIDE.get(length + letter, "" if letter in _WIDE.values() else letter)


@dataclass(frozen=True)
class Presence:
    """All of it, in the order of the component's file."""

    example: tuple[ExamplePart, ...] = ()
    manifest: tuple[ManifestEntry, ...] = ()
    reports: tuple[ReportRow, ...] = ()
    memory: tuple[MemoryUse, ...] = ()
    calls: tuple[SelectingCall, ...] = ()


ABSENT = Presence()
"""That of a component that says nothing about it."""
