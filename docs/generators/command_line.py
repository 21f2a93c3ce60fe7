# SPDX-License-Identifier: Apache-2.0
"""The page of the command line, from the objects that click parses it with."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

import click

from generators.markdown import cell, table
from microros_gen.cli.main import cli

_INTRODUCTION = """\
Made from the program itself; `microros-gen COMMAND --help` says the same. Errors go to stderr as
`file:line:column: error: what. hint`, all of them at once; results go to stdout.
"""


def page() -> str:
    """Return the page, commands in the order of `microros-gen --help`."""
    context = click.Context(cli, info_name="microros-gen")
    parts = ["# Command line", _INTRODUCTION, *_help(cli)]
    for name, command in _commands(cli, context):
        parts += _command(command, click.Context(command, parent=context, info_name=name), level=2)
    return "\n\n".join(parts) + "\n"


def _commands(group: click.Group, context: click.Context) -> Iterator[tuple[str, click.Command]]:
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        assert command is not None
        yield name, command


def _command(command: click.Command, context: click.Context, level: int) -> Iterator[str]:
    usage = " ".join([context.command_path, *command.collect_usage_pieces(context)])
    yield f"{'#' * level} {context.command_path.removeprefix('microros-gen ')}"
    yield f"```text\n{usage}\n```"
    yield from _help(command)
    options = [p for p in command.params if isinstance(p, click.Option) and not p.hidden]
    if options:
        yield table(("option", "meaning"), [(_spelling(o, context), _meaning(o, context)) for o in options])
    if isinstance(command, click.Group):
        for name, below in _commands(command, context):
            yield from _command(below, click.Context(below, parent=context, info_name=name), level + 1)


def _help(command: click.Command) -> Iterator[str]:
    r"""Yield the paragraphs of a help text; those after a \b keep their lines."""
    for paragraph in inspect.cleandoc(command.help or "").split("\n\n"):
        if paragraph.startswith("\b"):
            yield "```text\n" + paragraph.removeprefix("\b").strip("\n") + "\n```"
        elif paragraph:
            yield cell(paragraph.replace("\f", ""))


def _spelling(option: click.Option, context: click.Context) -> str:
    record = option.get_help_record(context)
    assert record is not None
    return f"`{record[0]}`"


def _meaning(option: click.Option, context: click.Context) -> str:
    words = [cell(option.help or "")]
    default = option.get_default(context)
    if isinstance(default, str | int | float) and not isinstance(default, bool) and not option.count:
        words.append(f"Default: `{default}`.")
    if option.multiple:
        words.append("Repeatable.")
    if option.required:
        words.append("Required.")
    return " ".join(word for word in words if word)
