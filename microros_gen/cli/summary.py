# SPDX-License-Identifier: Apache-2.0
"""What `generate` and `build` print about their result."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from microros_gen.application.kinds import KINDS, EntityKind
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.services import ServicePlan
from microros_gen.client.views.presence import report_rows
from microros_gen.compiler import Planned
from microros_gen.selftest.render import FOLDER, lacks_image
from microros_gen.typesupport.plan.message_pools import open_members

if TYPE_CHECKING:
    from microros_gen.client.plan.project import Project
    from microros_gen.toolchain.compile import BuildReport
    from microros_gen.toolchain.measure import Usage

_SHOWN = 6
"""Members that a line names."""


def plan_summary(planned: Planned) -> str:
    """Return a few lines: profile, agent, entities, streams, assumed limits."""
    project = planned.project
    runtime = project.runtime
    lines = [
        ("profile", f"{project.name} for {project.target.name}: {_components(planned)}"),
        ("agent", _agent(planned)),
        *((kind.does, line) for kind in KINDS for line in _entities(planned, kind)),
        (
            "streams",
            f"reliable {runtime.streams.reliable_slots} x {runtime.streams.reliable_slot_size} bytes,"
            f" best effort {project.streams.best_effort_shown}, input {runtime.input.size}",
        ),
    ]
    if project.line:
        lines.append(("line", f"{project.line.text} ({project.line.why})"))
    lines += ((name, f"{text} ({why})" if why else text) for name, text, why in report_rows(project))
    functions = (*project.provisions.functions(), *project.board.hooks)
    if functions:
        lines.append(
            ("you define", f"{', '.join(functions)} (README.md of the output has their declarations)")
        )
    lines += (("refuses", line) for line in refused_assigns(planned))
    if planned.capacities.defaulted:
        lines.append(("limits", _defaults(planned)))
    return table(lines)


def refused_assigns(planned: Planned) -> list[str]:
    """Return for each declared sender of unbounded strings or sequences from which length on `__assign` is refused.

    Where nothing is kept for its messages, that is every length.
    """
    runtime = planned.project.runtime
    return [
        f"{sender.topic}: {_refused(open_members(sender, planned.project.messages), runtime)}"
        for sender in planned.project.storage.senders
        if sender.topic and open_members(sender, planned.project.messages)
    ]


def _refused(members: Sequence[tuple[str, int]], runtime: RuntimePlan) -> str:
    if not runtime.memory.kept_messages and not runtime.memory.arena_size:
        return "each __assign and __Sequence__init: memory.messages is 0 (buffers of your own are filled)"
    shown = ", ".join(f"{path} above {most}" for path, most in members[:_SHOWN])
    more = len(members) - _SHOWN
    return f"__assign and __Sequence__init of {shown}{f' and {more} more' if more > 0 else ''}"


def built_summary(out: Path, report: BuildReport, usage: Usage | None, lacks_image: str = "") -> str:
    """Return the lines that a compilation adds; `lacks_image` says why there is no image."""
    sizes = (
        f": {usage.flash} bytes of code and constants before unused parts are dropped, {usage.ram} of RAM"
        if usage
        else ""
    )
    copied = f"{report.copied} were copied from earlier builds, " if report.copied else ""
    return table(
        [
            ("compiled", f"{report.compiled} objects, {copied}{report.kept} were up to date"),
            ("library", f"{out / report.library}{sizes}"),
            ("image", f"{out / report.image}" if report.image else f"none: {lacks_image}"),
        ]
    )


def selftest_summary(out: Path, report: BuildReport, project: Project) -> str:
    """Return the line about the self-test: how to run it, or why it was not linked."""
    if report.selftest:
        text = f"{out / report.selftest}: `microros-gen run {out} --selftest` starts it"
    else:
        text = f"sources in {out / FOLDER}, no image: {lacks_image(project)}"
    return table([("self-test", text)])


def runs_here(project: Project, report: BuildReport) -> bool:
    """Return whether `run` can start the image with an agent on this machine."""
    emulator, transport = project.target.emulator, project.selection.transport
    if report.image is None:
        return False
    if emulator is not None:
        return shutil.which(emulator.program) is not None
    device = project.runtime.transport.device
    own_line = transport == "serial" and not device.startswith("/dev/")
    return project.target.hosted and (transport in ("udp", "tcp") or own_line)


def _agent(planned: Planned) -> str:
    project, runtime = planned.project, planned.project.runtime
    transport = project.selection.transport
    if transport == "serial":
        line = runtime.transport.device if project.target.names_lines else "the board's line"
        return f"serial, {line}, {runtime.transport.baud} baud"
    if transport == "canfd":
        return f"canfd, {project.application.transport.can_device}"
    return (
        "custom transport of the application"
        if transport == "custom"
        else f"{transport} {runtime.transport.agent_place}"
    )


def _components(planned: Planned) -> str:
    chosen = planned.project.selection.components
    own = [c.component.name for c in chosen if c.component.layer == "micro-ROS"]
    below = len(chosen) - len(own)
    return f"{', '.join(own)} and {below} components below them (`resolve` says why)"


def _entities(planned: Planned, kind: EntityKind) -> list[str]:
    runtime = planned.project.runtime
    places = runtime.entities.places(kind.name).max
    declared = [_shown(entity) for entity in runtime.entities.places(kind.name).declared]
    if kind.service_type:
        return declared if declared or not places else [f"up to {places}"]
    if runtime.entities.declared:
        return declared
    if not planned.project.selection.has(kind.component):
        return []
    implied = [e for e in planned.project.application.implied if e.kind == kind.name]
    own = [f"{e.topic} ({e.type}, best effort)" for e in implied]
    places -= len(own)
    shown = [str(root) for root in planned.project.roots[:6]]
    more = len(planned.project.roots) - len(shown)
    of_roots = f"up to {places} of {', '.join(shown)}{f' and {more} more types' if more else ''}"
    return [*own, *([of_roots] if places else [])]


def _shown(entity: PublisherPlan | SubscriptionPlan | ServicePlan) -> str:
    if isinstance(entity, ServicePlan):
        return f"{entity.name} ({entity.type})"
    return f"{entity.topic} ({entity.type}, {'reliable' if entity.reliable else 'best effort'})"


def _defaults(planned: Planned) -> str:
    kinds = {c.kind: c.value for c in planned.capacities.defaulted}
    values = ", ".join(f"{kind} {value}" for kind, value in sorted(kinds.items(), reverse=True))
    count = len(planned.capacities.defaulted)
    return f"{values} by default for {count} field(s); set `limits:` in microros.yaml"


def table(lines: list[tuple[str, str]]) -> str:
    """Return lines of a word and what it is, as commands print them."""
    return "".join(f"{name:<10} {text}\n" for name, text in lines)
