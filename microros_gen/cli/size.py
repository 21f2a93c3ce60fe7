# SPDX-License-Identifier: Apache-2.0
"""`microros-gen size`: flash, RAM and stack of what was built."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.build.report import check_budgets, measure
from microros_gen.cli.size_format import size_json, size_table


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.option(
    "--image",
    type=click.Path(path_type=Path, dir_okay=False, exists=True),
    metavar="FILE.elf",
    help="Measure this image, which an application was linked to with OUT's library, not the example.",
)
@click.option(
    "--map",
    "linker_map",
    type=click.Path(path_type=Path, dir_okay=False, exists=True),
    metavar="FILE.map",
    help="What the linker wrote of it with -Wl,-Map=FILE.map; by default it lies beside the image.",
)
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "html")),
    default="table",
    show_default=True,
    help="Tables for people, JSON for programs (keys: docs/size.md), or one page to look at and print.",
)
@click.option("--all", "every", is_flag=True, help="List every symbol too (table; JSON and HTML always do).")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write to FILE instead of the standard output.",
)
def command(
    out: Path, image: Path | None, linker_map: Path | None, kind: str, every: bool, output: Path | None
) -> None:
    """Show what OUT (made by `build`) takes: flash and RAM per component, entity and symbol, and the worst stack.

    The figures are those of the linked image, and add up to what `size` of the tool chain says. For a target without
    an image they are those of the library, before a linker drops what is not used. Ends with 1 when a budget of the
    application file (memory.ram_budget, flash_budget, stack) is exceeded, and says what would bring it down.

    \b
    microros-gen size build/pure_sender
    microros-gen size build/pure_sender --all
    microros-gen size build/pure_sender --image robot.elf
    microros-gen size build/pure_sender --format html -o size.html
    microros-gen size build/pure_sender --format json | jq .totals
    """
    if linker_map is not None and image is None:
        raise click.UsageError("--map is the map of an --image, which is not given.")
    report = measure(out, (image, linker_map or image.with_suffix(".map")) if image else None)
    if kind == "html":
        from microros_gen.cli.size_html import size_html

        text = size_html(report)
    else:
        text = size_json(report) if kind == "json" else size_table(report, every)
    if output is None:
        click.echo(text, nl=False)
    else:
        output.write_text(text, encoding="utf-8", newline="\n")
    check_budgets(report.budgets, {})
