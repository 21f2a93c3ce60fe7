# SPDX-License-Identifier: Apache-2.0
"""`microros-gen schema [NAME]`: the JSON Schemas of the tool's files, for editors."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.offers import schema_names
from microros_gen.cli.options import file_option, write_result
from microros_gen.cli.tables import format_table
from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.documents.schema_files import (
    complete_schema,
    modeline,
    schema_files,
    schema_text,
    schema_title,
)


@click.command()
@click.argument("name", required=False, shell_complete=schema_names)
@file_option
def command(name: str | None, output: Path | None) -> None:
    """List the kinds of files that have a JSON Schema, or print the schema of one of them.

    The schema is the one that the tool checks files with, complete in itself (draft 2020-12). Editors use it to
    complete and check keys; `init` writes it next to a new microros.yaml.

    \b
    microros-gen schema
    microros-gen schema application -o microros.schema.json
    """
    files = schema_files()
    if name is None:
        rows = [(known, schema_title(path)) for known, path in files.items()]
        write_result(format_table(("NAME", "SCHEMA OF"), rows), output)
        return
    if name not in files:
        hint = nearest(name, files) or f"Available: {', '.join(files)}"
        raise UserError([Diagnostic(f"unknown schema '{name}'", hint=hint, id="MG-9240")])
    write_result(schema_text(complete_schema(files[name])), output)
    if output is not None:
        click.echo(f"first line of a file next to it: {modeline(output.name)}", err=True)
