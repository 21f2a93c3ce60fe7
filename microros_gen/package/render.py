# SPDX-License-Identifier: Apache-2.0
"""A package of a plan as bytes by path: the files of the output in their places, its own files, manifest and SBOM."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen import compiler
from microros_gen.compiler import Options, Planned, Request, Resolved
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.documents.files import read_bytes
from microros_gen.documents.own_templates import render_own
from microros_gen.documents.templates import shared_environment
from microros_gen.output.manifest import manifest_text
from microros_gen.output.tree import MANIFEST
from microros_gen.package.description import PackageDescription
from microros_gen.package.find import read_package
from microros_gen.package.licenses import licenses_of
from microros_gen.package.sbom import SBOM, sbom
from microros_gen.package.view import PackageView, holds, package_view
from microros_gen.platform.find import read_target
from microros_gen.records import dataclass
from microros_gen.selection.component_sources import template_name

LICENSE = "LICENSE"
_LARGEST = 1 << 22


@dataclass(frozen=True)
class PackagePlan:
    """A package and the plan that it carries; `general`: its own one, not the user's."""

    package: PackageDescription
    planned: Planned
    general: bool


def describe(name: str) -> PackageDescription:
    """Return the package with this name, or in this folder. Raises UserError if it does not exist."""
    diagnostics = Diagnostics()
    package = read_package(name, diagnostics)
    diagnostics.check()
    assert package is not None
    return package


def plan_package(
    package: PackageDescription, config: Path | None, interface_paths: tuple[Path, ...] = ()
) -> PackagePlan:
    """Plan the application file `config` for a package; None: the general plan.

    Raises UserError as `compiler.plan` does, and for a transport that the package does not have.
    """
    request = compiler.read(Options(config=config or package.general_plan, interface_paths=interface_paths))
    return plan_request(package, request, config is None)


def plan_request(package: PackageDescription, request: Request, general: bool = False) -> PackagePlan:
    """Plan an application that was read for a package. Raises UserError as `plan_package` does."""
    found = Diagnostics()
    named = request.application.target.span
    if package.target is not None:
        request = _with_target(request, package.target, found)
        if named is not None:
            message = (
                f"the target of the application file has no effect: the package {package.name} has its own"
            )
            found.warning(message, named, "Remove `target: {name: …}`, or use `generate`", id="MG-9206")
    _warn_about_budgets(package, request, found)
    resolved = compiler.resolve(request)
    _check_transport(package, resolved, found)
    found.check()
    planned = compiler.plan(resolved)
    found.extend(planned.warnings)
    return PackagePlan(package, replace(planned, warnings=tuple(found)), general)


def _warn_about_budgets(package: PackageDescription, request: Request, found: Diagnostics) -> None:
    """Warn that nothing is compiled here that could exceed a budget of the application."""
    memory = request.application.memory
    if memory.has_budget:
        place = memory.ram_span or memory.flash_span or memory.stack_span
        message = (
            f"the package {package.name} does not check the budgets of `memory:`, since nothing is compiled"
        )
        hint = f"Check them in a build: microros-gen build -c {request.config or 'FILE'}"
        found.warning(message, place, hint, id="MG-9210")


def _check_transport(package: PackageDescription, resolved: Resolved, found: Diagnostics) -> None:
    """Refuse a transport that a package does not have; one on a stream of bytes is `custom` there."""
    transport, possible = resolved.selection.transport, package.transports
    if not possible or transport in possible:
        return
    chosen = "custom" if transport == "serial" and "custom" in possible else possible[0]
    message = f"the package {package.name} has no transport '{transport}', only {', '.join(possible)}"
    place = resolved.request.application.transport.type_span
    found.error(message, place, f"Write `transport: {{type: {chosen}}}`", id="MG-9204")


