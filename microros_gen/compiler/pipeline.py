# SPDX-License-Identifier: Apache-2.0
"""From a request to the bytes of every file: calls the steps in their order."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from microros_gen.application.find import APPLICATION_FILE
from microros_gen.application.image_files import image_paths
from microros_gen.application.kinds import KIND, SERVICE_KINDS, TOPIC_KINDS
from microros_gen.application.model import Application, EndpointDecl
from microros_gen.application.parameter_find import parameter_paths
from microros_gen.application.system_find import system_paths
from microros_gen.client.plan.agent_files import check_entities
from microros_gen.client.plan.declared import (
    check_types,
    declarations,
    full_name,
    node_name,
    type_name,
)
from microros_gen.client.plan.features import with_endpoints, with_limits
from microros_gen.client.plan.project import Project, plan_project
from microros_gen.client.plan.service_limits import service_roots
from microros_gen.client.plan.stream_budget import check_stream_budget
from microros_gen.client.plan.streams import WRITE_DATA_OVERHEAD
from microros_gen.client.plan.transport_sizes import DEFAULT_MTU
from microros_gen.compiler.distribution import check_distribution
from microros_gen.compiler.request import Request
from microros_gen.diagnostics import Diagnostic, Diagnostics
from microros_gen.documents.named import Named
from microros_gen.documents.templates import compile_also, compiled_before, templates_below
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces, split_type_name
from microros_gen.interfaces.derived import declaring_name, derived_name, event_name
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import TypeName
from microros_gen.platform.capabilities import capabilities
from microros_gen.platform.emulated import with_emulated_console
from microros_gen.platform.part_file import own_part_files
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.clock import CLOCK_ROS, with_clock
from microros_gen.selection.component import Catalogue, Profile
from microros_gen.selection.component_sources import ComponentFile, component_files, template_names
from microros_gen.selection.creation import with_creation
from microros_gen.selection.extension import files_of, folders_below
from microros_gen.selection.find_components import load_catalogue
from microros_gen.selection.find_profiles import load_middleware, load_profiles
from microros_gen.selection.implied import with_implied
from microros_gen.selection.installed import index_folders
from microros_gen.selection.model import Selection
from microros_gen.selection.outside import component_names, with_outside
from microros_gen.selection.profile_nodes import with_profile_nodes
from microros_gen.selection.profiles import resolve_profiles
from microros_gen.selection.resolve import check_ready, resolve_selection
from microros_gen.typesupport.plan.capacity import Capacities, Defaults, Entity, Root, plan_capacities
from microros_gen.typesupport.plan.file_names import check_file_names
from microros_gen.typesupport.plan.layout import models_of
from microros_gen.typesupport.plan.types import plan_types

DEFAULT_INTERFACE = "std_msgs/msg/Int32"
"""The interface of an application that names none."""


@dataclass(frozen=True)
class Resolved:
    """Result of `resolve`: the request, its selection, and the user's own profiles that contributed to it."""

    request: Request
    own_profiles: tuple[Profile, ...]
    catalogue: Catalogue
    selection: Selection
    warnings: tuple[Diagnostic, ...] = ()


@dataclass(frozen=True)
class Planned:
    """A resolved request with its plan and with what `capacities` had to assume.

    `searched` are the paths that decide where each interface is found; `warnings` are all since the
    application file was read.
    """

    resolved: Resolved
    interfaces: InterfaceSet
    searched: tuple[Path, ...]
    capacities: Capacities
    project: Project
    warnings: tuple[Diagnostic, ...] = ()


