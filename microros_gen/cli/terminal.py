# SPDX-License-Identifier: Apache-2.0
"""What only somebody at a terminal sees: colors, progress, and the command that comes next.

Without a terminal the output is plain text, always the same. NO_COLOR (no-color.org) disables colors, FORCE_COLOR and
CLICOLOR_FORCE enable them without a terminal too, CLICOLOR=0 disables them on a terminal (bixense.com/clicolors).
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import sys
from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import TextIO

import click

_SEVERITY = re.compile(r"^(?! )(.*?: )?(error|warning)(: .*?)( \[MG-\d+\])?$", re.MULTILINE)
_CARET = re.compile(r"^( +\t*)(\^~*)$", re.MULTILINE)
_LABEL = re.compile(r"^(\S[^\n]{0,9}?)(?= *  )", re.MULTILINE)
_COLORS = {"error": "red", "warning": "yellow"}
_CLEAR_LINE = "\r\x1b[K"


def wants_color(stream: TextIO, environ: Mapping[str, str] = os.environ) -> bool:
    """Return whether what goes to `stream` has colors."""
    if environ.get("NO_COLOR"):
        return False
    if any(environ.get(name, "0") not in ("", "0") for name in ("FORCE_COLOR", "CLICOLOR_FORCE")):
        return True
    return is_terminal(stream, environ) and environ.get("CLICOLOR") != "0"


def is_terminal(stream: TextIO, environ: Mapping[str, str] = os.environ) -> bool:
    """Return whether somebody reads `stream` on a terminal that can move its cursor."""
    return stream.isatty() and environ.get("TERM") != "dumb"


def echo_found(text: str) -> None:
    """Print rendered diagnostics to stderr: severity, id and caret in color."""
    color = wants_color(sys.stderr)
    click.echo(colored_diagnostics(text) if color else text, nl=False, err=True, color=color)


def echo_summary(text: str) -> None:
    """Print lines `label      value` to stdout: the labels in color."""
    color = wants_color(sys.stdout)
    styled = _LABEL.sub(lambda m: click.style(m[1], fg="cyan"), text) if color else text
    click.echo(styled, nl=False, color=color)


def colored_diagnostics(text: str) -> str:
    """Return rendered diagnostics with the severity in red or yellow, the id dimmed and the caret in green."""

    def headline(found: re.Match[str]) -> str:
        severity = click.style(found[2], fg=_COLORS[found[2]], bold=True)
        identity = click.style(found[4], dim=True) if found[4] else ""
        return f"{click.style(found[1] or '', bold=True)}{severity}{found[3]}{identity}"

    return _CARET.sub(lambda m: m[1] + click.style(m[2], fg="green"), _SEVERITY.sub(headline, text))


def next_step(command: Sequence[str]) -> None:
    """Print the command that comes next, as it can be pasted; nothing without a terminal."""
    if is_terminal(sys.stdout):
        echo_summary(f"{'next':<10} {shlex.join(command)}\n")


class Progress:
    """One line on stderr while something is compiled, removed at the end; nothing without a terminal or in CI."""

    def __init__(self, stream: TextIO | None = None, environ: Mapping[str, str] = os.environ) -> None:
        """Show progress on `stream` (default: stderr)."""
        self._stream = sys.stderr if stream is None else stream
        self._shown = is_terminal(self._stream, environ) and not environ.get("CI")

    def __call__(self, done: int, total: int, source: str) -> None:
        """Show that `done` of `total` are compiled, `source` last."""
        if self._shown:
            line = f"compiling {done} of {total}: {source}"
            width = shutil.get_terminal_size().columns - 1
            self._write(line if len(line) <= width else line[: max(0, width - 1)] + "…")

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._shown:
            self._write("")

    def _write(self, line: str) -> None:
        self._stream.write(_CLEAR_LINE + line)
        self._stream.flush()
