# SPDX-License-Identifier: Apache-2.0
"""`microros-gen stacks`: the stack that each task of a linked image needs, and whether it has it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.options import check_map, file_option, image_option, map_option, write_result
from microros_gen.cli.tables import format_table
from microros_gen.diagnostics import Diagnostic, UserError

if TYPE_CHECKING:
    from microros_gen.image.folder import Folder
    from microros_gen.image.task_stacks import TaskStack

_HEAD = ("TASK", "CHAIN", "CONTEXT", "NEEDS", "HAS", "THROUGH")
_UNKNOWN = "-"
_SHOWN = 3


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@image_option("Your own image to measure, linked with the library of OUT. Default: the image that was built.")
@map_option
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "yaml")),
    help="A table, JSON, or the sizes for tasks with `stack: auto`. Default: yaml with -o, else table.",
)
@file_option
def command(
    out: Path, image: Path | None, linker_map: Path | None, kind: str | None, output: Path | None
) -> None:
    """Show the stack that each task of OUT needs, in bytes.

    CHAIN is the heaviest chain of calls from the entry of the task, callbacks included, CONTEXT what the operating
    system adds. NEEDS is their sum with a margin of 10 % of the chain, HAS the size of the stack. The exit status is 1
    if a stack is smaller than chain and context, or if a task with `stack: auto` has no bound.

    \b
    microros-gen stacks build --image firmware.elf
    microros-gen stacks build --image firmware.elf -o microros.stacks.yaml
    """
    check_map(image, linker_map)
    from microros_gen.image.folder import read_folder

    stacks = _measured(read_folder(out, image, linker_map))
    if not stacks:
        hint = "Declare them in the application file: `tasks: [{name: control, executor: NAME}]`"
        raise UserError([Diagnostic(f"{out} has no tasks", hint=hint, id="MG-7148")])
    kind = kind or ("table" if output is None else "yaml")
    if kind == "yaml":
        _refuse(_unbounded(stacks))
    write_result({"table": _table, "json": _json, "yaml": _yaml}[kind](stacks), output)
    if kind != "yaml":
        _refuse([*_unbounded(stacks), *_small(stacks)])


def check_stacks(folder: Folder) -> None:
    """Compare the tasks with `stack: auto` with their image, where there is one. Raises UserError with status 1."""
    from microros_gen.image.task_stacks import has_automatic

    if folder.image is not None and has_automatic(folder.manifest):
        stacks = [stack for stack in _measured(folder) if stack.automatic]
        _refuse([*_unbounded(stacks), *_small(stacks)])


def _measured(folder: Folder) -> tuple[TaskStack, ...]:
    from microros_gen.image.link_time import refuse_remade
    from microros_gen.image.report import measure_folder
    from microros_gen.image.task_stacks import task_stacks

    report = measure_folder(folder)
    refuse_remade(folder, report.chunks)
    if report.graph is None or not report.graph.compiled:
        raise UserError([Diagnostic(f"no stack is known: {report.stack.why}", id="MG-7147")], status=1)
    return task_stacks(folder.manifest, report.graph)


def _refuse(found: Sequence[Diagnostic]) -> None:
    if found:
        raise UserError(found, status=1)


def _unbounded(stacks: Sequence[TaskStack]) -> list[Diagnostic]:
    return [
        Diagnostic(
            f"the stack of the task '{stack.name}' has no bound: {'; '.join(stack.open[:_SHOWN])}",
            hint="Write its size instead of auto: `stack: 4 KiB`",
            id="MG-7149",
        )
        for stack in stacks
        if stack.automatic and stack.needs is None
    ]


def _small(stacks: Sequence[TaskStack]) -> list[Diagnostic]:
    again = "Write the sizes again (`microros-gen stacks … -o microros.stacks.yaml`), and build"
    return [
        Diagnostic(
            f"the task '{stack.name}' may need {stack.needs} bytes of stack with the margin, and has {stack.size}",
            hint=again if stack.automatic else f"Write stack: {stack.needs}",
            id="MG-7134",
        )
        for stack in stacks
        if stack.needs is not None and not stack.fits
    ]


def _table(stacks: Sequence[TaskStack]) -> str:
    return format_table(_HEAD, _rows(stacks))


def _rows(stacks: Sequence[TaskStack]) -> Iterator[tuple[str, ...]]:
    for stack in stacks:
        chain = stack.bound.chain if stack.bound is not None else ()
        through = " > ".join(link.name for link in chain)
        numbers = (
            stack.bound.bytes if stack.bound is not None else None,
            stack.context,
            stack.needs,
            stack.size,
        )
        shown = (_UNKNOWN if number is None else str(number) for number in numbers)
        yield (stack.name, *shown, f"no bound: {'; '.join(stack.open)}" if stack.open else through)


def _json(stacks: Sequence[TaskStack]) -> str:
    rows = [
        {
            "task": stack.name,
            "chain": stack.bound.bytes if stack.bound is not None else None,
            "context": stack.context,
            "needs": stack.needs,
            "has": stack.size,
            "fits": stack.fits,
            "auto": stack.automatic,
            "through": [link.name for link in stack.bound.chain] if stack.bound is not None else [],
            "open": list(stack.open),
        }
        for stack in stacks
    ]
    return json.dumps({"version": 1, "tasks": rows}, indent=2, sort_keys=True) + "\n"


def _yaml(stacks: Sequence[TaskStack]) -> str:
    """Return the file that the application file's tasks with `stack: auto` read."""
    sizes = [f"{stack.name}: {stack.needs}" for stack in stacks if stack.automatic]
    head = "# Bytes of the stacks of tasks with `stack: auto`, written by microros-gen stacks"
    return "\n".join((head, *(sizes or ["{}"]))) + "\n"
