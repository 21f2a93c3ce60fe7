# SPDX-License-Identifier: Apache-2.0
"""`microros-gen schedule`: whether the tasks of what was built meet their deadlines, and why."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from microros_gen.cli.options import file_option, write_result
from microros_gen.cli.tables import format_table
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.diagnostics.notes import KEY, note_data, notes_of
from microros_gen.documents.files import read_json
from microros_gen.image.records import locate
from microros_gen.output.tree import MANIFEST
from microros_gen.schedule.report import HEAD, schedule_data, schedule_of, schedule_rows
from microros_gen.schedule.response import Response
from microros_gen.schedule.timeline import draw


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "svg")),
    default="table",
    show_default=True,
    help="A table, JSON, or a time line as a picture.",
)
@click.option(
    "--task",
    "name",
    metavar="NAME",
    help="Task whose worst case the time line shows. Default: that with the least slack.",
)
@file_option
def command(out: Path, kind: str, name: str | None, output: Path | None) -> None:
    """Show the response-time analysis of the tasks of OUT, the highest priority first. Times are microseconds.

    OUT is a folder that `build` or `generate` wrote, or a CMake build folder. T is the period or the shortest interval
    of a task, C its longest execution time, B how long a task of lower priority can block it, R its longest response,
    D its deadline. C FROM and B FROM say what these numbers follow from; priority 1 is the highest. The build refuses
    a deadline that is missed (R greater than D).

    \b
    microros-gen schedule build/robot
    microros-gen schedule build/robot --format json | jq '.tasks[] | {task, slack}'
    microros-gen schedule build/robot --format svg --task control -o control.svg
    """
    if name is not None and kind != "svg":
        raise click.UsageError("--task chooses the time line of --format svg.")
    responses, notes = _analysis(locate(out).output)
    echo_found("".join(f"{note.render()}\n" for note in notes))
    if kind == "table":
        text = format_table(HEAD, schedule_rows(responses))
    elif kind == "json":
        data = {"version": 1, "tasks": schedule_data(responses), KEY: [*map(note_data, notes)]}
        text = json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
    else:
        text = draw(responses, _chosen(responses, name))
    write_result(text, output)


def _analysis(out: Path) -> tuple[tuple[Response, ...], Sequence[Diagnostic]]:
    """Return the analysis that is in the manifest of `out`, and the warnings about its numbers."""
    path = out / MANIFEST
    try:
        data: Any = read_json(path, follow=False)
        values = data.get("features", {}).get("tasks", {}).get("values", {})
        lacking = ", ".join(values.get("not_analyzed", ()))
        responses, notes = schedule_of(values.get("schedule", ())), _used(values)
    except (ArithmeticError, AttributeError, KeyError, TypeError, ValueError) as error:
        message = f"{path} was not written by this version of microros-gen"
        hint = "Generate the folder again"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9742")]) from error
    if lacking:
        message = f"the deadlines of {out} were not analyzed: {lacking}"
        hint = "Write `time` for each task, and for the session `{name: session, session: true, interval: …, time: …}`"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9741")])
    if not responses:
        message = f"{out} has no tasks"
        hint = "Declare them in microros.yaml: `tasks: [{name: control, executor: NAME, rate: 100 Hz, time: 1 ms}]`"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9740")])
    return responses, notes


def _used(values: Mapping[str, Any]) -> Sequence[Diagnostic]:
    """Return the warnings of the manifest where the analysis lacks the number that they are about."""
    notes = notes_of(values)
    return notes if any(task["lock_auto"] for task in values.get("tasks", ())) else ()


def _chosen(responses: tuple[Response, ...], name: str | None) -> str:
    """Return the name of the task that the picture is of."""
    names = [response.task.name for response in responses]
    if name is None:
        return min(responses, key=lambda response: response.slack_us or 0).task.name
    if name not in names:
        hint = nearest(name, names) or f"Tasks: {', '.join(names)}"
        raise click.UsageError(f"no task '{name}'. {hint}")
    return name
