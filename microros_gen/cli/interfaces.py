# SPDX-License-Identifier: Apache-2.0
"""`microros-gen interfaces`: what packages and types there are, and what one of them looks like."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import click

from microros_gen.cli.offers import interface_names
from microros_gen.cli.options import interface_path_option
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity, UserError
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.derived import declaring_name, parts_of
from microros_gen.interfaces.find import InterfaceFinder, types_in
from microros_gen.interfaces.msg.text import type_text, value_text
from microros_gen.interfaces.types import Action, Constant, Declaration, Field, Message, Service, Value
from microros_gen.output.interface_files import one_idl, write_descriptions, write_idl


@click.command()
@click.argument("name", required=False, shell_complete=interface_names)
@interface_path_option
@click.option(
    "--format",
    "form",
    type=click.Choice(["table", "json", "idl"]),
    default="table",
    show_default=True,
    help="Tables, JSON (of one type, with its type description), or OMG IDL for DDS tools.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write files DIR/<pkg>/<kind>/<Type>.idl (or .json); IDL with all included files.",
)
@click.option(
    "--portable",
    is_flag=True,
    help="IDL for compilers of DDS vendors: include guards, escaped keywords. ROS 2's own reader accepts neither.",
)
def command(
    name: str | None, interface_paths: tuple[Path, ...], form: str, output: Path | None, portable: bool
) -> None:
    """List interface packages, the types of one (NAME = pkg), or one message, service or action (NAME = pkg/Type).

    Packages are searched in --interface-path, AMENT_PREFIX_PATH, packages installed by pip, and the interfaces included
    in this tool, in this order. The first match hides the others.

    \b
    microros-gen interfaces
    microros-gen interfaces sensor_msgs
    microros-gen interfaces sensor_msgs/msg/Imu
    microros-gen interfaces std_srvs/srv/SetBool --format json
    microros-gen interfaces sensor_msgs/msg/Imu --format idl
    microros-gen interfaces sensor_msgs --format idl --portable -o idl
    """
    if form == "table" and output is not None:
        raise click.UsageError("-o writes files of IDL or JSON: add --format idl or --format json")
    if form != "idl" and portable:
        raise click.UsageError("--portable is about IDL: add --format idl")
    finder = InterfaceFinder.from_environment(interface_paths)
    diagnostics = Diagnostics()
    finder.check_paths(diagnostics)
    diagnostics.check()
    if form == "idl" or output is not None:
        _files(_asked(finder, name, diagnostics), form, output, portable, diagnostics)
        return
    if name is None:
        data, lines = _packages(finder)
    elif "/" not in name.strip("/"):
        data, lines = _package(finder, name.strip("/"), diagnostics)
    else:
        data, lines = _type(finder, name, diagnostics)
    _warn(diagnostics)
    if form == "json":
        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    else:
        click.echo("\n".join(lines))


def _files(
    interfaces: InterfaceSet, form: str, output: Path | None, portable: bool, diagnostics: Diagnostics
) -> None:
    """Print one .idl file, or write files."""
    if output is None:
        text = one_idl(interfaces, portable, diagnostics)
        _warn(diagnostics)
        click.echo(text, nl=False)
        return
    idl = form == "idl"
    files, changed = (
        write_idl(interfaces, output, portable, diagnostics)
        if idl
        else write_descriptions(interfaces, output)
    )
    _warn(diagnostics)
    click.echo(f"{output}: {changed} files written, {files - changed} unchanged")


def _asked(finder: InterfaceFinder, name: str | None, diagnostics: Diagnostics) -> InterfaceSet:
    """Return the type, the package, or with no name every package."""
    if name is not None:
        return _resolved(finder, name.strip("/"), diagnostics)
    packages = tuple(Named(place.name) for place in finder.packages() if types_in(place))
    interfaces = resolve_interfaces(packages, finder, diagnostics)
    diagnostics.check()
    return interfaces


def _packages(finder: InterfaceFinder) -> tuple[Any, list[str]]:
    data = [
        {
            "package": place.name,
            "types": len(types_in(place)),
            "origin": place.origin.value,
            "folder": str(place.folder),
        }
        for place in finder.packages()
    ]
    rows = [[str(value) for value in entry.values()] for entry in data]
    return data, _table(["package", "types", "origin", "folder"], rows)


def _package(finder: InterfaceFinder, name: str, diagnostics: Diagnostics) -> tuple[Any, list[str]]:
    interfaces = _resolved(finder, name, diagnostics)
    place = interfaces.interfaces[interfaces.roots[0]].place
    types = [
        {
            "type": str(root),
            "hash": interfaces.type_hash(root),
            "comment": list(interfaces.interfaces[root].declaration.comment),
        }
        for root in interfaces.roots
    ]
    data = {"package": name, "origin": place.origin.value, "folder": str(place.folder), "types": types}
    rows = [[str(entry["type"]), "".join(entry["comment"][:1])] for entry in types]
    return data, [f"{name} ({place.origin.value}: {place.folder})", "", *_table(["type", "comment"], rows)]


def _type(finder: InterfaceFinder, name: str, diagnostics: Diagnostics) -> tuple[Any, list[str]]:
    interfaces = _resolved(finder, name, diagnostics)
    root = interfaces.roots[0]
    interface = interfaces.interfaces[declaring_name(root)]
    declaration = interfaces.declaration(root)
    data = {
        "type": str(root),
        "hash": interfaces.type_hash(root),
        "origin": interface.place.origin.value,
        "file": interface.source.name,
        "comment": list(declaration.comment),
        **_contents(declaration, interfaces),
        "dependencies": [str(needed) for needed in interfaces.closure(root)],
        **interfaces.hashed_description(root),
    }
    lines = [str(root), *(f"  {line}".rstrip() for line in declaration.comment)]
    lines += ["", f"  hash    {data['hash']}", f"  origin  {data['origin']}: {data['file']}"]
    lines += _message_lines(declaration) if isinstance(declaration, Message) else _part_lines(declaration)
    if data["dependencies"]:
        lines += ["", "  made of", *(f"  {needed}" for needed in data["dependencies"])]
    return data, lines


def _contents(declaration: Declaration, interfaces: InterfaceSet) -> dict[str, Any]:
    """Return what is declared: the members of a message, or the parts of a service or action and the rest."""
    if isinstance(declaration, Message):
        return _members(declaration)
    own = f"{declaration.name}_"
    derived = [name for name in interfaces.described if str(name).startswith(own)]
    return {
        "parts": {
            part.lower(): {"type": str(message.name), "comment": list(message.comment), **_members(message)}
            for part, message in parts_of(declaration)
        },
        "derived": [{"type": str(name), "hash": interfaces.type_hash(name)} for name in derived],
    }


def _members(message: Message) -> dict[str, Any]:
    return {
        "constants": [_entry(constant, constant.value) for constant in message.constants],
        "fields": [_entry(field, field.default) for field in message.fields],
    }


def _part_lines(declaration: Service | Action) -> list[str]:
    lines: list[str] = []
    for part, message in parts_of(declaration):
        empty = "" if message.fields or message.constants else " (empty)"
        lines += ["", f"  {part.lower()}{empty}", *(f"    {line}".rstrip() for line in message.comment)]
        lines += [f"  {line}".rstrip() for line in _message_lines(message)]
    return lines


def _message_lines(message: Message) -> list[str]:
    lines: list[str] = []
    for title, value in (("constants", "value"), ("fields", "default")):
        entries: Sequence[Constant | Field] = message.constants if title == "constants" else message.fields
        if entries:
            rows = [_row(entry) for entry in entries]
            lines += ["", *(f"  {line}".rstrip() for line in _table([title, "type", value, "comment"], rows))]
    return lines


def _row(entry: Constant | Field) -> list[str]:
    value = entry.value if isinstance(entry, Constant) else entry.default
    shown = "" if value is None else value_text(value)
    return [entry.name, type_text(entry.type), shown, " ".join(entry.comment)]


def _entry(entry: Constant | Field, value: Value | None) -> dict[str, Any]:
    key = "value" if isinstance(entry, Constant) else "default"
    return {"name": entry.name, "type": type_text(entry.type), key: value, "comment": list(entry.comment)}


def _resolved(finder: InterfaceFinder, name: str, diagnostics: Diagnostics) -> InterfaceSet:
    interfaces = resolve_interfaces((Named(name),), finder, diagnostics)
    diagnostics.check()
    if not interfaces.roots:
        raise UserError([Diagnostic(f"'{name}' has no interface", id="MG-9713")])
    return interfaces


def _warn(diagnostics: Iterable[Diagnostic]) -> None:
    for diagnostic in diagnostics:
        if diagnostic.severity is Severity.WARNING:
            echo_found(f"{diagnostic.render()}\n")


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return lines with columns as wide as their widest entry; the last one is as long as it is."""
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head) - 1)]
    return [
        "  ".join([*(cell.ljust(width) for cell, width in zip(row, widths, strict=False)), row[-1]]).rstrip()
        for row in [head, *rows]
    ]
