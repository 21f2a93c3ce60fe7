# SPDX-License-Identifier: Apache-2.0
"""What a user is told about a text that is no YAML."""

from __future__ import annotations

import re

import yaml

from microros_gen.diagnostics import Diagnostic, Source, Span

# What PyYAML's scanner, parser and composer say → message and hint. First match counts.
_FAULTS: tuple[tuple[str, str, str | None], ...] = (
    (r"'\\t'", "a tab", "YAML is indented with spaces only; replace the tab by spaces"),
    (r"an odd space", "a character that looks like a space and is none", "Replace it by an ordinary space"),
    (
        r"found unexpected end of stream",
        "a quoted text does not end",
        "Close it with the quote it began with",
    ),
    (r"mapping values are not allowed", "a ':' where no key can be", "Quote a text that has ': ' in it"),
    (
        r"could not find expected ':'",
        "a line without ':'",
        "Write `key: value`, with a space after the colon",
    ),
    (
        r"expected alphabetic or numeric character, but found|while scanning an alias",
        "a text that begins with '*' or '&' is an alias or an anchor to YAML",
        'Quote it, as in "*": {string: 32}',
    ),
    (
        r"undefined alias",
        "an alias (*) to a name that no anchor (&) gives",
        "Quote a text that begins with '*'",
    ),
    (r"duplicate anchor", "an anchor (&) of this name was given before", "Use another name"),
    (
        r"but found another document",
        "a second document begins here",
        "Remove the '---' line; a file is one document",
    ),
    (r"expected ',' or '\]'", "a list in [ ] is not closed or lacks a comma", "Add ',' or ']'"),
    (r"expected ',' or '}'", "a mapping in { } is not closed or lacks a comma", "Add ',' or '}'"),
    (r"expected <block end>, but found '-'", "a list item where a key was expected", "Indent the '-' alike"),
    (
        r"expected <block end>",
        "the indentation does not fit the lines above",
        "Align the keys of one mapping",
    ),
    (
        r"sequence entries are not allowed",
        "a '-' where no list can begin",
        "Put the list on its own lines",
    ),
    (
        r"unknown escape character",
        "an unknown escape in a text",
        "Use '…' quotes, which take a backslash as it is",
    ),
    (r"found character '[@`%]'", "a text cannot begin with this character", "Put it into quotes"),
    (r"found character", "a character that cannot stand here", "Put the text into quotes"),
    (
        r"did not find expected|expected the node content",
        "a value is missing here",
        "Write it, or close what is open",
    ),
)

_BOM = "\ufeff"
_TRIED = 8
_ODD_SPACE = re.compile(r" *[\u00a0\u2000-\u200b\u202f\u3000\ufeff]")


def yaml_fault(source: Source, error: Exception) -> Diagnostic:
    """Return the diagnostic for what PyYAML raised on the text of `source`."""
    if isinstance(error, yaml.MarkedYAMLError):
        return _marked(source, error)
    if isinstance(error, yaml.reader.ReaderError):
        return _unreadable(source, error)
    if isinstance(error, RecursionError):
        return Diagnostic("nested too deeply", Span(source, 1, 1), "Flatten it", id="MG-1016")
    return Diagnostic(f"not valid YAML: {error}", Span(source, 1, 1), id="MG-1017")


def _marked(source: Source, error: yaml.MarkedYAMLError) -> Diagnostic:
    problem = error.problem or error.context or "it cannot be read"
    mark = error.problem_mark or error.context_mark
    span = Span(source, mark.line + 1, mark.column + 1) if mark else Span(source, 1, 1)
    if error.context_mark and _begins_before(source, problem, error.context_mark, span):
        span = Span(source, error.context_mark.line + 1, error.context_mark.column + 1)
    tab, space = _tab_in_indent(source, span.line), _odd_space(source, span.line, error)
    if tab:
        span, problem = tab, r"'\t'"
    if space:
        span, problem = space, "an odd space"
    for pattern, message, hint in _FAULTS:
        if re.search(pattern, problem):
            return Diagnostic(f"not valid YAML: {message}", span, hint, id="MG-1018")
    return Diagnostic(f"not valid YAML: {problem}", span, id="MG-1019")


def _begins_before(source: Source, problem: str, mark: yaml.Mark, span: Span) -> bool:
    """Return whether the fault is at `mark`, where something begins that does not end, and not where it was noticed."""
    if re.search(r"found unexpected end of stream|could not find expected ':'", problem):
        return True
    noticed = source.line(span.line)
    indent = len(noticed) - len(noticed.lstrip(" "))
    line = source.line(mark.line + 1)
    ended = not noticed.strip() or indent <= len(line) - len(line.lstrip(" "))
    return "expected ','" in problem and span.line > mark.line + 1 and ended


def _odd_space(source: Source, last: int, error: yaml.MarkedYAMLError) -> Span | None:
    """Return the place of what looks like a space before the text of a line up to `last`, and causes `error`.

    It does not where the text has the same fault with an ordinary space. Only the last few such lines are tried.
    """
    found = []
    for number in range(1, last + 1):
        line = source.line(number)
        match = _ODD_SPACE.match(line, 1 if number == 1 and line.startswith(_BOM) else 0)
        if match:
            found.append((number, match.end()))
    for number, column in found[-_TRIED:]:
        lines = source.text.splitlines(keepends=True)
        lines[number - 1] = f"{lines[number - 1][: column - 1]} {lines[number - 1][column:]}"
        if _fault_of("".join(lines)) != _of(error):
            return Span(source, number, column)
    return None


def _of(error: yaml.MarkedYAMLError) -> tuple[str | None, int | None]:
    return error.problem, error.problem_mark.line if error.problem_mark else None


def _fault_of(text: str) -> tuple[str | None, int | None] | None:
    """Return what PyYAML says of a text, and the line; None: it can be read."""
    try:
        yaml.compose(text, Loader=yaml.BaseLoader)
    except yaml.MarkedYAMLError as error:
        return _of(error)
    except (yaml.YAMLError, RecursionError):
        return None
    return None


def _tab_in_indent(source: Source, line: int) -> Span | None:
    text = source.line(line)
    indent = text[: len(text) - len(text.lstrip(" \t-"))]
    return Span(source, line, indent.index("\t") + 1) if "\t" in indent else None


def _unreadable(source: Source, error: yaml.reader.ReaderError) -> Diagnostic:
    before = source.text[: error.position]
    line = before.count("\n") + 1
    column = len(before) - (before.rfind("\n") + 1) + 1
    code = error.character if isinstance(error.character, int) else ord(error.character)
    message = f"not valid YAML: the character U+{code:04X} is not allowed in a text"
    return Diagnostic(
        message, Span(source, line, column), 'Remove it, or write it as "\\x…" in quotes', id="MG-1020"
    )
