# SPDX-License-Identifier: Apache-2.0
"""`microros-gen targets`: what can be built for."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import click

from microros_gen.cli.resolve_format import format_table
from microros_gen.diagnostics import Diagnostics
from microros_gen.model.target import Target
from microros_gen.sources.targets import builtin_targets, read_target


@click.command()
@click.argument("name", required=False)
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json")),
    default="table",
    show_default=True,
    help="Tables for people, or JSON for programs.",
)
def command(name: str | None, kind: str) -> None:
    """List the targets, or show target NAME (built-in, or the path of a target file).

    \b
    microros-gen targets
    microros-gen targets host
    """
    diagnostics = Diagnostics()
    names = builtin_targets() if name is None else (name,)
    found = [read_target(n, Path(), None, diagnostics) for n in names]
    diagnostics.check()
    targets = [f.target for f in found if f is not None]
    if kind == "json":
        click.echo(json.dumps([dataclasses.asdict(t) for t in targets], indent=2, sort_keys=True))
    elif name is None:
        click.echo(format_table(("target", "what"), [(t.name, t.summary) for t in targets]), nl=False)
    else:
        click.echo(format_table(("key", "value"), _rows(targets[0])), nl=False)


def _rows(target: Target) -> list[tuple[str, str]]:
    values = dataclasses.asdict(target).items()
    return [(k, " ".join(v) if isinstance(v, (tuple, list)) else str(v)) for k, v in values]