def _with_target(request: Request, path: Path, diagnostics: Diagnostics) -> Request:
    """Return the request for the target file of a package; the parts that the application names stay."""
    application = request.application
    parts = {"os": application.target.rtos, "network": application.target.network}
    found = read_target(path.name, path.parent, None, diagnostics, request.extensions, parts)
    diagnostics.check()
    assert found is not None
    target = replace(application.target, name=found.target.name, span=None)
    found = replace(found, target=replace(found.target, of_package=True))
    return replace(request, application=replace(application, target=target), found_target=found)


def render_package(plan: PackagePlan) -> dict[str, bytes]:
    """Return every file of a package by its path (POSIX). Equal plans give equal bytes.

    Raises UserError if the package has no place for a file, or two files have the same place.
    """
    output = compiler.render(plan.planned, fork=True)
    files = _placed(plan.package, output)
    own = dict(_own_files(plan))
    _check_twice(plan.package, files, {name.removesuffix(".j2") for name in own})
    plain = {name: read_bytes(path, _LARGEST) for name, path in own.items() if not name.endswith(".j2")}
    files |= plain
    view = package_view(plan.package, plan.planned, plan.general, files)
    files |= {
        name.removesuffix(".j2"): _rendered(path, view) for name, path in own.items() if name.endswith(".j2")
    }
    files[LICENSE] = license_text()
    places = {entry.place.name: entry.place for entry in plan.planned.interfaces}
    files[SBOM] = sbom(view, files, licenses_of(places.values()))
    files[MANIFEST] = _manifest(plan, output[MANIFEST], files)
    return files


def license_text() -> bytes:
    """Return the license of the tool and of what it generates: in a wheel, else of the repository."""
    folder = Path(__file__).resolve().parent.parent
    installed = folder / LICENSE
    return (installed if installed.is_file() else folder.parent / LICENSE).read_bytes()


def _placed(package: PackageDescription, output: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of the output where the package has them."""
    files: dict[str, bytes] = {}
    for name, content in output.items():
        if name == MANIFEST:
            continue
        places = package.place_of(name)
        if places is None:
            hint = f"Add `- {{from: {name}, to: …}}` to `layout`; an item that has no `to` leaves it out"
            message = f"the package {package.name} has no place for '{name}'"
            raise UserError([Diagnostic(message, hint=hint, id="MG-9205")])
        for place in places:
            _check_twice(package, files, {place})
            files[place] = content
    return files


def _check_twice(package: PackageDescription, files: Mapping[str, bytes], names: set[str]) -> None:
    twice = sorted({name for name in names if name in files} | ({MANIFEST, SBOM, LICENSE} & names))
    if twice:
        hint = "Change its place in `layout`, or the name below files/"
        message = f"two files of the package {package.name} have the place '{twice[0]}'"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9207")])


def _own_files(plan: PackagePlan) -> Iterator[tuple[str, Path]]:
    """Yield the files below files/ that belong to the plan, with their paths there."""
    for name, path in sorted(plan.package.own_files().items()):
        if holds(plan.package.conditions_of(name), plan.planned, plan.general):
            yield name, path


def _rendered(path: Path, view: PackageView) -> bytes:
    environment, context = shared_environment(), {"view": view}
    name = template_name(path)
    if not name:
        return render_own(path, environment, context).encode()
    return environment.get_template(name).render(context).encode()


def _manifest(plan: PackagePlan, manifest: bytes, files: Mapping[str, bytes]) -> bytes:
    """Return the manifest of the output that lists the files of the package instead."""
    data = json.loads(manifest)
    types = data.pop("types")
    data["package"] = {"name": plan.package.name, "plan": "general" if plan.general else "application"}
    data["outputs"] = {name: hashlib.sha256(content).hexdigest() for name, content in files.items()}
    if plan.package.origin:
        data["package"]["from"] = plan.package.origin
        for path in sorted(p for p in plan.package.folder.rglob("*") if p.is_file()):
            name = f"package {plan.package.name}/{path.relative_to(plan.package.folder).as_posix()}"
            data["inputs"][name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return manifest_text(data, types).encode()
