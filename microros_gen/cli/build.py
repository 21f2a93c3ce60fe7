# SPDX-License-Identifier: Apache-2.0
"""`microros-gen build`: generates and compiles."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from microros_gen.cli.budgets import check_planned
from microros_gen.cli.generate import files_line, plan, write
from microros_gen.cli.options import output_option, selection_options
from microros_gen.cli.summary import built_summary, plan_summary
from microros_gen.compiler.options import SelectionOptions
from microros_gen.compiler.pipeline import Planned
from microros_gen.image.folder import read_folder
from microros_gen.output.tree import check_build_folders
from microros_gen.toolchain.compile import compile_project
from microros_gen.toolchain.measure import measure_library
from microros_gen.toolchain.toolchain import Toolchain, find_toolchain


@click.command()
@selection_options
@output_option
def command(output: Path | None, **options: Any) -> None:
    """Generate a selection, compile it to OUT/lib/libmicroros.a and link the profile's example to OUT/bin.

    Only what changed is compiled again. CC, AR and CFLAGS are taken from the environment for the host.
    Budgets of the application file (memory.ram_budget, flash_budget, stack) are checked afterwards; one that is
    exceeded ends with 1 and names what would bring it down. `microros-gen size OUT` shows the figures.

    \b
    microros-gen build --profile pure_sender
    microros-gen build -c microros.yaml -o build/robot
    """
    selection = SelectionOptions(**options)
    planned, out = plan(selection, output)
    tools = find_toolchain(planned.project.target, os.environ)
    check_build_folders(out)
    report = write(planned, out)
    click.echo(plan_summary(planned) + files_line(out, report), nl=False)
    _compile(planned, out, tools)
    check_planned(planned, lambda: read_folder(out), selection)


def _compile(planned: Planned, out: Path, tools: Toolchain) -> None:
    built = compile_project(out, planned.project, tools)
    usage = measure_library(out, tools)
    click.echo(built_summary(out, built, usage, planned.project.lacks_image), nl=False)
