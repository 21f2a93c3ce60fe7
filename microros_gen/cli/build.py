# SPDX-License-Identifier: Apache-2.0
"""`microros-gen build`: generates and compiles."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from microros_gen import compiler
from microros_gen.cli.generate import files_line, warnings_text
from microros_gen.cli.options import output_option, selection_options, selftest_option
from microros_gen.documents.templates import compile_ahead
from microros_gen.output.runs import compiled_templates


@click.command()
@selection_options
@selftest_option
@output_option
def command(output: Path | None, **options: Any) -> None:
    """Generate a selection, compile it to OUT/lib/libmicroros.a and link the profile's example to OUT/bin.

    Only changed files are compiled again. For the host, CC, AR and CFLAGS are taken from the environment.
    Budgets of the application file (memory.ram_budget, flash_budget, stack) are checked afterwards. If one is
    exceeded, the exit status is 1 and the error lists what would reduce it. `microros-gen size OUT` shows the figures.

    \b
    microros-gen build --profile pure_sender
    microros-gen build -c microros.yaml -o build/robot
    """
    compile_ahead(compiled_templates(os.environ))
    from microros_gen.cli.summary import built_summary, plan_summary, selftest_summary
    from microros_gen.output.tree import check_build_folders

    request = compiler.read(compiler.Options(**options))
    resolved = compiler.resolve(request)
    out = compiler.output_folder(resolved, output)
    planned = compiler.plan(resolved)
    click.echo(warnings_text(planned.warnings), nl=False, err=True)
    tools = compiler.toolchain(planned)
    check_build_folders(out)
    report = compiler.write(compiler.render(planned, fork=True), out)
    click.echo(plan_summary(planned) + files_line(out, report), nl=False)
    built = compiler.compile(planned, out, tools)
    click.echo(built_summary(out, built.report, built.usage, planned.project.lacks_image), nl=False)
    if planned.resolved.request.selftest:
        click.echo(selftest_summary(out, built.report, planned.project), nl=False)
    if planned.project.application.memory.has_budget:
        from microros_gen.cli.budgets import check_planned
        from microros_gen.image.folder import read_folder

        check_planned(planned, lambda: read_folder(out))
