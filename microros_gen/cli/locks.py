# SPDX-License-Identifier: Apache-2.0
"""`microros-gen locks`: how long each task of a linked image holds the lock, and whether the analysis knows it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.options import check_map, file_option, image_option, map_option, write_result
from microros_gen.cli.tables import format_table
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.image.folder import Folder
    from microros_gen.image.lock_holds import TaskHold

_HEAD = ("TASK", "INSTRUCTIONS", "USED", "LONGEST IN")
_UNKNOWN = "-"
_SHOWN = 3


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@image_option("Your own image to measure, linked with the library of OUT. Default: the image that was built.")
@map_option
@click.option(
    "--port",
    type=click.IntRange(min=0),
    metavar="N",
    help="Instructions of a call of a function of the port (port_…) that has no bound, as a driver that waits.",
)
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "yaml")),
    help="A table, JSON with each place that takes the lock, or the numbers for tasks with `lock: auto`."
    " Default: yaml with -o, else table.",
)
@file_option
def command(
    out: Path,
    image: Path | None,
    linker_map: Path | None,
    port: int | None,
    kind: str | None,
    output: Path | None,
) -> None:
    """Show for how many instructions each task of OUT holds the library's lock at most.

    INSTRUCTIONS is the longest path from a call that takes the lock to the one that releases it, in all functions that
    the task reaches, callbacks included, USED what the analysis of deadlines used. The exit status is 1 if a task with
    `lock: auto` has no bound, or a larger one than the analysis used.

    \b
    microros-gen locks build --image firmware.elf
    microros-gen locks build --image firmware.elf -o microros.locks.yaml
    """
    check_map(image, linker_map)
    from microros_gen.image.folder import read_folder

    folder = read_folder(out, image, linker_map)
    holds = _measured(folder, port)
    if not holds:
        hint = "Declare them in the application file: `tasks: [{name: control, executor: NAME}]`"
        raise UserError([Diagnostic(f"{out} has no tasks", hint=hint, id="MG-7151")])
    echo_found("".join(f"{note.render()}\n" for note in _notes(folder, holds)))
    kind = kind or ("table" if output is None else "yaml")
    if kind == "yaml":
        _refuse(_unbounded(holds))
    write_result({"table": _table, "json": _json, "yaml": _yaml}[kind](holds), output)
    if kind != "yaml":
        _refuse([*_unbounded(holds), *_longer(holds)])


def check_locks(folder: Folder) -> None:
    """Compare the tasks with `lock: auto` with their image, where there is one. Raises UserError with status 1.

    What the port adds is in the number that was written: a function of it without a bound does not count again.
    """
    from microros_gen.image.lock_holds import has_automatic

    if folder.image is not None and has_automatic(folder.manifest):
        holds = [hold for hold in _measured(folder, 0) if hold.automatic]
        open_ones = _unbounded(holds)
        _refuse([*(_notes(folder, holds) if open_ones else ()), *open_ones, *_longer(holds)])


def _notes(folder: Folder, holds: Sequence[TaskHold]) -> Sequence[Diagnostic]:
    """Return why the images of a target have no bounds, where one of `holds` has none."""
    from microros_gen.image.lock_holds import target_notes

    return target_notes(folder.manifest) if any(hold.open for hold in holds) else ()


def _measured(folder: Folder, port: int | None) -> tuple[TaskHold, ...]:
    from microros_gen.image.elf import Elf
    from microros_gen.image.lock_holds import task_holds
    from microros_gen.image.report import measure_folder

    if folder.image is None:
        message = f"{folder.path} has no image: only a linked one has every path"
        raise UserError([Diagnostic(message, hint="Give yours: --image FILE", id="MG-7152")], status=1)
    image = Elf(folder.image)
    return task_holds(measure_folder(folder, image), image, port)


def _refuse(found: Sequence[Diagnostic]) -> None:
    if found:
        raise UserError(found, status=1)


def _unbounded(holds: Sequence[TaskHold]) -> list[Diagnostic]:
    return [
        Diagnostic(
            f"how long the task '{hold.name}' holds the lock has no bound: {'; '.join(hold.open[:_SHOWN])}",
            hint="Write a time instead of auto: `lock: 40 us`, or give --port N for functions of the port",
            id="MG-7153",
        )
        for hold in holds
        if hold.automatic and hold.instructions is None
    ]


def _longer(holds: Sequence[TaskHold]) -> list[Diagnostic]:
    return [
        Diagnostic(
            f"the task '{hold.name}' may hold the lock for {hold.instructions} instructions, and the analysis of"
            f" deadlines used {hold.used}",
            hint="Write the numbers again (`microros-gen locks … -o microros.locks.yaml`), and build",
            id="MG-7154",
        )
        for hold in holds
        if hold.automatic and hold.used and hold.instructions is not None and hold.instructions > hold.used
    ]


def _table(holds: Sequence[TaskHold]) -> str:
    return format_table(_HEAD, _rows(holds))


def _rows(holds: Sequence[TaskHold]) -> Iterator[tuple[str, ...]]:
    for hold in holds:
        number = _UNKNOWN if hold.instructions is None else str(hold.instructions)
        longest = hold.holds[0].function if hold.holds else ""
        more = f"; {len(hold.open) - _SHOWN} more (--format json)" if len(hold.open) > _SHOWN else ""
        shown = f"no bound: {'; '.join(hold.open[:_SHOWN])}{more}" if hold.open else longest
        yield (hold.name, number, str(hold.used) if hold.used else _UNKNOWN, shown)


def _json(holds: Sequence[TaskHold]) -> str:
    rows = [
        {
            "task": hold.name,
            "instructions": hold.instructions,
            "used": hold.used or None,
            "auto": hold.automatic,
            "open": list(hold.open),
            "holds": [
                {
                    "function": each.function,
                    "instructions": None if each.length.open else each.length.count,
                    "open": sorted(each.length.open),
                }
                for each in hold.holds
            ],
        }
        for hold in holds
    ]
    return json.dumps({"version": 1, "tasks": rows}, indent=2, sort_keys=True) + "\n"


def _yaml(holds: Sequence[TaskHold]) -> str:
    """Return the file that the application file's tasks with `lock: auto` read."""
    numbers = [f"{hold.name}: {hold.instructions}" for hold in holds if hold.automatic]
    head = "# Instructions for which tasks with `lock: auto` hold the lock, written by microros-gen locks"
    return "\n".join((head, *(numbers or ["{}"]))) + "\n"