def resolve_request(request: Request, diagnostics: Diagnostics) -> Resolved:
    """Resolve profiles and components; what sends or receives and names no type gets the default one."""
    extensions = request.extensions
    profiles = load_profiles(
        request.application.profiles, request.profiles_near, diagnostics, extensions=extensions
    )
    resolved = resolve_profiles(profiles, diagnostics)
    diagnostics.check()
    names = component_names(request.application, resolved)
    builtin = _catalogue(request.target)
    catalogue = with_outside(builtin, extensions, names, capabilities(), diagnostics)
    diagnostics.check()
    target = request.target
    selection = resolve_selection(
        request.application,
        resolved,
        catalogue,
        load_middleware(),
        diagnostics,
        tuple(part.component.name for part in target.parts),
        target.transport,
    )
    diagnostics.check()
    own = tuple(p for p in profiles.profiles.values() if not p.builtin)
    application = request.application
    clock_alone = selection.serves_only("subscribe", CLOCK_ROS) and not selection.has("publish")
    names_none = not application.nodes and not application.interfaces
    if names_none and selection.has("cdr") and not clock_alone:
        application = replace(application, interfaces=(Named(DEFAULT_INTERFACE),))
    _check_interfaces_have_a_use(application, selection, diagnostics)
    diagnostics.check()
    application = with_profile_nodes(application, resolved)
    application = with_creation(application, selection.transport, selection.entities)
    application = with_endpoints(with_implied(application, selection, catalogue, diagnostics), selection)
    application = with_limits(application, selection)
    found = replace(request.found_target, target=with_emulated_console(target, selection, request.selftest))
    application = with_clock(application, selection, diagnostics)
    request = replace(request, application=application, found_target=found)
    diagnostics.check()
    return Resolved(request, own, catalogue, selection)


def _catalogue(target: Target) -> Catalogue:
    """Return all components that ship with the tool, and the parts of the target that do not."""
    own = {part.component.name: part.component for part in target.parts if part.own}
    return MappingProxyType({**load_catalogue(), **own}) if own else load_catalogue()


def _check_interfaces_have_a_use(
    application: Application, selection: Selection, diagnostics: Diagnostics
) -> None:
    if selection.has("cdr"):
        return
    for named in application.interfaces:
        diagnostics.error(
            f"no selected component sends or receives messages such as '{named.name}'",
            named.span,
            "Select a profile or component that does (publish, subscribe, services), or `cdr` for encoders alone",
            id="MG-8604",
        )


def plan_request(resolved: Resolved, diagnostics: Diagnostics) -> Planned:
    """Find the interfaces and plan sizes, names and entities. Raises UserError with all that is wrong."""
    selected = [c.component for c in resolved.selection.components]
    compile_also(template_names(selected))
    if any("DATA" in component.receives for component in selected):
        # Types have decoders then, and the example an executor.
        compile_also(templates_below("types", "example"))
    planned = _planned(resolved, diagnostics)

    def other(application: Application) -> Project:
        request = replace(resolved.request, application=application)
        return _planned(replace(resolved, request=request), Diagnostics()).project

    check_stream_budget(planned.project, planned.capacities, other, diagnostics)
    diagnostics.check()
    return replace(planned, warnings=tuple(diagnostics))


def _planned(resolved: Resolved, diagnostics: Diagnostics) -> Planned:
    """Plan as plan_request does; the budget of RAM is not looked at."""
    request, application, selection = resolved.request, resolved.request.application, resolved.selection
    check_ready(selection, diagnostics)
    check_entities(application, selection, diagnostics)
    check_types(application, diagnostics)
    own = [request.near / path.name for path in application.interface_paths]
    finder = InterfaceFinder.from_environment((*request.interface_paths, *own))
    spans = {request.near / path.name: path.span for path in application.interface_paths}
    finder.check_paths(diagnostics, spans)
    interfaces = _interfaces(resolved, finder, diagnostics)
    check_file_names(interfaces, diagnostics)
    check_distribution(application, interfaces, os.environ, diagnostics)
    capacities = _capacities(resolved, interfaces, diagnostics)
    diagnostics.check()
    received = _received(application, selection, capacities)
    models = models_of(resolved.request.target.data_model)
    types = plan_types(
        interfaces.messages,
        capacities,
        interfaces.type_hash,
        diagnostics,
        received,
        models,
        application.exact_float64,
    )
    diagnostics.check()
    project = plan_project(
        application,
        selection,
        resolved.request.target,
        types,
        _published(interfaces, application),
        diagnostics,
        tuple(name for name in interfaces.roots if name.kind == "srv"),
    )
    diagnostics.check()
    packages = sorted({entry.name.package for entry in interfaces})
    searched = tuple(finder.deciding(packages))
    return Planned(resolved, interfaces, searched, capacities, project)


