# SPDX-License-Identifier: Apache-2.0
"""The steps of the compiler; `microros_gen.compiler` exports them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from microros_gen.compiler.options import Options
from microros_gen.compiler.pipeline import Planned, Resolved, plan_request, render_request, resolve_request
from microros_gen.compiler.request import Request, read_request, request_of
from microros_gen.diagnostics import Diagnostic, Diagnostics, Source
from microros_gen.output.tree import WriteReport, check_build_folders, check_owned, write_tree
from microros_gen.records import dataclass

if TYPE_CHECKING:
    from microros_gen.toolchain.compile import BuildReport
    from microros_gen.toolchain.measure import Usage
    from microros_gen.toolchain.toolchain import Toolchain


@dataclass(frozen=True)
class Generated:
    """A plan, the output folder that holds its files, and what writing them changed there."""

    planned: Planned
    out: Path
    report: WriteReport


@dataclass(frozen=True)
class Built:
    """What a compilation did, and the size of the library in bytes (None: the tool chain has no `size`)."""

    report: BuildReport
    usage: Usage | None


def read(options: Options | None = None) -> Request:
    """Read the application file that `options` name, or the one of the current folder; options win over it.

    Raises UserError: the file cannot be read, or says what it must not.
    """
    diagnostics = Diagnostics()
    request = read_request(options or Options(), diagnostics)
    return replace(request, warnings=tuple(diagnostics))


def read_source(source: Source | None, near: Path, options: Options | None = None) -> Request:
    """Read an application file that is a text (None: the options alone); its paths are relative to the folder `near`.

    Raises UserError as `read` does.
    """
    diagnostics = Diagnostics()
    request = request_of(source, near, options or Options(), diagnostics)
    return replace(request, warnings=tuple(diagnostics))


def resolve(request: Request) -> Resolved:
    """Resolve profiles, components and axes: what is selected, and why.

    Raises UserError: an unknown profile or component, or choices that exclude each other.
    """
    diagnostics = _continued(request.warnings)
    resolved = resolve_request(request, diagnostics)
    return replace(resolved, warnings=tuple(diagnostics))


def plan(resolved: Resolved) -> Planned:
    """Find the interfaces; decide sizes, names, streams and storage. Nothing is written.

    Raises UserError: an unknown type, a limit that is missing or does not fit, a budget that is exceeded.
    """
    return plan_request(resolved, _continued(resolved.warnings))


def render(planned: Planned) -> dict[str, bytes]:
    """Return every file of the output folder by its path there. The same plan gives the same bytes."""
    return render_request(planned)


def output_folder(resolved: Resolved, output: Path | None = None) -> Path:
    """Return `output`, or where the command line writes without one: `build/<profiles>`.

    Raises UserError: the folder holds files that this tool did not write.
    """
    out = output or Path("build") / resolved.selection.name
    check_owned(out)
    return out


def write(files: Mapping[str, bytes], out: Path) -> WriteReport:
    """Make `out` hold exactly `files`, replacing only what differs.

    Raises UserError: the folder cannot be written, or is not this tool's; then nothing was changed.
    """
    return write_tree(out, files)


def differences(files: Mapping[str, bytes], golden: Path) -> tuple[str, ...]:
    """Return how `files` differ from a golden copy, a unified diff for each; none: they are the same."""
    from microros_gen.output.golden import golden_differences

    return golden_differences(golden, files)


def generate(options: Options | None = None, output: Path | None = None) -> Generated:
    """Read, resolve, plan, render and write. Raises UserError as these do."""
    resolved = resolve(read(options))
    out = output_folder(resolved, output)
    planned = plan(resolved)
    return Generated(planned, out, write(render(planned), out))


def toolchain(planned: Planned, environ: Mapping[str, str] | None = None) -> Toolchain:
    """Return the tool chain of the plan's target; `environ` (the process's by default) may name another for the host.

    Raises UserError that names what to install.
    """
    from microros_gen.toolchain.toolchain import find_toolchain

    return find_toolchain(planned.project.target, os.environ if environ is None else environ)


def compile(planned: Planned, out: Path, tools: Toolchain | None = None) -> Built:
    """Compile the sources in `out`: lib/libmicroros.a, and the example's image where the target has one.

    Raises UserError with status 1: a source does not compile, or the image is larger than the target's memory.
    """
    from microros_gen.toolchain.compile import compile_project
    from microros_gen.toolchain.measure import measure_library

    tools = tools or toolchain(planned)
    check_build_folders(out)
    report = compile_project(out, planned.project, tools)
    return Built(report, measure_library(out, tools))


def _continued(warnings: tuple[Diagnostic, ...]) -> Diagnostics:
    diagnostics = Diagnostics()
    diagnostics.extend(warnings)
    return diagnostics
