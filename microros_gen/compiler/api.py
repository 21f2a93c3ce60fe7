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
    from microros_gen.toolchain.objects import Progress
    from microros_gen.toolchain.toolchain import Toolchain


@dataclass(frozen=True)
class Generated:
    """Result of `generate`: the plan, the output folder with its files, and which files were written or removed."""

    planned: Planned
    out: Path
    report: WriteReport


@dataclass(frozen=True)
class Built:
    """Result of `compile`: paths and objects, and the library's sizes in bytes (None: the tool chain has no `size`)."""

    report: BuildReport
    usage: Usage | None


def read(options: Options | None = None) -> Request:
    """Read the application file named by `options`, by default microros.yaml of the current folder.

    Values of `options` override those of the file. Types are not looked up yet.
    Raises UserError if the file cannot be read, is not YAML 1.2, or violates application.schema.json.
    """
    diagnostics = Diagnostics()
    request = read_request(options or Options(), diagnostics)
    return replace(request, warnings=tuple(diagnostics))


def read_source(source: Source | None, near: Path, options: Options | None = None) -> Request:
    """Read an application from text; None uses the options only.

    `near` is the folder to which relative paths of the application refer; it need not contain the file.
    Raises UserError as `read` does.
    """
    diagnostics = Diagnostics()
    request = request_of(source, near, options or Options(), diagnostics)
    return replace(request, warnings=tuple(diagnostics))


def resolve(request: Request) -> Resolved:
    """Resolve profiles, components and choices to a selection with a reason for each component.

    Raises UserError for an unknown profile or component, for a component that is not ready, and for choices that
    exclude each other.
    """
    diagnostics = _continued(request.warnings)
    resolved = resolve_request(request, diagnostics)
    return replace(resolved, warnings=tuple(diagnostics))


def plan(resolved: Resolved) -> Planned:
    """Find the interfaces and compute all sizes (bytes), times (milliseconds), names, streams and storage.

    Writes nothing. Sizes are those of plain CDR (OMG DDS-XTypes 1.3, 7.4.1) for the target's data model.
    Raises UserError for an unknown type, a missing limit, a message or stream that does not fit, and an exceeded
    RAM budget of the streams.
    """
    return plan_request(resolved, _continued(resolved.warnings))


def render(planned: Planned, *, fork: bool = False) -> dict[str, bytes]:
    """Return the contents of every output file by its relative path (POSIX). Equal plans give equal bytes.

    `fork`: where the system can fork and this process has one thread, a second process prints some of the files.
    """
    return render_request(planned, fork)


def output_folder(resolved: Resolved, output: Path | None = None) -> Path:
    """Return `output`, by default `build/<profiles>` as the command line does.

    Raises UserError if the folder contains files that microros-gen did not write.
    """
    out = output or Path("build") / resolved.selection.name
    check_owned(out)
    return out


def write(files: Mapping[str, bytes], out: Path) -> WriteReport:
    """Write `files` to the folder `out` and remove other generated files; equal files keep their time stamps.

    Each file is replaced atomically. Compiled files below `out` stay.
    Raises UserError, with nothing changed, if the folder is not writable or not from microros-gen.
    """
    return write_tree(out, files)


def differences(files: Mapping[str, bytes], golden: Path) -> tuple[str, ...]:
    """Return a unified diff for each file that differs from the golden copy; empty if all are equal.

    Raises UserError if the folder `golden` does not exist.
    """
    from microros_gen.output.golden import golden_differences

    return golden_differences(golden, files)


def generate(options: Options | None = None, output: Path | None = None) -> Generated:
    """Run `read`, `resolve`, `plan`, `render` and `write`.

    Raises UserError as these do. The output folder is checked before the plan is made.
    """
    resolved = resolve(read(options))
    out = output_folder(resolved, output)
    planned = plan(resolved)
    return Generated(planned, out, write(render(planned), out))


def toolchain(planned: Planned, environ: Mapping[str, str] | None = None) -> Toolchain:
    """Find the tool chain of the plan's target on the PATH.

    `environ` (default: os.environ) provides PATH, and CC, AR and CFLAGS for the host.
    Raises UserError with the packages to install if no suitable compiler is found.
    """
    from microros_gen.toolchain.toolchain import find_toolchain

    return find_toolchain(planned.project.target, os.environ if environ is None else environ)


def compile(
    planned: Planned, out: Path, tools: Toolchain | None = None, progress: Progress | None = None
) -> Built:
    """Compile the sources in `out` to lib/libmicroros.a, and to the example's image if the target supports one.

    `out` must contain the rendered files of `planned`. `tools` defaults to `toolchain(planned)`.
    `progress` is called for each compiled source with the number so far, the number of all, and its path. Objects that
    were compiled before are copied from the user's cache folder (`MICROROS_GEN_OBJECTS=off` prevents that).
    Raises UserError with status 1 if a source does not compile or the image exceeds the target's memory.
    """
    from microros_gen.selftest.render import selftest_image
    from microros_gen.toolchain.compile import compile_project
    from microros_gen.toolchain.measure import measure_library
    from microros_gen.toolchain.object_store import ObjectStore

    tools = tools or toolchain(planned)
    check_build_folders(out)
    selftest = selftest_image(planned.project) if planned.resolved.request.selftest else None
    report = compile_project(out, planned.project, tools, ObjectStore.of_user(os.environ), selftest, progress)
    return Built(report, measure_library(out, tools))


def _continued(warnings: tuple[Diagnostic, ...]) -> Diagnostics:
    diagnostics = Diagnostics()
    diagnostics.extend(warnings)
    return diagnostics
