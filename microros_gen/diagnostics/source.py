# SPDX-License-Identifier: Apache-2.0
"""Texts that the user wrote, and places in them."""

from __future__ import annotations

from dataclasses import field

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Source:
    """One text with the name that diagnostics print for it (a path as the user wrote it, or `<command line>`)."""

    name: str
    text: str = field(repr=False)

    def line(self, number: int) -> str:
        """Return line `number` (from 1) without its line end; empty beyond the end."""
        lines = self.text.splitlines()
        return lines[number - 1] if 1 <= number <= len(lines) else ""


@dataclass(frozen=True)
class Span:
    """A place in a source: line and column count from 1; `end_column` is exclusive and on the same line."""

    source: Source
    line: int
    column: int
    end_column: int | None = None

    def __str__(self) -> str:
        return f"{self.source.name}:{self.line}:{self.column}"
