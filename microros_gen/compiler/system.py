# SPDX-License-Identifier: Apache-2.0
"""Checks a system: plans each board of a system file as a build does, and keeps everything that is wrong."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from microros_gen.application.system_can import bus_boards
from microros_gen.application.system_file import SystemFile
from microros_gen.application.system_find import read_board, read_system
from microros_gen.client.views.presence import report_rows
from microros_gen.compiler.api import plan, read, resolve
from microros_gen.compiler.options import Options
from microros_gen.compiler.pipeline import Planned
from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity, UserError
from microros_gen.diagnostics.data import diagnostic_data
from microros_gen.records import dataclass

AGREES, DIFFERS, OPEN = "agrees", "differs", "not compared"


@dataclass(frozen=True)
class Neighbor:
    """A board that another one exchanges messages with; `over` is udp, serial or chip."""

    board: str
    over: str


@dataclass(frozen=True)
class CheckedBoard:
    """A board; `errors` are those of its build. `missing`: boards that it cannot be compared with.

    `rows`: name and value of what a build says about the system.
    """

    name: str
    application: str
    neighbors: tuple[Neighbor, ...]
    errors: int
    missing: tuple[str, ...] = ()
    rows: tuple[tuple[str, str], ...] = ()

    @property
    def result(self) -> str:
        """Return whether it agrees with its neighbors."""
        if self.errors:
            return DIFFERS
        return OPEN if self.missing else AGREES

    @property
    def shown(self) -> str:
        """Return its result with numbers or names."""
        if self.errors:
            return f"{self.errors} error{'s' if self.errors > 1 else ''}"
        return f"{OPEN}: see {', '.join(self.missing)}" if self.missing else AGREES

    def data(self) -> dict[str, Any]:
        """Return it as data for JSON."""
        return {
            "name": self.name,
            "application": self.application,
            "result": self.result,
            "errors": self.errors,
            "not_compared_with": list(self.missing),
            "neighbors": [{"board": each.board, "over": each.over} for each in self.neighbors],
            "reports": dict(self.rows),
        }


@dataclass(frozen=True)
class CheckedSystem:
    """The result of a check of the system file `file`; without boards where that is wrong itself."""

    file: str
    boards: tuple[CheckedBoard, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def result(self) -> str:
        """Return whether all boards agree: a build of each would succeed."""
        wrong = any(d.severity is Severity.ERROR for d in self.diagnostics)
        return DIFFERS if wrong else AGREES

    @property
    def exit_status(self) -> int:
        """Return 0 where all agree, else 2."""
        return 0 if self.result == AGREES else 2

    def data(self) -> dict[str, Any]:
        """Return it as data for JSON."""
        return {
            "version": 1,
            "system": self.file,
            "result": self.result,
            "boards": [board.data() for board in self.boards],
            "findings": [diagnostic_data(d) for d in self.diagnostics],
        }


def check_system(path: Path, interface_paths: tuple[Path, ...] = ()) -> CheckedSystem:
    """Return what a build of each board of a system file would report, of all boards together. Writes nothing.

    A board whose application cannot be read is not planned, and neither are the boards that are linked with it or on
    the same CAN bus: their result is `not compared`. `interface_paths` are those of the option of the same name.
    """
    diagnostics = Diagnostics()
    found = read_system(path, None, diagnostics)
    if found is None:
        return CheckedSystem(str(path), (), tuple(diagnostics))
    system, _ = found
    unread = {
        name: errors for name in system.boards if (errors := _reading_errors(name, system, path, diagnostics))
    }
    boards = []
    for name, named in system.boards.items():
        config = Path(os.path.normpath(path.parent / named.name))
        neighbors = tuple(_neighbors(name, system))
        read_with = (*(each.board for each in neighbors), *bus_boards(system.links, name))
        missing = tuple(dict.fromkeys(board for board in read_with if board in unread))
        errors = unread.get(name, 0)
        rows: tuple[tuple[str, str], ...] = ()
        if not errors and not missing:
            errors, rows = _planning_errors(
                Options(config=config, interface_paths=interface_paths), diagnostics
            )
        boards.append(CheckedBoard(name, str(config), neighbors, errors, missing, rows))
    return CheckedSystem(str(path), tuple(boards), tuple(diagnostics))


def _neighbors(board: str, system: SystemFile) -> Iterator[Neighbor]:
    joined = [(link.kind, [name for name, _ in link.ends]) for link in system.links]
    joined += [("chip", list(chip.names)) for chip in system.chips]
    for over, names in joined:
        if board in names:
            yield from (Neighbor(name, over) for name in names if name != board)


def _reading_errors(board: str, system: SystemFile, path: Path, diagnostics: Diagnostics) -> int:
    found = Diagnostics()
    read_board(board, system, path, found)
    diagnostics.extend(found)
    return _errors(found)


def _planning_errors(options: Options, diagnostics: Diagnostics) -> tuple[int, tuple[tuple[str, str], ...]]:
    """Return the number of errors of a board, and what a build of it says about the system."""
    try:
        planned = plan(resolve(read(options)))
    except UserError as error:
        diagnostics.extend(error.diagnostics)
        return _errors(error.diagnostics), ()
    diagnostics.extend(planned.warnings)
    return 0, _rows(planned)


def _rows(planned: Planned) -> tuple[tuple[str, str], ...]:
    return tuple((name, text) for name, text, why in report_rows(planned.project) if why == "system")


def _errors(diagnostics: Iterable[Diagnostic]) -> int:
    return sum(d.severity is Severity.ERROR for d in diagnostics)