def render_request(planned: Planned, fork: bool = False) -> dict[str, bytes]:
    """Return every file of the output folder, the manifest among them; `fork`: a second process may help."""
    from microros_gen.client.views.project import render_project
    from microros_gen.output.manifest import manifest
    from microros_gen.output.runs import compiled_templates
    from microros_gen.output.tree import MANIFEST
    from microros_gen.selftest.render import render_selftest

    chosen = {c.component.name for c in planned.project.selection.components}
    unselected = [c for c in planned.resolved.catalogue.values() if c.name not in chosen]
    with compiled_before(compiled_templates(os.environ)) as environment:
        own = _component_files(planned.project)
        files = render_project(planned.project, own, unselected, environment, fork)
        if planned.resolved.request.selftest:
            files |= render_selftest(planned.project, environment)
    inputs = dict(planned.resolved.request.inputs)
    profiles = planned.resolved.own_profiles
    inputs |= {f"profile {p.name}": p.span.source.text.encode() for p in profiles if p.span}
    inputs |= {
        f"target {Path(s.name).name}": s.text.encode() for s in planned.resolved.request.found_target.own
    }
    boards = planned.resolved.request.found_target.boards
    inputs |= {f"board {Path(s.name).parent.name}/{Path(s.name).name}": s.text.encode() for s in boards}
    inputs |= {name: path.read_bytes() for name, path in _outside_files(planned.resolved)}
    inputs |= {str(entry.name): entry.source.text.encode() for entry in planned.interfaces}
    files[MANIFEST] = manifest(planned.project, inputs, files)
    return files


def read_paths(planned: Planned) -> Iterator[Path]:
    """Yield every file that the plan was made from, and every path that would matter if there were one."""
    request = planned.resolved.request
    near = request.near
    yield request.config or near / APPLICATION_FILE
    requested = [request.profiles_near / name.name for name in request.application.profiles]
    own = [Path(p.span.source.name) for p in planned.resolved.own_profiles if p.span]
    yield from (Path(f"{path}{suffix}") for path in requested for suffix in ("", ".yaml", ".yml"))
    yield from (candidate for path in own for candidate in (path, path.with_suffix(".yaml")))
    yield near / request.application.target.name
    yield from parameter_paths(request.application, near)
    yield from image_paths(request.application, request.config or near / APPLICATION_FILE)
    yield from system_paths(request.application, near)
    yield from (Path(s.name) for s in (*request.found_target.own, *request.found_target.boards))
    yield from (path for _, path in _outside_files(planned.resolved))
    yield from (path for folder in _outside_folders(planned.resolved) for path in folders_below(folder))
    yield from index_folders(os.environ)
    yield from planned.searched
    for entry in planned.interfaces:
        yield from (entry.place.folder / entry.name.kind, Path(entry.source.name))


def _outside_files(resolved: Resolved) -> Iterator[tuple[str, Path]]:
    """Yield every file of components and parts that do not ship with the tool: what it is, and its path."""
    yield from own_part_files(resolved.request.target)
    for component in resolved.catalogue.values():
        if component.origin and component.layer != "port":
            for name, path in files_of(component.folder):
                yield f"component {component.name}/{name}", path


def _outside_folders(resolved: Resolved) -> Iterator[Path]:
    """Yield the folders in which a new file would matter."""
    yield from (extension.folder for extension in resolved.request.extensions.named)
    yield from (c.folder for c in resolved.catalogue.values() if c.origin)


def _requested(application: Application) -> tuple[Named, ...]:
    declared = tuple(
        Named(_of_kind(endpoint), endpoint.type_span or endpoint.span)
        for endpoints in (*(node.endpoints for node in application.nodes), application.implied)
        for endpoint in endpoints
    )
    return declared + application.interfaces


def _interfaces(resolved: Resolved, finder: InterfaceFinder, diagnostics: Diagnostics) -> InterfaceSet:
    """Return the closure of what is requested; where no message is among it, the default one for publishers.

    Services and actions bring the types that they exchange; nobody publishes those.
    """
    application = resolved.request.application
    requested = _requested(application)
    interfaces = resolve_interfaces(requested, finder, diagnostics)
    diagnostics.check()
    if application.nodes or _published(interfaces, application) or not resolved.selection.has("publish"):
        return interfaces
    diagnostics.warning(
        f"no message to publish among the interfaces: {DEFAULT_INTERFACE} is added",
        next((named.span for named in requested), None),
        "Services and actions bring their types and no publishers; add a message with --interface pkg/msg/Type",
        id="MG-8605",
    )
    interfaces = resolve_interfaces((*requested, Named(DEFAULT_INTERFACE)), finder, diagnostics)
    diagnostics.check()
    return interfaces


