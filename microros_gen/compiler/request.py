# SPDX-License-Identifier: Apache-2.0
"""The application file and the options of a command → what the user asks for; options override the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen.application.agent_places import (
    are_devices,
    parse_agent_address,
    parse_agent_devices,
    parse_agents,
    parse_discover,
)
from microros_gen.application.find import APPLICATION_FILE, read_application
from microros_gen.application.image_files import with_image_files
from microros_gen.application.model import Application, component_change
from microros_gen.application.parameter_find import with_parameter_files
from microros_gen.application.parser import parse_application
from microros_gen.application.system_bus import with_bus_senders
from microros_gen.application.system_find import with_system
from microros_gen.application.transport_decl import Transport
from microros_gen.compiler.options import Options
from microros_gen.diagnostics import Diagnostic, Diagnostics, Source, Span
from microros_gen.documents.named import Named
from microros_gen.platform.find import FoundTarget, builtin_targets, read_target
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.extension import INSTALLED, Extensions, take_extensions


@dataclass(frozen=True)
class Request:
    """What the user asked for, read but not yet resolved.

    Names of files in the application file are relative to `near`, its folder; names of profiles on the command
    line to the current folder, `profiles_near`. `interface_paths` are those of the options. `extensions` are folders
    that `components` names, in their order; the application has the names of their components instead.
    `selftest`: with the self-test.
    """

    application: Application
    from_file: bool
    config: Path | None
    near: Path
    profiles_near: Path
    found_target: FoundTarget
    inputs: Mapping[str, bytes]
    interface_paths: tuple[Path, ...] = ()
    extensions: Extensions = INSTALLED
    warnings: tuple[Diagnostic, ...] = ()
    selftest: bool = False

    @property
    def target(self) -> Target:
        """What the C compiler is told, and which port the image stands on."""
        return self.found_target.target


def read_request(options: Options, diagnostics: Diagnostics) -> Request:
    """Read the application file, if there is one, and let the options override it."""
    source = read_application(options.config, Path.cwd(), diagnostics)
    diagnostics.check()
    near = options.config.parent if options.config else Path()
    return request_of(source, near, options, diagnostics)


def request_of(source: Source | None, near: Path, options: Options, diagnostics: Diagnostics) -> Request:
    """Return the request of an application file in the folder `near`, or of the options alone."""
    application = parse_application(source, diagnostics) if source else Application()
    diagnostics.check()
    assert application is not None
    inputs = {"microros.yaml": source.text.encode()} if source else {}
    application, parameter_files = with_parameter_files(application, near, diagnostics)
    diagnostics.check()
    inputs |= {f"parameter file {Path(file.name).name}": file.text.encode() for file in parameter_files}
    config = options.config or near / APPLICATION_FILE
    application, of_image = with_image_files(application, config, diagnostics)
    diagnostics.check()
    inputs |= of_image
    application, system_files = with_system(
        application, options.config, near, diagnostics, options.interface_paths
    )
    diagnostics.check()
    application, bus_files = with_bus_senders(application, near, options.interface_paths, diagnostics)
    diagnostics.check()
    inputs |= {f"system {name}": file.text.encode() for name, file in {**system_files, **bus_files}.items()}
    application, of_file = take_extensions(application, near, diagnostics)
    application = _with_options(application, options, diagnostics)
    application, of_options = take_extensions(application, Path(), diagnostics)
    extensions = Extensions((*of_file, *of_options))
    profiles_near = Path() if options.profiles else near
    named = application.target
    parts = {"os": named.rtos, "network": named.network}
    target = read_target(named.name, near, named.span, diagnostics, extensions, parts)
    diagnostics.check()
    assert target is not None
    return Request(
        application,
        source is not None,
        options.config,
        near,
        profiles_near,
        target,
        inputs,
        options.interface_paths,
        extensions,
        selftest=options.selftest,
    )


def _with_options(application: Application, options: Options, diagnostics: Diagnostics) -> Application:
    if options.profiles:
        application = replace(application, profiles=_named(options.profiles, "--profile"))
    if options.interfaces:
        added = _named(options.interfaces, "--interface")
        application = replace(application, interfaces=application.interfaces + added)
    if options.components:
        named_components = _named(options.components, "--component")
        changes = tuple(component_change(c.name, c.span) for c in named_components)
        application = replace(application, components=application.components + changes)
    if options.target:
        (named,) = _named((options.target,), "--target")
        target = replace(application.target, name=named.name, span=named.span)
        application = replace(application, target=target)
    elif application.target.span is None and options.default_target in builtin_targets():
        target = replace(application.target, name=str(options.default_target))
        application = replace(application, target=target)
    if options.agent:
        (named,) = _named((options.agent,), "--agent")
        application = replace(application, transport=_with_agent(application.transport, named, diagnostics))
    return application


def _with_agent(transport: Transport, agent: Named, diagnostics: Diagnostics) -> Transport:
    """Return the transport to agents at `HOST:PORT[,HOST:PORT…]`, or at the other ends of devices with these paths."""
    transport = replace(transport, agents=(), devices=())
    parts = [(part.strip(), agent.span) for part in agent.name.split(",")]
    is_device = are_devices(parts)
    chosen = transport.type if transport.type_span else None
    if is_device and chosen in (None, "serial"):
        devices = parse_agent_devices(parts, agent.span, diagnostics)
        transport = replace(transport, type="serial", type_span=transport.type_span or agent.span)
        if len(devices) == 1:
            return replace(transport, device=devices[0])
        return replace(transport, device=devices[0], devices=devices, agent_span=agent.span)
    if is_device or chosen in ("serial", "canfd", "custom"):
        what = "device" if is_device else "agent address"
        hint = "Give the path of a device such as /dev/ttyUSB0" if chosen == "serial" else "Leave it out"
        diagnostics.error(f"transport: {chosen} has no {what}", agent.span, hint, id="MG-8607")
        return transport
    if len(parts) > 1:
        agents = parse_agents(parts, agent.span, diagnostics)
        host, port = next(iter(agents), (transport.host, transport.port))
        return replace(transport, host=host, port=port, agents=agents, discover=None, agent_span=agent.span)
    discover = parse_discover(agent.name, agent.span, diagnostics)
    if discover is not None:
        return replace(transport, discover=discover, agent_span=agent.span)
    address = parse_agent_address(agent.name, agent.span, diagnostics)
    if address is None:
        return transport
    return replace(transport, host=address[0], port=address[1], discover=None, agent_span=agent.span)


def _named(values: Iterable[str], option: str) -> tuple[Named, ...]:
    """Give each value a place on the command line, as diagnostics print it."""
    found = []
    for value in values:
        text = f"{option} {value}"
        span = Span(Source("<command line>", text), 1, len(option) + 2, len(text) + 1)
        found.append(Named(value, span))
    return tuple(found)
