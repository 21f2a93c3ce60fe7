# SPDX-License-Identifier: Apache-2.0
"""`microros-gen size`: flash, RAM and stack of what was built."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.options import check_map, file_option, image_option, map_option, write_result


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@image_option("Your own image to measure, linked with the library of OUT. Default: the image that was built.")
@map_option
@click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json", "html")),
    default="table",
    show_default=True,
    help="Tables, JSON (keys: docs/howto/size.md), or one HTML page with treemaps.",
)
@click.option(
    "--all", "every", is_flag=True, help="Also list every symbol (table only; JSON and HTML always do)."
)
@file_option
@click.option(
    "--budgets",
    "check",
    is_flag=True,
    help="Only check the budgets, as `build` does after linking; print nothing if none is exceeded.",
)
def command(
    out: Path,
    image: Path | None,
    linker_map: Path | None,
    kind: str,
    every: bool,
    output: Path | None,
    check: bool,
) -> None:
    """Show flash and RAM of OUT per component, entity and symbol, and the worst-case stack.

    OUT is a folder that `build` wrote, or a CMake build folder (of microros_add_library and microros_image, `init` or
    colcon) with its own image. The figures are those of the linked image; their sums equal those of the toolchain's
    `size`. For a target without an image they are those of the library, before the linker drops unused parts. If a
    budget of the application file (memory.ram_budget, flash_budget, stack) is exceeded, the exit status is 1 and
    the error lists what would reduce it.

    \b
    microros-gen size build/pure_sender
    microros-gen size my_robot/build
    microros-gen size build/pure_sender --image robot.elf --all
    microros-gen size my_robot/build --format html -o size.html
    microros-gen size build/pure_sender --format json | jq .totals
    """
    check_map(image, linker_map)
    from microros_gen.cli.budgets import check_recorded
    from microros_gen.cli.locks import check_locks
    from microros_gen.cli.size.format import size_json, size_table
    from microros_gen.cli.stacks import check_stacks
    from microros_gen.image.folder import read_folder
    from microros_gen.image.report import check_budgets, measure_folder

    folder = read_folder(out, image, linker_map)
    if check:
        check_recorded(folder)
        check_stacks(folder)
        check_locks(folder)
        return
    report = measure_folder(folder)
    if kind == "html":
        from microros_gen.cli.size.html import size_html

        text = size_html(report)
    else:
        text = size_json(report) if kind == "json" else size_table(report, every)
    write_result(text, output)
    check_budgets(report.budgets, {}, {})
