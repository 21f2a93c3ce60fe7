# SPDX-License-Identifier: Apache-2.0
"""What the templates of a package can print, and the conditions of its files."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen import __version__
from microros_gen.client.views.memory import buffer_sizes
from microros_gen.compiler import Planned
from microros_gen.package.description import PackageDescription
from microros_gen.platform.capabilities import declarations
from microros_gen.records import dataclass
from microros_gen.selection.contribution import Conditions


@dataclass(frozen=True)
class Buffer:
    """A kind of buffer, and its bytes."""

    name: str
    bytes: int


@dataclass(frozen=True)
class PackageView:
    """The package as templates see it, as `view`. Paths are below the package's folder, sorted.

    `general`: without an application of the user's. `sources` are C, C++ and assembly files, `headers` their headers,
    `library_sources` those of them that are no examples. `example` is the main.c of the plan (empty: left out).
    `interfaces` are the roots, with all parts of `types`. `functions` are those that the application defines,
    `declarations` their prototypes or, without any, a comment. `plan_text` names the plan in a sentence. `buffers` are
    those that the plan sizes, `ram` their sum. `line_room` is the largest message on the line, bytes.
    """

    name: str
    summary: str
    library: str
    version: str
    plan: str
    plan_text: str
    plan_id: str
    general: bool
    transport: str
    line_room: int
    components: tuple[str, ...]
    interfaces: tuple[str, ...]
    types: tuple[str, ...]
    sources: tuple[str, ...]
    library_sources: tuple[str, ...]
    headers: tuple[str, ...]
    example: str
    functions: tuple[str, ...]
    declarations: tuple[str, ...]
    buffers: tuple[Buffer, ...]
    ram: int


def buffers_of(planned: Planned) -> tuple[Buffer, ...]:
    """Return the buffers of a plan; storage of messages for the last data model that the target has."""
    storage = sum(pool.bytes(0) for pool in planned.project.runtime.memory.message_pools)
    arena = planned.project.runtime.memory.arena_size
    return (
        *(Buffer(name, size) for name, size in buffer_sizes(planned.project)),
        *((Buffer("strings and sequences of messages", storage),) if storage else ()),
        *((Buffer("arena", arena),) if arena else ()),
    )


def package_view(
    package: PackageDescription, planned: Planned, general: bool, files: Iterable[str]
) -> PackageView:
    """Return the view of a package that has `files` besides those of templates."""
    project = planned.project
    names = tuple(sorted(files))
    buffers = buffers_of(planned)
    place = package.place_of(project.example) or ()
    sources = tuple(n for n in names if n.endswith((".c", ".cpp", ".S")))
    rows = project.provisions.of_application
    left = (row.capability for row in rows if row.capability.name not in package.defines)
    functions = (*(name for capability in left for name in capability.functions), *project.board.hooks)
    declared = (line for row in rows for line in declarations(row.capability))
    return PackageView(
        name=package.name,
        summary=package.summary,
        library=package.library,
        version=__version__,
        plan=project.name,
        plan_text="the general plan of the package" if general else f"the plan `{project.name}`",
        plan_id=project.runtime.plan_id,
        general=general,
        transport=project.selection.transport,
        line_room=project.runtime.streams.mtu,
        components=tuple(sorted(c.component.name for c in project.selection.components)),
        interfaces=tuple(str(name) for name in planned.interfaces.roots),
        types=tuple(sorted(str(plan.name) for plan in project.types)),
        sources=sources,
        library_sources=tuple(n for n in sources if not n.startswith("examples/")),
        headers=tuple(n for n in names if n.endswith(".h")),
        example=next(iter(place), ""),
        functions=functions,
        declarations=(
            *declared,
            *(f"void {name}(void);" for name in project.board.hooks),
            *(() if functions else ("/* none */",)),
        ),
        buffers=buffers,
        ram=sum(buffer.bytes for buffer in buffers),
    )


def holds(conditions: Conditions, planned: Planned, general: bool) -> bool:
    """Return whether a file of the package belongs to a plan.

    Paths are those of a component.yaml, `package.general`, and `type.PKG/msg/Type` for a type that the plan has.
    Raises UserError if the plan has no value at such a path.
    """
    types = {str(plan.name) for plan in planned.project.types} | {str(r) for r in planned.interfaces.roots}
    for path, wanted in conditions:
        first, _, rest = path.partition(".")
        if first == "package":
            met = (rest == "general" and general) is wanted
        elif first == "type":
            met = (rest in types) is wanted
        else:
            met = planned.project.values.holds(((path, wanted),))
        if not met:
            return False
    return True
