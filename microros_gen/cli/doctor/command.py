# SPDX-License-Identifier: Apache-2.0
"""`microros-gen doctor [WAY]…`: checks this machine, says what is missing, and fixes what it may."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import click

from microros_gen.cli.offers import ways
from microros_gen.cli.options import format_option

if TYPE_CHECKING:
    from microros_gen.cli.doctor.finding import Finding


@click.command()
@click.argument("names", metavar="[WAY]…", nargs=-1, shell_complete=ways)
@click.option("--fix", is_flag=True, help="Fix what needs neither root nor a network, then check again.")
@format_option
def command(names: tuple[str, ...], fix: bool, kind: str) -> int:
    """Show what this machine lacks to build and run, what it is needed for, and the command that installs it.

    WAY is a target (host, cortex-m4, …), cmake, colcon or agent; all of them by default. It can also be a package
    (platformio, zephyr, …): what its build system needs is looked for if you name it. A compiler is started with the
    flags of the target, so one without its C library is found, too. --fix corrects the CMake files of ROS 2 wheels
    in this Python environment, which name header folders of the machine that built the wheels.

    Exit status: 0 everything is there; 1 something is missing or broken.

    \b
    microros-gen doctor
    microros-gen doctor host qemu-mps2-an386 agent
    microros-gen doctor pico
    microros-gen doctor colcon --fix
    """
    found = check(names, os.environ)
    if fix:
        for finding in found:
            if finding.fix is not None:
                finding.fix()
        found = check(names, os.environ)
    click.echo(_json(found) if kind == "json" else _table(found), nl=False)
    return int(any(_is_bad(finding) for finding in found))


def check(names: Sequence[str], environ: Mapping[str, str]) -> tuple[Finding, ...]:
    """Return what is found for the ways `names`, by default for all but packages.

    Raises UserError for an unknown one.
    """
    from microros_gen.cli.doctor.packages import package_findings
    from microros_gen.cli.doctor.ros import agent_findings, colcon_findings
    from microros_gen.cli.doctor.tools import cmake_findings, read_targets, target_findings
    from microros_gen.diagnostics import Diagnostic, UserError, nearest
    from microros_gen.package.find import builtin_packages
    from microros_gen.package.render import describe
    from microros_gen.platform.find import target_names

    others: dict[str, Callable[[], Iterator[Finding]]] = {
        "cmake": lambda: cmake_findings("CMake projects, colcon", environ),
        "colcon": lambda: colcon_findings(environ),
        "agent": lambda: agent_findings(environ),
    }
    known = (*target_names(), *others)
    packages = [name for name in builtin_packages() if name not in others]
    for name in names:
        if name not in known and name not in packages:
            possible = (*known, *packages)
            hint = nearest(name, possible) or f"Available: {', '.join(possible)}"
            raise UserError([Diagnostic(f"unknown way to build or run '{name}'", hint=hint, id="MG-9241")])
    requested = names or known
    targets = [name for name in requested if name not in others and name not in packages]
    found = [*target_findings(read_targets(targets), environ)]
    for name in packages:
        found += package_findings(describe(name), environ) if name in requested else []
    for name, findings in others.items():
        found += [f for f in findings() if f not in found] if name in requested else []
    return tuple(found)


def _is_bad(finding: Finding) -> bool:
    return finding.state.value != "ok"


def _table(found: Sequence[Finding]) -> str:
    from microros_gen.cli.terminal import wants_color

    color = wants_color(sys.stdout)
    width = max(len(finding.name) for finding in found)
    lines = []
    for finding in found:
        state = f"{finding.state.value:<7}"
        if color:
            state = click.style(state, fg="red" if _is_bad(finding) else "green")
        lines.append(f"{state}  {finding.name:<{width}}  {finding.needed_for}")
        lead = " " * 9
        if _is_bad(finding):
            lines += [f"{lead}{text}" for text in (finding.detail, finding.remedy) if text]
    bad = sum(map(_is_bad, found))
    lines.append(f"{bad} of {len(found)} missing or broken" if bad else f"all {len(found)} are there")
    return "".join(f"{line.rstrip()}\n" for line in lines)


def _json(found: Sequence[Finding]) -> str:
    data = [
        {
            "name": f.name,
            "state": f.state.value,
            "needed_for": f.needed_for,
            "detail": f.detail,
            "remedy": f.remedy,
            "fixable": f.fix is not None,
        }
        for f in found
    ]
    return json.dumps({"version": 1, "findings": data}, indent=2, ensure_ascii=False) + "\n"
