# SPDX-License-Identifier: Apache-2.0
"""Diagnostics: collected while a step goes on, raised together at its end, printed by the command line."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from enum import Enum

from microros_gen.diagnostics.source import Span
from microros_gen.records import dataclass

LONGEST_LINE = 160
"""Characters that are shown of a source line."""

LONGEST_WORD = 400
"""Characters that are shown of one word of a message, such as a name from the input."""

_LONG_WORD = re.compile(rf"\S{{{LONGEST_WORD + 1},}}")


class Severity(Enum):
    """How bad it is: an error ends the run, a warning does not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True)
class Diagnostic:
    """One message to the user: what is wrong (`message`), where (`span`), and what to do (`hint`).

    `block` contains lines to paste into the file, printed after the source line. `too_large`: a message exceeds its
    stream, so lower limits would help; `mtu` is the `transport.mtu` in bytes that would help, too, if the
    transport can have it (0: none). `id` (`MG-3012`) is stable across versions; `microros-gen explain` explains it.
    """

    message: str
    span: Span | None = None
    hint: str | None = None
    severity: Severity = Severity.ERROR
    block: tuple[str, ...] = ()
    too_large: bool = False
    mtu: int = 0
    id: str = ""

    def headline(self) -> str:
        """Return `file:line:col: error: what. hint [id]` (without a place: `microros-gen: error: …`)."""
        where = str(self.span) if self.span else "microros-gen"
        text = f"{where}: {self.severity.value}: {self.message}"
        text = _shortened(f"{text}. {self.hint}" if self.hint else text)
        return f"{text} [{self.id}]" if self.id else text

    def render(self) -> str:
        """Return the headline, then the source line with a caret below the place where there is one, then the block."""
        return "\n".join((self._placed(), *self.block))

    def _placed(self) -> str:
        if self.span is None:
            return self.headline()
        line = self.span.source.line(self.span.line)
        if not line.strip():
            return self.headline()
        line, column, end = _shown(line.rstrip(), self.span)
        lead = "".join("\t" if c == "\t" else " " for c in line[: column - 1])
        caret = "^" + "~" * max(0, end - column - 1)
        return f"{self.headline()}\n  {line}\n  {lead}{caret}"


def _shortened(message: str) -> str:
    """Return the message with each long word (a name from the input) cut; a compiler's many lines stay."""
    return _LONG_WORD.sub(lambda word: f"{word.group()[:LONGEST_WORD]}…", message)


def _shown(line: str, span: Span) -> tuple[str, int, int]:
    """Return what is shown of a line, and the columns of the place in it: of a long line the part around the place."""
    begin, end = span.column, min(span.end_column or span.column + 1, len(line) + 1)
    first = max(0, begin - 1 - LONGEST_LINE // 2) if len(line) > LONGEST_LINE else 0
    part = line[first : first + LONGEST_LINE]
    head, tail = "…" if first else "", "…" if first + len(part) < len(line) else ""
    moved = len(head) - first
    return f"{head}{part}{tail}", begin + moved, min(end + moved, len(head) + len(part) + 1)


class UserError(Exception):
    """The exception for user mistakes.

    `diagnostics` are all of the step that raised it, errors and warnings in the order of discovery; `status` is the
    exit status of the command line: 1 for failed checks and compilations, 2 for wrong input.
    """

    def __init__(self, diagnostics: Iterable[Diagnostic], status: int = 2) -> None:
        """Hold `diagnostics` (at least one); `status` is the exit status that the command line ends with."""
        self.diagnostics = tuple(diagnostics)
        self.status = status
        super().__init__("\n".join(d.headline() for d in self.diagnostics))


class Diagnostics:
    """A collector: a step adds what it finds and goes on; `check()` at its end raises all errors at once."""

    def __init__(self) -> None:
        self._found: list[Diagnostic] = []

    def error(self, message: str, span: Span | None = None, hint: str | None = None, *, id: str) -> None:
        """Add an error."""
        self._add(Diagnostic(message, span, hint, id=id))

    def too_large(self, message: str, span: Span | None, hint: str, *, id: str, mtu: int = 0) -> None:
        """Add an error that lower limits would fix, or a `transport.mtu` of `mtu` bytes if that is not 0."""
        self._add(Diagnostic(message, span, hint, too_large=True, mtu=mtu, id=id))

    def warning(self, message: str, span: Span | None = None, hint: str | None = None, *, id: str) -> None:
        """Add a warning."""
        self._add(Diagnostic(message, span, hint, Severity.WARNING, id=id))

    def add(self, diagnostic: Diagnostic) -> None:
        """Add a diagnostic as it is."""
        self._add(diagnostic)

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add what another step found."""
        for diagnostic in diagnostics:
            self._add(diagnostic)

    def check(self) -> None:
        """Raise `UserError` with everything found when there is an error among it."""
        if self.has_errors():
            raise UserError(self._found)

    def has_errors(self) -> bool:
        """Return whether an error was added."""
        return any(d.severity is Severity.ERROR for d in self._found)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self._found)

    def _add(self, diagnostic: Diagnostic) -> None:
        if diagnostic not in self._found:
            self._found.append(diagnostic)


_ENDING = re.compile(r"_?(msgs?|srvs?|actions?|interfaces?|messages?)$")
_ENDINGS = ("msgs", "srvs", "actions", "interfaces", "messages")


def nearest_package(name: str, known: Iterable[str]) -> str | None:
    """Return the hint `did you mean 'x'?` for a package of interfaces, or None.

    What such names end in, as _msgs, makes no two of them alike.
    """
    packages = sorted(known)
    stems = {package: _stem(package) for package in packages}
    close = difflib.get_close_matches(_stem(name), stems.values(), n=1, cutoff=0.7)
    return nearest(name, [package for package in packages if stems[package] == close[0]]) if close else None


def _stem(package: str) -> str:
    """Return the name of a package without what such names end in, also if that is misspelled."""
    name = package.lower()
    head, _, last = name.rpartition("_")
    if head and difflib.get_close_matches(last, _ENDINGS, n=1, cutoff=0.75):
        return head
    return _ENDING.sub("", name) or name


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the hint `did you mean 'x'?` for the known name closest to `name`, or None when none is close."""
    choices = sorted(known)
    close = difflib.get_close_matches(name, choices, n=1, cutoff=0.55) or difflib.get_close_matches(
        name.lower(), [c.lower() for c in choices], n=1, cutoff=0.55
    )
    if not close:
        return None
    match = next(c for c in choices if close[0] in (c, c.lower()))
    return f"Did you mean '{match}'?"