def _of_kind(endpoint: EndpointDecl) -> str:
    """Return the full name of an endpoint's type: `pkg/Type` of a service is `pkg/srv/Type`."""
    name = split_type_name(endpoint.type, KIND[endpoint.kind].type_kind)
    return endpoint.type if name is None else str(name)


def _published(interfaces: InterfaceSet, application: Application) -> tuple[TypeName, ...]:
    """Return the requested types that publishers can have: messages, not what services and actions exchange.

    What the library alone asked for is not among them.
    """
    requested = {named.name for named in application.interfaces}
    own = {type_name(e.type) for e in application.implied if e.type not in requested}
    own = {name for name in own if name.package not in requested}
    return tuple(name for name in interfaces.roots if name.kind == "msg" and name not in own)


def _capacities(resolved: Resolved, interfaces: InterfaceSet, diagnostics: Diagnostics) -> Capacities:
    request, application = resolved.request, resolved.request.application
    room = (application.transport.mtu or DEFAULT_MTU[resolved.selection.transport]) - WRITE_DATA_OVERHEAD
    declared = [
        Root(
            type_name(endpoint.type),
            endpoint.limits,
            endpoint.type_span or endpoint.span,
            room,
            Entity(kind, index, full_name(node, endpoint), node_name(node), bool(KIND[kind].sends)),
            endpoint.usual_limits,
        )
        for kind in TOPIC_KINDS
        for index, (_, node, endpoint) in enumerate(declarations(application, kind))
    ]
    declared += service_roots(application, interfaces.messages, room)
    named = {name.name for name in application.interfaces}
    declared += [
        Root(type_name(e.type), e.limits, e.span, room, usual=e.usual_limits)
        for e in application.implied
        if (e.limits or e.usual_limits) and not named & {e.type, type_name(e.type).package}
    ]
    known = {root.type for root in declared}
    # A declared service exchanges a request and a response; its event, which ROS 2 derives, needs no limits.
    known |= {
        event_name(r.type) for r in declared if r.entity is not None and KIND[r.entity.kind].service_type
    }
    roots = declared + [
        _root(name, application, room) for name in interfaces.message_roots if name not in known
    ]
    defaults = Defaults(None, None) if request.from_file else Defaults()
    return plan_capacities(interfaces.messages, roots, application.limits, defaults, diagnostics)


def _received(application: Application, selection: Selection, capacities: Capacities) -> tuple[TypeName, ...]:
    """Return the types that have a decoder: those that are received where entities alone decode, else every root."""
    decoding = next((c for c in selection.components if c.component.name == "cdr_decode"), None)
    if decoding is None:
        return ()
    by_entities = all(reason.startswith("needed by ") for reason in decoding.reasons)
    of_the_clock = selection.serves_only("subscribe", CLOCK_ROS) and not selection.has("services")
    if not by_entities or not (application.nodes or of_the_clock):
        return tuple(capacities.limits)
    received = {type_name(e.type) for _, _, e in declarations(application, "subscription")}
    received |= {type_name(e.type) for e in application.implied}
    for kind in SERVICE_KINDS:
        for _, _, endpoint in declarations(application, kind):
            service = type_name(endpoint.type, "srv")
            received |= {derived_name(service, part) for part, sends in KIND[kind].parts if not sends}
    return tuple(name for name in capacities.limits if name in received)


def _root(name: TypeName, application: Application, room: int) -> Root:
    spans = {i.name: i.span for i in application.interfaces}
    declared = declaring_name(name)
    requested = (str(name), str(declared), f"{name.package}/{declared.name}", name.package)
    span = next((spans[text] for text in requested if text in spans), None)
    return Root(name, (), span, room)


def _component_files(project: Project) -> tuple[ComponentFile, ...]:
    values = project.values
    components = (c.component for c in project.selection.components)
    return component_files(components, values.holds, project.provisions.files)
